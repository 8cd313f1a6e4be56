// SPDX-License-Identifier: MIT
#include "commands/check/check_image.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "commands/check/findings.h"
#include "commands/check/scene_checks.h"
#include "commands/shared/image_budget.h"
#include "core/base/ascii.h"
#include "core/base/numbers.h"
#include "images/float_image.h"
#include "images/image.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"

namespace tspace {
namespace {

const char* contentName(MapContent content) {
    switch (content) {
        case MapContent::normals: return "normals";
        case MapContent::twoChannels: return "twoChannels";
        case MapContent::unsignedZ: return "unsignedZ";
        case MapContent::xInAlpha: return "xInAlpha";
        case MapContent::exchanged: return "exchanged";
        case MapContent::encoded: return "encoded";
        case MapContent::objectSpace: return "objectSpace";
        case MapContent::height: return "height";
        case MapContent::hemiOctahedral: return "hemiOctahedral";
        case MapContent::picture: break;
    }
    return "picture";
}

const char* greenName(GreenVerdict verdict) {
    switch (verdict) {
        case GreenVerdict::up: return "up";
        case GreenVerdict::down: return "down";
        case GreenVerdict::mixed: return "mixed";
        case GreenVerdict::unknown: break;
    }
    return "unknown";
}

std::string texelText(const std::uint8_t* rgb) {
    // The text is built in steps, because GCC 12 warns about "(" + std::to_string().
    std::string text = "(";
    for (std::size_t i = 0; i < 3; ++i) text.append(i == 0 ? "" : ", ").append(std::to_string(rgb[i]));
    return text + ")";
}

double lengthOf(const std::uint8_t* rgb) {
    const auto part = [&](std::size_t i) { return rgb[i] / 127.5 - 1; };
    return std::sqrt(part(0) * part(0) + part(1) * part(1) + part(2) * part(2));
}

Finding noteOn(FindingCode code, std::uint64_t count, std::uint64_t total, FindingText text) {
    return makeFinding(code, Severity::note, {.count = count, .total = total}, "texels", std::move(text));
}

/// Reports an image of a single color: either a flat map, or not a normal map.
std::optional<Finding> constantFinding(const std::string& name, const RgbImage& image) {
    const std::uint8_t* const first = image.rgb.data();
    const std::size_t count = image.rgb.size() / 3;
    for (std::size_t i = 0; i < count; ++i) {
        if (!std::equal(first, first + 3, first + 3 * i)) return {};
    }
    const bool is_vector = std::fabs(lengthOf(first) - 1) < 0.1;
    const bool is_flat = is_vector && first[0] - 126 < 4 && first[1] - 126 < 4 && first[0] > 125 && first[1] > 125;
    Finding finding = noteOn(FindingCode::normalMapConstant, count, count,
                             {.cause = "the map is a single color: all texels of " + name + " are " + texelText(first) +
                                       (is_flat     ? ", so the map is flat"
                                        : is_vector ? ", so all normals have the same direction, which is not (0, 0, 1)"
                                                    : ", which is not a normal")});
    if (!is_flat) finding.severity = Severity::warning;
    return finding;
}

/// Reports vectors whose lengths are far from 1.
std::optional<Finding> lengthFinding(const std::string& name, const RgbImage& image) {
    constexpr double kOff = 0.1, kMinShare = 0.1;
    constexpr int kBlack = 8, kWhite = 247;
    std::size_t count = 0, total = 0;
    double sum = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        const std::uint8_t* const rgb = &image.rgb[i];
        const auto [least, most] = std::minmax({rgb[0], rgb[1], rgb[2]});
        if (most <= kBlack || least >= kWhite) continue;  // texels that were never painted or baked
        const double size = lengthOf(rgb);
        ++total;
        sum += size;
        count += std::fabs(size - 1) > kOff ? 1 : 0;
    }
    if (total == 0 || static_cast<double>(count) < kMinShare * static_cast<double>(total)) return {};
    return noteOn(FindingCode::normalMapLengths, count, total,
                  {.symptom = "the relief may look too strong or too weak",
                   .cause = "the vectors of " + name + " do not have unit length (" + std::to_string(count) + " of " +
                            std::to_string(total) + " texels deviate by more than 0.1; mean length " +
                            shortNumber(sum / static_cast<double>(total)) + ")"});
}

/// Reports flat areas of 8-bit maps whose x and y are 127, which is half a step below 0 (128 is half a step above).
std::optional<Finding> zeroFinding(const std::string& name, const RgbImage& image) {
    constexpr double kMinShare = 0.05;
    const std::size_t total = image.rgb.size() / 3;
    std::size_t low = 0, high = 0;
    for (std::size_t i = 0; i < total; ++i) {
        const std::uint8_t* const rgb = &image.rgb[3 * i];
        low += rgb[0] == 127 && rgb[1] == 127 ? 1 : 0;
        high += rgb[0] == 128 && rgb[1] == 128 ? 1 : 0;
    }
    if (low <= high || static_cast<double>(low) < kMinShare * static_cast<double>(total)) return {};
    return noteOn(
        FindingCode::normalMapZero, low, total,
        {.symptom = "flat areas may look slightly tilted",
         .cause = "flat texels of " + name +
                  " are (127, 127), where most programs write (128, 128). Both values tilt the normal by 0.3 "
                  "degrees, in opposite directions; a reader that subtracts 128 / 255 shows 127 with a tilt of "
                  "0.6 degrees"});
}

}  // namespace

bool isImageInput(const std::string& input, ByteSpan content) {
    // AVIF cannot be read, but counts as an image, so that the error names the format.
    const bool is_named = isImageName(input) || lowerExtension(input) == ".avif";
    if (content.data() == nullptr) return is_named;
    const ImageFormat format = imageFormat(content);
    return format != ImageFormat::unknown && (format != ImageFormat::tga || is_named);
}

std::string imageText(const CheckReport& report) {
    const CheckedImage& image = *report.image;
    const auto by = [&](const char* text) {
        return std::string("; ") + text + " (confidence " +
               std::to_string(static_cast<int>(std::lround(100 * image.green_confidence))) + " %)";
    };
    std::string text = report.format + ", " + std::to_string(image.width) + " x " + std::to_string(image.height) + ": ";
    if (image.content == "normals") {
        text += "a normal map in tangent space";
    } else if (image.content == "height") {
        return text + "gray like a height map, not a normal map";
    } else if (image.content == "picture") {
        return text + "not a normal map";
    } else if (image.content == "constant") {
        return text + "a single color";
    } else if (image.content == "objectSpace") {
        return text + "a normal map, but not in tangent space";
    } else {
        text += "a normal map whose channels are not those of glTF";
    }
    if (image.green == "up")
        text +=
            by("green points up, as in OpenGL and glTF, or red and green are both inverted (bumps look like dents)");
    if (image.green == "down")
        text += by("green points down, as in DirectX, or red is inverted (bumps look like dents)");
    if (image.green == "mixed") text += by("green points up in one part and down in another");
    if (image.green == "unknown") text += "; the direction of green cannot be determined";
    return text;
}

CheckReport checkImageFile(const std::string& input, const CheckOptions& options) {
    Bytes read;
    ByteSpan bytes = options.file.content;
    if (bytes.data() == nullptr) {
        read = readFile(input);
        bytes = read;
    }
    const ImageFormat format = imageFormat(bytes);
    if (const char* why_not = whyNotRead(format)) failFile(ErrorCode::unsupportedFile, why_not);
    Scene scene;
    scene.images.push_back({.bytes = {bytes.begin(), bytes.end()}});
    scene.images[0].uri = input;
    constexpr std::uint64_t kPixelBytes = 8;  // bytes per pixel: two copies with 3 bytes each, masks, and alpha
    scene.memory = imageBudget(bytes, options.file);
    scene.memory->require(imageNeed(bytes, kPixelBytes), {});
    LoneMap map = checkLoneMap(scene, options);
    CheckReport report{.format = lowerAscii(formatName(format)), .findings = std::move(map.findings), .image_count = 1};
    report.green_count = map.test.verdict == GreenVerdict::unknown ? 0 : 1;
    report.image = CheckedImage{.width = map.pixels.width,
                                .height = map.pixels.height,
                                .content = contentName(map.analysis.content),
                                .green = greenName(map.test.verdict),
                                .green_confidence = map.test.confidence()};
    const std::string name = "'" + scene.images[0].uri + "'";
    const std::optional<TextureFacts> facts = textureFacts(bytes);
    const bool is_declared = facts && !(facts->layout == MapLayout{});
    if (std::optional<Finding> constant = constantFinding(name, map.pixels)) {
        report.image->content = "constant";
        std::erase_if(report.findings, [](const Finding& one) { return one.code != FindingCode::fileRemark; });
        report.findings.push_back(*std::move(constant));
        return report;
    }
    for (Finding& finding : report.findings) {
        const bool is_layout =
            finding.code == FindingCode::normalMapTwoChannels || finding.code == FindingCode::normalMapChannels;
        // Engines use the layout that the texture format declares; only viewers that ignore it render the map wrong.
        if (is_declared && is_layout) finding.severity = Severity::note;
    }
    if (map.analysis.content != MapContent::normals) return report;
    for (std::optional<Finding> finding : {lengthFinding(name, map.pixels), zeroFinding(name, map.pixels)}) {
        if (finding) report.findings.push_back(*std::move(finding));
    }
    return report;
}

}  // namespace tspace
