// SPDX-License-Identifier: MIT
// flipGreen and flipGreenFile: formats in and out, limits, files.
#include "maps/flip_green.h"

#include <algorithm>

#include "asset/atomic_output.h"
#include "asset/file_error.h"
#include "asset/memory_budget.h"
#include "maps/codecs.h"
#include "tspace/flip_green.h"

namespace tspace {

namespace {

ImageFileFormat fileFormat(ImageFormat format) {
    switch (format) {
        case ImageFormat::png:
            return ImageFileFormat::png;
        case ImageFormat::jpeg:
            return ImageFileFormat::jpeg;
        case ImageFormat::webp:
            return ImageFileFormat::webp;
        default:
            return ImageFileFormat::sameAsInput;
    }
}

/// Told by content; fails for what this build does not read.
ImageFileFormat readableFormat(ByteSpan bytes) {
    const ImageFormat format = imageFormat(bytes);
    if (const char* why_not = whyNotRead(format)) failFile(ErrorCode::unsupportedFile, why_not);
    if (format == ImageFormat::exr)
        failFile(ErrorCode::unsupportedFile,
                 "it is EXR, whose green is inverted by convertMapFile (tspace convert-map)");
    return fileFormat(format);
}

ImageFileFormat outputFormat(ImageFileFormat input, const FlipGreenOptions& options) {
    if (options.jpeg_quality < 1 || options.jpeg_quality > 100) {
        failFile(ErrorCode::invalidOption, "a JPEG has a quality of 1 to 100");
    }
    const ImageFileFormat format = options.format == ImageFileFormat::sameAsInput ? input : options.format;
    if (format != input && format != ImageFileFormat::png) {
        failFile(ErrorCode::unsupportedFile,
                 "the output is of another format, which would lose; write the format of the input, or PNG");
    }
    if (format == ImageFileFormat::png && whyNotRead(ImageFormat::png) != nullptr) {
        failFile(ErrorCode::unsupportedFile, whyNotRead(ImageFormat::png));
    }
    return format;
}

void invertGreen(ChannelImage& image) {
    for (std::size_t i = 1; i < image.pixels.size(); i += image.channels) image.pixels[i] ^= 0xff;
}

FlippedImage flipPixels([[maybe_unused]] ByteSpan bytes, [[maybe_unused]] ImageFileFormat input, ImageFileFormat output,
                        [[maybe_unused]] int jpeg_quality) {
    ChannelImage image;
#ifdef TSPACE_HAS_IMAGES
    if (input == ImageFileFormat::jpeg) image = readJpegPixels(bytes);
#endif
#ifdef TSPACE_HAS_WEBP
    if (input == ImageFileFormat::webp) image = readWebpPixels(bytes);
#endif
    invertGreen(image);
    FlippedImage result;
    result.report = {.format = output, .width = image.width, .height = image.height};
#ifdef TSPACE_HAS_IMAGES
    if (output == ImageFileFormat::png) result.bytes = writePng(image);
    if (output == ImageFileFormat::jpeg) {
        result.bytes = writeJpeg(image, jpeg_quality, bytes);
        result.report.is_exact = false;
        result.report.warnings.push_back(
            "a JPEG is compressed once more, which rounds its texels again; a PNG would be exact");
    }
#endif
#ifdef TSPACE_HAS_WEBP
    if (output == ImageFileFormat::webp) result.bytes = writeWebp(image);
#endif
    return result;
}

/// Rows of a PNG take next to no memory but time, and a few bytes may claim any number of them: what they unpack to may be
/// so many times what may be taken of memory. 1 GB, about 5 seconds, for any file: a map of one colour and 16384 x 16384
/// texels has 800 MB in a file of 800 KB.
void checkWork(ByteSpan bytes, std::uint64_t memory_limit_bytes) {
    constexpr std::uint64_t kTimesMemory = 16, kMost = std::uint64_t{1} << 56;
    const std::uint64_t memory = memory_limit_bytes != 0
                                     ? std::min(memory_limit_bytes, kMost)
                                     : MemoryBudget::kAnyFile + MemoryBudget::kPerByte * bytes.size();
    const std::uint64_t unpacked = flipUnpackedBytes(bytes);
    if (unpacked <= kTimesMemory * memory) return;
    const auto megabytes = [](std::uint64_t count) { return std::to_string(count >> 20) + " MB"; };
    failFile(ErrorCode::tooLarge, "it claims to unpack to " + megabytes(unpacked) + ", and " +
                                      (memory_limit_bytes != 0 ? "--memory-limit" : "a file of its size") + " allows " +
                                      megabytes(kTimesMemory * memory) +
                                      (memory_limit_bytes != 0 ? "" : " (--memory-limit allows more)"));
}

FlippedImage flip(ByteSpan bytes, const FlipGreenOptions& options) {
    const ImageFileFormat input = readableFormat(bytes), output = outputFormat(input, options);
    MemoryBudget budget(options.memory_limit_bytes);
    budget.allow(bytes.size());
    budget.require(flipWorkBytes(bytes), {});
    checkWork(bytes, options.memory_limit_bytes);
#ifdef TSPACE_HAS_IMAGES
    if (input == ImageFileFormat::png) {
        FlippedPng png = flipPng(bytes);
        FlippedImage result{std::move(png.bytes), {.format = output, .bits = png.bits}};
        const ImageSize size = claimOfPng(bytes).size;
        result.report.width = size.width;
        result.report.height = size.height;
        return result;
    }
#endif
    return flipPixels(bytes, input, output, options.jpeg_quality);
}

/// By the extension of the output's name.
ImageFileFormat namedFormat(const std::string& output) {
    const std::string extension = lowerExtension(output);
    if (extension == ".png") return ImageFileFormat::png;
    if (extension == ".jpg" || extension == ".jpeg") return ImageFileFormat::jpeg;
    if (extension == ".webp") return ImageFileFormat::webp;
    failFile(ErrorCode::unsupportedFile,
             "the output " + pathInQuotes(output) + " ends in none of .png, .jpg, .jpeg and .webp");
}

}  // namespace

std::uint64_t flipWorkBytes(ByteSpan bytes) {
    const ImageClaim claim = claimOf(bytes);
    switch (imageFormat(bytes)) {
        case ImageFormat::png: {
            // Rows of 4 channels of 16 bits, in and out, and those that filters look at. All of them where they come in
            // no order.
            constexpr std::size_t kInterlaceAt = 28;
            const std::uint64_t row_bytes = std::uint64_t{8} * claim.size.width;
            const bool is_interlaced = bytes.size() > kInterlaceAt && bytes[kInterlaceAt] != 0;
            return 12 * row_bytes + (is_interlaced ? row_bytes * claim.size.height : 0) + 2 * bytes.size();
        }
        case ImageFormat::jpeg:
            return claim.work_bytes + 3 * claim.size.pixels() + 2 * bytes.size();
        case ImageFormat::webp:
            return claim.work_bytes + 24 * claim.size.pixels();
        default:
            return 0;
    }
}

std::uint64_t flipUnpackedBytes(ByteSpan bytes) {
    constexpr std::size_t kBitsAt = 24, kColorAt = 25;
    if (imageFormat(bytes) != ImageFormat::png || bytes.size() <= kColorAt) return 0;
    const ImageSize size = claimOf(bytes).size;
    constexpr std::uint64_t kChannels[] = {1, 1, 3, 1, 2, 1, 4, 1};
    constexpr std::uint64_t kOfRow = 16;  // what a row takes beside its bytes
    const std::uint64_t pixel_bits = kChannels[bytes[kColorAt] & 7] * std::min<std::uint64_t>(bytes[kBitsAt], 16);
    return (size.width * pixel_bits / 8 + kOfRow) * size.height;
}

Result<FlippedImage> flipGreen(std::span<const std::uint8_t> image, const FlipGreenOptions& options) {
    return atFileBorder([&]() -> Result<FlippedImage> { return flip(image, options); });
}

Result<FlipGreenReport> flipGreenFile(const std::string& input, const std::string& output,
                                      const FlipGreenOptions& options) {
    return atFileBorder([&]() -> Result<FlipGreenReport> {
        FlipGreenOptions chosen = options;
        if (chosen.format == ImageFileFormat::sameAsInput && !options.sink) chosen.format = namedFormat(output);
        FlippedImage flipped =
            options.content.data() != nullptr ? flip(options.content, chosen) : flip(readFile(input), chosen);
        AtomicOutput files({.sink = options.sink, .is_dry_run = options.dry_run, .sync = options.sync});
        files.add(output, std::span<const std::uint8_t>(flipped.bytes));
        files.commit();
        return std::move(flipped.report);
    });
}

}  // namespace tspace
