// SPDX-License-Identifier: MIT
// Images as numbers: what normal maps are read into and written from. Linear; colour spaces are not looked at.
#pragma once

#include <optional>

#include "images/image.h"
#include "images/pixels.h"

namespace tspace {

/// Bytes per pixel that decoding, converting and packing a map hold, without the decoder's own.
inline constexpr std::uint64_t kMapPixelBytes = 72;
/// Larger images of a model are not written anew.
inline constexpr std::uint64_t kMostModelMapPixels = std::uint64_t{1} << 26;

/// Whether it is a WebP that was packed as photographs are.
bool isLossyWebp(ByteSpan bytes);

/// Reads only the header, so nothing is guessed; returns nothing for other files and unsupported formats.
std::optional<TextureFacts> textureFacts(ByteSpan bytes);

/// decodeImage with all bits of the file. Memory: 16 bytes a pixel, or 12 without alpha, and the decoder's.
std::optional<FloatImage> decodeFloatImage(ByteSpan bytes, std::uint64_t most_pixels, std::string& why,
                                           ImageUse use = ImageUse::vectors);

/// An EXR with channels of 16 (half) or 32 bits, packed without loss. All are finite. Nothing where it is out of memory.
/// whyNotRead(ImageFormat::exr) must be null.
std::optional<std::vector<std::uint8_t>> encodeExr(const FloatImage& image, unsigned bits);

/// A PNG of 8 or 16 bits without a word on colours: each channel clamped to 0 to 1, then rounded to the nearest integer
/// (not finite: 0). Nothing where this build writes no PNG or libspng fails.
std::optional<std::vector<std::uint8_t>> encodePng(const FloatImage& image, unsigned bits);
/// encodePng for bytes.
std::optional<std::vector<std::uint8_t>> encodePng(const RgbImage& image);

}  // namespace tspace
