// SPDX-License-Identifier: MIT
// Images as floats: decoded normal maps, and input of the encoders. Color spaces are ignored: values are used as
// stored.
#pragma once

#include <optional>

#include "images/image.h"
#include "images/pixels.h"

namespace tspace {

/// Bytes per pixel needed for decoding, converting and encoding a map, without the decoder's own memory.
inline constexpr std::uint64_t kMapPixelBytes = 72;
/// Maximum number of pixels of a model's image that is rewritten; larger images are kept unchanged.
inline constexpr std::uint64_t kMaxModelMapPixels = std::uint64_t{1} << 26;

/// Returns whether the file is a lossy WebP.
bool isLossyWebp(ByteSpan bytes);

/// Returns the texture properties that a file's header declares; the texels are not examined. Returns nullopt for other
/// files and unsupported formats.
std::optional<TextureFacts> textureFacts(ByteSpan bytes);

/// Decodes an image like decodeImage, but with all bits of the file. Memory: 16 bytes per pixel, or 12 without alpha,
/// plus the decoder's memory.
std::optional<FloatImage> decodeFloatImage(ByteSpan bytes, std::uint64_t most_pixels, std::string& why,
                                           ImageUse use = ImageUse::vectors);

/// Encodes an EXR with channels of 16 (half) or 32 bits, with lossless compression. All values must be finite. Returns
/// nullopt if memory runs out. Requires whyNotRead(ImageFormat::exr) == nullptr.
std::optional<std::vector<std::uint8_t>> encodeExr(const FloatImage& image, unsigned bits);

inline constexpr unsigned kMaxPngBits = 16;  ///< maximum bits per channel of a PNG
/// Encodes a PNG with 8 or 16 bits, without color space information: each channel is clamped to 0 to 1 and rounded to
/// the nearest integer (not finite: 0). Returns nullopt if this build cannot write PNG, or if libspng fails.
std::optional<std::vector<std::uint8_t>> encodePng(const FloatImage& image, unsigned bits);
/// Encodes an 8-bit image as PNG, without color space information. Returns nullopt if this build cannot write PNG, or
/// if libspng fails.
std::optional<std::vector<std::uint8_t>> encodePng(const RgbImage& image);

}  // namespace tspace
