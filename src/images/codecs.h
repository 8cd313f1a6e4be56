// SPDX-License-Identifier: MIT
// Common interface to all image libraries. Reasons (`why`) are clauses, such as "the PNG is damaged".
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

/// Returns whether an image has more than `most_pixels` pixels, or far more than its file can contain: a few bytes may
/// declare any number of pixels, but valid large images rarely have more than 64 pixels per byte.
bool isTooLarge(ImageSize size, std::size_t byte_count, std::uint64_t most_pixels, std::string& why);

/// Size declared in the header of a file (read without a library, and not verified), and the memory that decoding
/// needs.
struct ImageClaim {
    ImageSize size = {};
    std::uint64_t work_bytes = 0;
};

/// Returns the declared size and the memory of a file in any format; zeros if this build cannot decode it.
ImageClaim claimOf(ByteSpan bytes);
ImageClaim claimOfPng(ByteSpan bytes);
ImageClaim claimOfJpeg(ByteSpan bytes);
ImageClaim claimOfWebp(ByteSpan bytes);
ImageClaim claimOfExr(ByteSpan bytes);
ImageClaim claimOfTexture(ByteSpan bytes);

std::optional<RgbImage> decodePng(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
/// Decodes a PNG to floats with all bits of the file. Samples of fewer than 16 bits are widened by repeating their
/// bits, which preserves the ratio to the largest value.
std::optional<FloatImage> decodeDeepPng(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
/// Decodes a PNG to red, green, blue and alpha, 8 bits each. Returns an empty array if the file is corrupt or has no
/// alpha.
std::vector<std::uint8_t> decodePngRgba(ByteSpan bytes);
std::optional<RgbImage> decodeJpeg(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
std::optional<RgbImage> decodeWebp(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);

/// Decode the first mip level of a KTX2 or DDS file; decodeFloatTexture can decode another level.
std::optional<RgbImage> decodeTexture(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse use);
std::optional<FloatImage> decodeFloatTexture(ByteSpan bytes, std::uint64_t most_pixels, std::string& why,
                                             std::size_t level = 0, ImageUse use = ImageUse::vectors);
/// Decodes the alpha channel of a texture to one byte per pixel. Returns an empty array if the file is corrupt or has
/// no alpha.
std::vector<std::uint8_t> decodeTextureAlpha(ByteSpan bytes);

/// Checks the header only: every field must be valid, and the file long enough for the image.
bool isTga(ByteSpan bytes);
ImageClaim claimOfTga(ByteSpan bytes);
std::optional<RgbImage> decodeTga(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
struct TgaImage {
    RgbImage image = {};
    std::vector<std::uint8_t> alpha = {};  ///< one byte per pixel; empty if the image is opaque
    bool is_gray = false;
};
std::optional<TgaImage> decodeTgaPixels(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);

/// Returns whether OpenEXR is available at run time; otherwise claimOfExr is the only EXR function that may be called.
bool hasOpenExr();
std::optional<FloatImage> decodeExr(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse use);

/// Fills texels that are not finite from their neighbors. If the floats are used as vectors and their range is -1 to 1,
/// maps them to 0 to 1, and alpha too if some of it is below 0. Sets not_finite and range_text.
void readFloats(ImageUse use, FloatImage& image);

// Decoding and encoding of PNG pixels; flip_png.cpp handles the chunks. The bindings use other decoders than libspng.

struct PngHeader {
    /// Color types in a PNG header: kPalette is the type of an image with a palette; the other constants are flags.
    static constexpr std::uint8_t kPalette = 3, kHasColor = 2, kHasAlpha = 4;

    std::uint32_t width = 0, height = 0;
    std::uint8_t bits = 8, color = kHasColor;
    bool is_interlaced = false;

    [[nodiscard]] std::size_t channels() const { return (color & kHasAlpha) != 0 ? 4 : 3; }
    [[nodiscard]] std::size_t rowBytes() const { return channels() * (bits / 8) * width; }
};

Error brokenPng();

/// Returns the 4-byte number at `at`, which must be inside the data.
std::uint32_t pngNumber(ByteSpan bytes, std::size_t at);

/// Inverts green samples in place by inverting all their bits, which computes 255 - x or 65535 - x. `step`: distance in
/// bytes between green samples.
void invertGreenSamples(std::span<std::uint8_t> bytes, std::size_t step, std::size_t sample_bytes);

/// Recompresses an RGB or RGBA PNG with the green channel inverted. The header stays the same.
Result<std::vector<std::uint8_t>> packInverted(ByteSpan bytes, const PngHeader& header);

/// Returns an error if the pixels of a PNG with a palette are corrupt, otherwise ErrorCode::ok.
Error checkPixels(ByteSpan bytes, const PngHeader& header);

/// Decode the pixels of a JPEG or WebP. Fail for gray images, and for corrupt or animated ones.
Result<ChannelImage> readJpegPixels(ByteSpan bytes);
Result<ChannelImage> readWebpPixels(ByteSpan bytes);

Result<std::vector<std::uint8_t>> writePng(const ChannelImage& image);
/// Encodes a JPEG. `like`: JPEG whose Exif data, color profile and comments are copied.
Result<std::vector<std::uint8_t>> writeJpeg(const ChannelImage& image, int quality, ByteSpan like);
/// Returns the JPEG `packed` with the metadata of `like`.
std::vector<std::uint8_t> joinJpeg(ByteSpan packed, ByteSpan like);
/// Encodes losslessly, including the colors of transparent pixels.
Result<std::vector<std::uint8_t>> writeWebp(const ChannelImage& image);

}  // namespace tspace
