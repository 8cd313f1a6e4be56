// SPDX-License-Identifier: MIT
// Input and output formats, and the memory needed for flipping.
#include "images/flip_green.h"

#include <algorithm>
#include <utility>

#include "images/codecs.h"
#include "images/image.h"

namespace tspace {

ImageFileFormat fileFormat(ImageFormat input) {
    switch (input) {
        case ImageFormat::png: return ImageFileFormat::png;
        case ImageFormat::jpeg: return ImageFileFormat::jpeg;
        case ImageFormat::webp: return ImageFileFormat::webp;
        case ImageFormat::ktx2: return ImageFileFormat::ktx2;
        case ImageFormat::dds: return ImageFileFormat::dds;
        default: return ImageFileFormat::sameAsInput;
    }
}

namespace {

/// Determines the format by content. Fails for formats that this build cannot read.
Result<ImageFileFormat> readableFormat(ByteSpan bytes) {
    const ImageFormat format = imageFormat(bytes);
    if (const char* why_not = whyNotRead(format)) return Error{ErrorCode::unsupportedFile, why_not};
    if (format == ImageFormat::exr)
        return Error{ErrorCode::unsupportedFile,
                     "the image is EXR; use convertMapFile (tspace convert-map) to invert its green channel"};
    if (format == ImageFormat::tga)
        return Error{ErrorCode::unsupportedFile,
                     "a TGA can only be written as PNG here; use convertMapFile (tspace convert-map) to write a TGA"};
    return fileFormat(format);
}

Result<ImageFileFormat> outputFormat(ImageFileFormat input, const FlipGreenOptions& options) {
    if (options.jpeg_quality < 1 || options.jpeg_quality > 100)
        return Error{ErrorCode::invalidOption, "the JPEG quality must be from 1 to 100"};
    const ImageFileFormat format = options.format == ImageFileFormat::sameAsInput ? input : options.format;
    if (format != input && format != ImageFileFormat::png) {
        return Error{ErrorCode::unsupportedFile,
                     "converting to the format of the output may lose data; write the format of the input, or PNG"};
    }
    if (format == ImageFileFormat::png && whyNotRead(ImageFormat::png) != nullptr)
        return Error{ErrorCode::unsupportedFile, whyNotRead(ImageFormat::png)};
    return format;
}

void invertGreen(ChannelImage& image) {
    for (std::size_t i = 1; i < image.pixels.size(); i += image.channels) image.pixels[i] ^= 0xff;
}

#if defined(TSPACE_HAS_IMAGES) && !defined(TSPACE_SMALL)
Result<FlippedImage> flipTgaToPng(ByteSpan bytes) {
    std::string why;
    std::optional<TgaImage> tga = decodeTgaPixels(bytes, ~std::uint64_t{0}, why);
    if (!tga) return Error{ErrorCode::invalidFile, why};
    if (tga->is_gray) return Error{ErrorCode::unsupportedFile, "the TGA is gray, so it has no separate green channel"};
    ChannelImage image{tga->image.width, tga->image.height, 3, std::move(tga->image.rgb)};
    if (!tga->alpha.empty()) {
        const std::vector<std::uint8_t> rgb = std::move(image.pixels);
        image.channels = 4;
        image.pixels = {};
        image.pixels.reserve(4 * tga->alpha.size());
        for (std::size_t i = 0; i < tga->alpha.size(); ++i)
            image.pixels.insert(image.pixels.end(), {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], tga->alpha[i]});
    }
    invertGreen(image);
    Result<std::vector<std::uint8_t>> written = writePng(image);
    if (!written) return written.error();
    return FlippedImage{*std::move(written),
                        {.format = ImageFileFormat::png, .width = image.width, .height = image.height}};
}
#endif

/// Decodes the pixels of a JPEG or WebP.
Result<ChannelImage> readPixels([[maybe_unused]] ByteSpan bytes, [[maybe_unused]] ImageFileFormat format) {
#ifdef TSPACE_HAS_IMAGES
    if (format == ImageFileFormat::jpeg) return readJpegPixels(bytes);
#endif
#ifdef TSPACE_HAS_WEBP
    if (format == ImageFileFormat::webp) return readWebpPixels(bytes);
#endif
    return Error{ErrorCode::unsupportedFile, whyNotRead(ImageFormat::unknown)};
}

/// Encodes pixels. `like`: the file that the pixels were read from.
Result<std::vector<std::uint8_t>> writePixels([[maybe_unused]] const ChannelImage& image,
                                              [[maybe_unused]] ImageFileFormat format,
                                              [[maybe_unused]] int jpeg_quality, [[maybe_unused]] ByteSpan like) {
#ifdef TSPACE_HAS_IMAGES
    if (format == ImageFileFormat::png) return writePng(image);
    if (format == ImageFileFormat::jpeg) return writeJpeg(image, jpeg_quality, like);
#endif
#ifdef TSPACE_HAS_WEBP
    if (format == ImageFileFormat::webp) return writeWebp(image);
#endif
    return Error{ErrorCode::unsupportedFile, whyNotRead(ImageFormat::unknown)};
}

Result<FlippedImage> flipPixels(ByteSpan bytes, ImageFileFormat input, ImageFileFormat output, int jpeg_quality) {
    Result<ChannelImage> image = readPixels(bytes, input);
    if (!image) return image.error();
    invertGreen(*image);
    Result<std::vector<std::uint8_t>> written = writePixels(*image, output, jpeg_quality, bytes);
    if (!written) return written.error();
    FlippedImage result{*std::move(written), {.format = output, .width = image->width, .height = image->height}};
    if (output == ImageFileFormat::jpeg) {
        result.report.is_exact = false;
        result.report.warnings.push_back(
            "the JPEG was recompressed, which rounds its texels again; a PNG would be exact");
    }
    return result;
}

}  // namespace

std::uint64_t flipWorkBytes(ByteSpan bytes) {
    const ImageClaim claim = claimOf(bytes);
    switch (imageFormat(bytes)) {
        case ImageFormat::png: {
            // Memory of input and output rows of 4 channels with 16 bits, and of the rows that filters need; for an
            // interlaced image also of all rows.
            constexpr std::size_t kInterlaceAt = 28;
            const std::uint64_t row_bytes = std::uint64_t{8} * claim.size.width;
            const bool is_interlaced = bytes.size() > kInterlaceAt && bytes[kInterlaceAt] != 0;
            return 12 * row_bytes + (is_interlaced ? row_bytes * claim.size.height : 0) + 2 * bytes.size();
        }
        case ImageFormat::jpeg: return claim.work_bytes + 3 * claim.size.pixels() + 2 * bytes.size();
        case ImageFormat::webp: return claim.work_bytes + 24 * claim.size.pixels();
        case ImageFormat::ktx2:
        case ImageFormat::dds:
        case ImageFormat::tga: return claim.work_bytes + 24 * claim.size.pixels();
        default: return 0;
    }
}

std::uint64_t flipUnpackedBytes(ByteSpan bytes) {
    constexpr std::size_t kBitsAt = 24, kColorAt = 25;
    if (imageFormat(bytes) != ImageFormat::png || bytes.size() <= kColorAt) return 0;
    const ImageSize size = claimOf(bytes).size;
    constexpr std::uint64_t kChannels[] = {1, 1, 3, 1, 2, 1, 4, 1};
    constexpr std::uint64_t kOfRow = 16;  // bookkeeping bytes per row
    const std::uint64_t pixel_bits = kChannels[bytes[kColorAt] & 7] * std::min<std::uint64_t>(bytes[kBitsAt], 16);
    return (size.width * pixel_bits / 8 + kOfRow) * size.height;
}

Result<FlippedImage> flipImage(ByteSpan bytes, const FlipGreenOptions& options) {
#if defined(TSPACE_HAS_IMAGES) && !defined(TSPACE_SMALL)
    if (options.format == ImageFileFormat::png && imageFormat(bytes) == ImageFormat::tga) return flipTgaToPng(bytes);
#endif
    const Result<ImageFileFormat> input = readableFormat(bytes);
    if (!input) return input.error();
    const Result<ImageFileFormat> output = outputFormat(*input, options);
    if (!output) return output.error();
#ifdef TSPACE_HAS_IMAGES
    if (*input == ImageFileFormat::png) {
        Result<FlippedPng> png = flipPng(bytes);
        if (!png) return png.error();
        const ImageSize size = claimOfPng(bytes).size;
        return FlippedImage{std::move(png->bytes),
                            {.format = *output, .width = size.width, .height = size.height, .bits = png->bits}};
    }
#endif
    const bool is_texture = *input == ImageFileFormat::ktx2 || *input == ImageFileFormat::dds;
    if (is_texture && *output == *input) return flipTexture(bytes, *input);
    return flipPixels(bytes, *input, *output, options.jpeg_quality);
}

}  // namespace tspace
