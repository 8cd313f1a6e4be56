// SPDX-License-Identifier: MIT
// flipGreen and flipGreenFile: formats in and out, limits, files.
#include "maps/flip_green.h"

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

FlippedImage flip(ByteSpan bytes, const FlipGreenOptions& options) {
    const ImageFileFormat input = readableFormat(bytes), output = outputFormat(input, options);
    MemoryBudget budget(options.memory_limit_bytes);
    budget.allow(bytes.size());
    budget.require(flipWorkBytes(bytes), {});
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
