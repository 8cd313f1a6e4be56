// SPDX-License-Identifier: MIT
// One interface to all image libraries. Reasons (`why`) are half a sentence: "it is a broken PNG".
#pragma once

#include "images/float_image.h"
#include "images/image.h"

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

/// KTX2 and DDS: their first level.
std::optional<RgbImage> decodeTexture(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
std::optional<FloatImage> decodeFloatTexture(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);
/// One byte a pixel; nothing where it is broken or has no alpha.
std::vector<std::uint8_t> decodeTextureAlpha(ByteSpan bytes);

/// Whether OpenEXR is there at run time; without it nothing else of EXR may be called but claimOfExr.
bool hasOpenExr();
std::optional<FloatImage> decodeExr(ByteSpan bytes, std::uint64_t most_pixels, std::string& why);

}  // namespace tspace
