// SPDX-License-Identifier: MIT
// Inverting the green channel of encoded images, format by format. An error's message is half a sentence: "it is a broken PNG".
#pragma once

#include "images/pixels.h"
#include "tspace/map_files.h"

namespace tspace {

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

}  // namespace tspace
