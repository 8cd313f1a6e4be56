// SPDX-License-Identifier: MIT
// flipGreen and flipGreenFile: memory limits, and files. Also their report as JSON.
#include <algorithm>
#include <string_view>
#include <vector>

#include "commands/flip_green/flip_green_report.h"
#include "commands/flip_green/texture_png.h"
#include "images/flip_green.h"
#include "images/image.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/memory_budget.h"
#include "model/io/output_name.h"
#include "model/io/recorded_files.h"
#include "tspace/map_files.h"

namespace tspace {
namespace {

/// Fails if the decoded image is larger than kTimesMemory times the memory limit. Rows of a PNG need little memory but
/// take time, and a small file may claim any number of them. For the smallest file, the limit is 1 GB, or about 5
/// seconds. A valid single-color map of 16384 x 16384 texels has 800 MB in a file of 800 KB.
void checkWork(ByteSpan bytes, std::uint64_t memory_limit_bytes) {
    constexpr std::uint64_t kTimesMemory = 16, kMax = std::uint64_t{1} << 56;
    const std::uint64_t memory = memory_limit_bytes != 0
                                     ? std::min(memory_limit_bytes, kMax)
                                     : MemoryBudget::kAnyFile + MemoryBudget::kPerByte * bytes.size();
    const std::uint64_t unpacked = flipUnpackedBytes(bytes);
    if (unpacked <= kTimesMemory * memory) return;
    const auto megabytes = [](std::uint64_t count) { return std::to_string(count >> 20) + " MB"; };
    const std::string limit = memory_limit_bytes != 0
                                  ? "--memory-limit allows " + megabytes(kTimesMemory * memory)
                                  : "the limit for a file of its size is " + megabytes(kTimesMemory * memory) +
                                        "; use --memory-limit to raise it";
    failFile(ErrorCode::tooLarge, "the uncompressed size of the image is " + megabytes(unpacked) + ", but " + limit);
}

FlippedImage flip(ByteSpan bytes, const FlipGreenOptions& options) {
    MemoryBudget budget(options.memory_limit_bytes);
    budget.allow(bytes.size());
    if (const std::uint64_t needed = flipWorkBytes(bytes); needed != 0) budget.require(needed, {});
    checkWork(bytes, options.memory_limit_bytes);
    const ImageFormat format = imageFormat(bytes);
    const bool is_texture = format == ImageFormat::ktx2 || format == ImageFormat::dds;
    if (is_texture && options.format == ImageFileFormat::png) return flippedTexturePng(bytes);
    return valueOrThrow(flipImage(bytes, options));
}

struct Extension {
    std::string_view name;
    ImageFileFormat format;
};
/// Extensions of outputs, each with its format, in the order in which error messages list them. PNG is last.
constexpr Extension kExtensions[] = {{".jpg", ImageFileFormat::jpeg},  {".jpeg", ImageFileFormat::jpeg},
                                     {".webp", ImageFileFormat::webp}, {".ktx2", ImageFileFormat::ktx2},
                                     {".dds", ImageFileFormat::dds},   {".png", ImageFileFormat::png}};

/// Returns the format that an extension stands for, or sameAsInput if it is unknown.
ImageFileFormat formatOfExtension(std::string_view extension) {
    const auto found = std::find_if(std::begin(kExtensions), std::end(kExtensions),
                                    [&](const Extension& known) { return known.name == extension; });
    return found == std::end(kExtensions) ? ImageFileFormat::sameAsInput : found->format;
}

/// Fails if the extension of the output stands neither for PNG nor for the format `input`, because re-encoding would
/// lose data. If `input` is sameAsInput, all known extensions are allowed.
void requireLosslessEnding(const std::string& output, ImageFileFormat input) {
    const std::string extension = lowerExtension(output);
    std::vector<std::string_view> allowed;
    for (const Extension& candidate : kExtensions) {
        const bool is_lossless = candidate.format == input || candidate.format == ImageFileFormat::png;
        if (input != ImageFileFormat::sameAsInput && !is_lossless) continue;
        if (candidate.name == extension) return;
        allowed.push_back(candidate.name);
    }
    failEnding(output, allowed);
}

/// Returns the format of an output that equals the format of the input, according to the name of the input.
ImageFileFormat formatOfName(const std::string& input) {
    const std::string extension = lowerExtension(input);
    return extension == ".tga" ? ImageFileFormat::png : formatOfExtension(extension);
}

}  // namespace

Result<FlippedImage> flipGreen(std::span<const std::uint8_t> image, const FlipGreenOptions& options) {
    return atFileBorder([&]() -> Result<FlippedImage> { return flip(image, options); });
}

Result<FlipGreenReport> flipGreenFile(const std::string& input, const std::string& output,
                                      const FlipGreenOptions& options) {
    return atFileBorder([&]() -> Result<FlipGreenReport> {
        FlipGreenOptions chosen = options;
        const bool is_named = chosen.format == ImageFileFormat::sameAsInput && !options.sink;
        if (is_named) {
            chosen.format = formatOfExtension(lowerExtension(output));
            // The content of the input decides which formats are lossless. If no format fits, the message lists those
            // for the name of the input.
            if (chosen.format == ImageFileFormat::sameAsInput) requireLosslessEnding(output, formatOfName(input));
        }
        Bytes read;
        if (options.content.data() == nullptr) {
            recordInput(input);
            read = readFile(input);
        }
        const ByteSpan image = options.content.data() != nullptr ? options.content : ByteSpan(read);
        if (is_named) requireLosslessEnding(output, fileFormat(imageFormat(image)));
        FlippedImage flipped = flip(image, chosen);
        AtomicOutput files({.sink = options.sink, .is_dry_run = options.dry_run, .sync = options.sync});
        files.add(output, std::span<const std::uint8_t>(flipped.bytes));
        files.commit();
        return std::move(flipped.report);
    });
}

}  // namespace tspace

namespace tspace::report {

const char* imageFormatName(ImageFileFormat format) {
    switch (format) {
        case ImageFileFormat::png: return "PNG";
        case ImageFileFormat::jpeg: return "JPEG";
        case ImageFileFormat::webp: return "WebP";
        case ImageFileFormat::ktx2: return "KTX2";
        case ImageFileFormat::dds: return "DDS";
        case ImageFileFormat::sameAsInput: break;
    }
    return "";
}

std::string flipGreenJson(const Outcome<FlipGreenReport>& outcome, ExitCode exit_code) {
    const Result<FlipGreenReport>& result = outcome.result;
    Json json = madeFileJson("tspace.flip-green/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["format"] = imageFormatName(result->format);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bits"] = result->bits;
    json["exact"] = result->is_exact;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
