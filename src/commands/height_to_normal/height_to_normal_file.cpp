// SPDX-License-Identifier: MIT
// heightToNormalFile: reads the image and the mesh, and collects warnings. Also its options, and its report as JSON.
#include "commands/shared/map_image_file.h"

#include <cmath>

#include "commands/height_to_normal/height_to_normal_report.h"
#include "commands/shared/file_options.h"
#include "commands/shared/request.h"
#include "core/base/numbers.h"
#include "images/texture_vectors.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/output_name.h"
#include "tspace/map_files.h"

namespace tspace {
namespace {

/// Slopes outside of these limits suggest that strength and mesh have different units.
constexpr double kSteepDeg = 60, kFlatDeg = 0.1;

/// Returns the height of a texel with 8 bits per channel, in meters.
double terrainHeight(HeightEncoding encoding, const Vec3& texel) {
    const auto byteOf = [](float part) { return std::floor(255 * static_cast<double>(part) + 0.5); };
    const double r = byteOf(texel.x), g = byteOf(texel.y), b = byteOf(texel.z);
    return encoding == HeightEncoding::terrainRgb ? -10000 + (65536 * r + 256 * g + b) / 10
                                                  : 256 * r + g + b / 256 - 32768;
}

/// Returns heights in meters relative to the first texel, so that floats keep all their digits.
std::vector<float> terrainHeights(HeightEncoding encoding, const FloatImage& image) {
    std::vector<float> heights;
    heights.reserve(image.texels.size());
    const double base = terrainHeight(encoding, image.texels.front());
    for (const Vec3& texel : image.texels) heights.push_back(static_cast<float>(terrainHeight(encoding, texel) - base));
    return heights;
}

/// Throws FileError if the image may be lossy: an error of 1 in the red channel is an error of kilometers.
void checkTerrain(ByteSpan bytes, const FloatImage& image) {
    if (image.bits != 8)
        failFile(ErrorCode::invalidOption,
                 "heights encoded in red, green and blue need 8 bits per channel, but the image has " +
                     std::to_string(image.bits));
    if (imageFormat(bytes) == ImageFormat::jpeg || isLossyWebp(bytes))
        failFile(ErrorCode::invalidOption,
                 "the image uses lossy compression, which destroys heights encoded in red, green and blue");
}

void addHeightWarnings(const HeightToNormalFileOptions& options, HeightToNormalFileReport& report) {
    const auto warn = [&](std::string text) { report.warnings.push_back(std::move(text)); };
    const bool has_own_size =
        options.mesh.empty() && (options.texel_size != 1 || options.encoding != HeightEncoding::gray);
    const std::string unit = has_own_size           ? " units of --texel-size"
                             : options.mesh.empty() ? " texels"
                                                    : " model units";
    if (options.encoding != HeightEncoding::gray && options.mesh.empty() && options.texel_size == 1)
        warn("the heights are in meters, and a texel is assumed to be 1 m wide; set its width with --texel-size");
    const HeightToNormalReport& texels = report.texels;
    if (texels.mean_lean_deg > kSteepDeg) {
        warn("the mean tilt of the normals is " + shortNumber(texels.mean_lean_deg) +
             " degrees, so the relief is implausibly steep; check the strength, which is in" + unit);
    }
    if (texels.max_lean_deg < kFlatDeg) {
        warn("the largest tilt of the normals is " + shortNumber(texels.max_lean_deg) +
             " degrees, so the relief is invisible; check the strength, which is in" + unit);
    }
    if (!options.mesh.empty() && texels.on_mesh == 0) warn("no triangle of the mesh uses the map");
}

HeightToNormalFileReport convertHeights(const std::string& input, const std::string& output,
                                        const HeightToNormalFileOptions& requested) {
    InputFiles inputs;
    HeightToNormalFileOptions options = requested;
    inputs.watch(options.file);
    if (options.content.data() == nullptr) inputs.add(input);
    if (!options.sink) requireEnding(output, {".png"});
    if (const char* why_not = whyNotRead(ImageFormat::png))
        failFile(ErrorCode::unsupportedFile, "the output cannot be written: " + std::string(why_not));
    if (options.bits != 8 && options.bits != 16)
        failFile(ErrorCode::invalidOption, "a PNG must have 8 or 16 bits per channel");
    if (!(options.texel_size > 0) || !std::isfinite(options.texel_size))
        failFile(ErrorCode::invalidOption, "the texel size must be greater than 0");
    if (!options.mesh.empty() && options.texel_size != 1)
        failFile(ErrorCode::invalidOption,
                 "--texel-size cannot be used with --mesh, because the mesh determines the texel size");
    const bool is_gray = options.encoding == HeightEncoding::gray;
    Bytes read;
    if (!is_gray && options.content.data() == nullptr) {
        read = readFile(input);
        options.content = read;
    }
    FloatImage image = readMapImage(input, options.content, options.file, ImageUse::numbers);
    if (!is_gray) checkTerrain(options.content, image);
    HeightToNormalFileReport report{.width = image.width, .height = image.height, .bits_before = image.bits};
    report.bits = options.bits;
    if (std::string remarks = takeRemarks(image); !remarks.empty()) report.warnings.push_back(std::move(remarks));
    if (is_gray && !isGrayImage(image))
        report.warnings.emplace_back("the image is not gray; the mean of red, green and blue is used as height");
    MapMesh mesh;
    if (!options.mesh.empty()) {
        mesh = readNamedMapMesh(options.mesh, {.material = options.material, .image_name = fileNameOf(input)},
                                options.tangents, options.file, options.execution);
        report.mesh = mesh.report;
        report.warnings.insert(report.warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
    }
    const std::vector<float> heights = is_gray ? heightsOf(image) : terrainHeights(options.encoding, image);
    const TextureWrap wrap_u = options.clamp ? TextureWrap::clamp : mesh.wrap_u;
    const TextureWrap wrap_v = options.clamp ? TextureWrap::clamp : mesh.wrap_v;
    report.texels = valueOrThrow(heightToNormal(
        {image.width, image.height, heights, wrap_u, wrap_v}, tangentSide(mesh.corners),
        {.strength = options.strength / options.texel_size, .green = options.green, .bits = options.bits}, image.texels,
        options.execution));
    if (options.mesh.empty()) report.texels.texel_size = options.texel_size;
    addHeightWarnings(options, report);
    image.alpha.clear();
    writeMapImage(image, ImageFormat::png, options.bits, output,
                  {.sink = options.sink, .is_dry_run = options.dry_run, .sync = options.file.sync, .inputs = &inputs});
    return report;
}

}  // namespace

Result<HeightToNormalFileReport> heightToNormalFile(const std::string& input, const std::string& output,
                                                    const HeightToNormalFileOptions& options) {
    return atFileBorder([&]() -> Result<HeightToNormalFileReport> { return convertHeights(input, output, options); });
}

}  // namespace tspace

namespace tspace::options {
namespace {

constexpr Named<unsigned> kPngBits[] = {{"8", 8}, {"16", 16}};
constexpr Named<HeightEncoding> kEncodings[] = {{"gray", HeightEncoding::gray},
                                                {"terrain-rgb", HeightEncoding::terrainRgb},
                                                {"terrarium", HeightEncoding::terrarium}};

}  // namespace

OptionList heightToNormalOptions(HeightToNormalFileOptions& options) {
    OptionList list;
    const auto addFile = adder(list, kInputAndOutput), add = adder(list, "Map");
    const auto take_strength = [&options](const std::string& value) {
        return parseReal(value, options.strength) ? std::string() : std::string("must be a number");
    };
    add(option("--strength", "S", take_strength,
               "Height of white above black: in model units with --mesh, otherwise in the unit of "
               "--texel-size (texels by default). Negative: white is lower than black. With --encoding "
               "terrain-rgb or terrarium: a factor applied to the heights."))
        .default_text = std::to_string(1);
    add(choice("--encoding", "NAME", kEncodings, options.encoding,
               "Height encoding of the image. gray: black is low, white is high; terrain-rgb (Mapbox) and terrarium "
               "(Mapzen): meters, encoded in red, green and blue."));
    add(option(
            "--texel-size", "SIZE",
            [&options](const std::string& value) {
                return parseReal(value, options.texel_size) && options.texel_size > 0
                           ? std::string()
                           : std::string("must be a number greater than 0");
            },
            "Width of a texel, in any unit; --strength has the same unit. Meters for the terrain encodings. Not used "
            "with --mesh."))
        .default_text = std::to_string(1);
    addFile(fileOption(
        "--mesh", "FILE", options.mesh,
        "Model that uses the map. Slopes are then measured on its surface, independent of the image size and of "
        "the UVs, and the normals are written in its tangent frames; missing tangents are computed.",
        InputKind::model));
    addFile(materialOfMapOption(options.material));
    addFile(dryRunOption(options.dry_run));
    addAllowExternal(list, options.file);
    add(flag("--clamp", options.clamp,
             "Do not wrap around at the image borders; slopes there are one-sided differences. By default the image "
             "wraps around, as repeating textures do; with --mesh it wraps as the texture of the mesh does."));
    add(readingOption(
        "--convention", [&options](const MapReading& reading) { options.green = reading.green; },
        "Program that will use the output: gltf, opengl, directx, unreal, unity, blender, godot or three. "
        "Green points down for directx and unreal, and up for the others."));
    add(choice("--bits", "BITS", kPngBits, options.bits, "Bits per channel of the output: 8 or 16."));
    addMakingAMap(list, options.tangents.method, options.execution, options.file);
    return list;
}

}  // namespace tspace::options

namespace tspace::report {

std::string heightToNormalJson(const Outcome<HeightToNormalFileReport>& outcome, ExitCode exit_code) {
    const Result<HeightToNormalFileReport>& result = outcome.result;
    Json json = madeFileJson("tspace.height-to-normal/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bitsBefore"] = result->bits_before;
    json["bits"] = result->bits;
    json["mesh"] = mapMeshJson(result->mesh);
    json["texelsOnMesh"] = result->texels.on_mesh;
    json["texelSize"] = result->texels.texel_size;
    json["meanLeanDeg"] = result->texels.mean_lean_deg;
    json["maxLeanDeg"] = result->texels.max_lean_deg;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
