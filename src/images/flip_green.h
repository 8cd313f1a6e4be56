// SPDX-License-Identifier: MIT
// Inverting the green channel of encoded images, format by format. An error's message is half a sentence: "it is a broken PNG".
#pragma once

#include "images/image.h"
#include "tspace/images.h"

namespace tspace {

/// Pixels of 3 or 4 channels, 8 bits each; the first row is the top one.
struct ChannelImage {
    std::uint32_t width = 0, height = 0;
    unsigned channels = 3;
    std::vector<std::uint8_t> pixels = {};
};

/// The memory that flipping takes, beside the input and the output.
std::uint64_t flipWorkBytes(ByteSpan bytes);
/// The bytes that the rows of a PNG unpack to, by its header, and 16 bytes more for each row: a measure of the time
/// that flipping takes. 0 for other formats, all of whose pixels are in memory.
std::uint64_t flipUnpackedBytes(ByteSpan bytes);

/// flipGreen without the check of memory. Reads format and jpeg_quality of `options`.
Result<FlippedImage> flipImage(ByteSpan bytes, const FlipGreenOptions& options);

/// A PNG with its green channel inverted, and all else as it was.
struct FlippedPng {
    std::vector<std::uint8_t> bytes = {};
    std::uint32_t bits = 8;
};
Result<FlippedPng> flipPng(ByteSpan bytes);

/// A KTX2 or DDS with its green channel, or the one that holds y, inverted in all levels, and all else as it was. `format`: of the
/// file. Fails where the format cannot hold that exactly.
Result<FlippedImage> flipTexture(ByteSpan bytes, ImageFileFormat format);

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
