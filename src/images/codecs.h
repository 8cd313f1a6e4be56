// SPDX-License-Identifier: MIT
// One interface to all image libraries. Reasons (`why`) are half a sentence: "it is a broken PNG".
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "images/pixels.h"
#include "tspace/result.h"

namespace tspace {

/// A few bytes may claim any number of pixels. What is honest is rarely more than 64 times as large as its file.
bool isTooLarge(ImageSize size, std::size_t byte_count, std::uint64_t most_pixels, std::string& why);

/// The size that a file's header claims, read without a library and without any check, and the memory that decoding it
/// takes.
struct ImageClaim {
    ImageSize size = {};
    std::uint64_t work_bytes = 0;
};

/// The claim of a file of any format; nothing where this build does not decode it.
ImageClaim claimOf(ByteSpan bytes);
ImageClaim claimOfPng(ByteSpan bytes);
ImageClaim claimOfJpeg(ByteSpan bytes);
ImageClaim claimOfWebp(ByteSpan bytes);
ImageClaim claimOfExr(ByteSpan bytes);
ImageClaim claimOfTexture(ByteSpan bytes);

std::optional<RgbImage> decodePng(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
/// decodeFloatImage for PNG; samples of fewer than 16 bits are widened by repeating their bits, which keeps n /
/// largest.
std::optional<FloatImage> decodeDeepPng(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
/// Four channels; nothing where it is broken or has no alpha.
std::vector<std::uint8_t> decodePngRgba(ByteSpan bytes);
std::optional<RgbImage> decodeJpeg(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
std::optional<RgbImage> decodeWebp(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);

/// KTX2 and DDS: their first level, or another one.
std::optional<RgbImage> decodeTexture(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse use);
std::optional<FloatImage> decodeFloatTexture(ByteSpan bytes, std::uint64_t most_pixels, std::string& why,
                                             std::size_t level = 0, ImageUse use = ImageUse::vectors);
/// One byte a pixel; nothing where it is broken or has no alpha.
std::vector<std::uint8_t> decodeTextureAlpha(ByteSpan bytes);

/// Decides by the header alone: every field must be valid, and the file long enough for it.
bool isTga(ByteSpan bytes);
ImageClaim claimOfTga(ByteSpan bytes);
std::optional<RgbImage> decodeTga(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
struct TgaImage {
    RgbImage image = {};
    std::vector<std::uint8_t> alpha = {};  ///< one byte a pixel, or empty: opaque
    bool is_grey = false;
};
std::optional<TgaImage> decodeTgaPixels(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);

/// Whether OpenEXR is there at run time; without it nothing else of EXR may be called but claimOfExr.
bool hasOpenExr();
std::optional<FloatImage> decodeExr(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse use);

/// Makes floats as a file stores them finite and, where they are read as vectors and look like vectors from -1 to 1, moves them to
/// 0 to 1. Sets not_finite and range_text.
void readFloats(ImageUse use, FloatImage& image);
/// Rounds to 8 bits a channel.
RgbImage roundedImage(const FloatImage& image);

// Pixels of a PNG out and in again; its chunks are in flip_png.cpp. Bindings have other decoders in the place of
// libspng.

struct PngHeader {
    /// Colour types.
    static constexpr std::uint8_t kPalette = 3, kHasColor = 2, kHasAlpha = 4;

    std::uint32_t width = 0, height = 0;
    std::uint8_t bits = 8, color = kHasColor;
    bool is_interlaced = false;

    [[nodiscard]] std::size_t channels() const { return (color & kHasAlpha) != 0 ? 4 : 3; }
    [[nodiscard]] std::size_t rowBytes() const { return channels() * (bits / 8) * width; }
};

Error brokenPng();

/// The number of 4 bytes that begins at `at`, which there must be.
std::uint32_t pngNumber(ByteSpan bytes, std::size_t at);

/// 255 - x and 65535 - x are x with all bits inverted. `step`: bytes from one green to the next.
void invertGreenSamples(std::span<std::uint8_t> bytes, std::size_t step, std::size_t sample_bytes);

/// The pixels of a PNG of RGB or RGBA, green inverted, as a PNG of the same header.
Result<std::vector<std::uint8_t>> packInverted(ByteSpan bytes, const PngHeader& header);

/// An error (or code ok) where the pixels of a PNG with a palette are broken.
Error checkPixels(ByteSpan bytes, const PngHeader& header);

/// Pixels of a JPEG or WebP. Fails for grey images, and for those that are broken or animated.
Result<ChannelImage> readJpegPixels(ByteSpan bytes);
Result<ChannelImage> readWebpPixels(ByteSpan bytes);

Result<std::vector<std::uint8_t>> writePng(const ChannelImage& image);
/// `like`: the JPEG whose Exif data, profile and comments it gets.
Result<std::vector<std::uint8_t>> writeJpeg(const ChannelImage& image, int quality, ByteSpan like);
/// `packed`, which begins as JPEG files do, with those of `like`.
std::vector<std::uint8_t> joinJpeg(ByteSpan packed, ByteSpan like);
/// Without loss, also where it is transparent.
Result<std::vector<std::uint8_t>> writeWebp(const ChannelImage& image);

}  // namespace tspace
