// SPDX-License-Identifier: MIT
// Inverts the green channel of encoded images, by format. Error messages are clauses, such as "the PNG is damaged".
#pragma once

#include "images/pixels.h"
#include "tspace/map_files.h"

namespace tspace {

/// Returns the memory that flipping needs in addition to input and output.
std::uint64_t flipWorkBytes(ByteSpan bytes);
/// Returns the decompressed size of the rows of a PNG according to its header, plus 16 bytes per row: a measure of the
/// time that flipping takes. Returns 0 for other formats, which are decoded completely in memory.
std::uint64_t flipUnpackedBytes(ByteSpan bytes);

/// Returns the default output format of flipping; sameAsInput for formats that flipping cannot write (it then writes
/// PNG or fails).
ImageFileFormat fileFormat(ImageFormat input);

/// Inverts green like flipGreen, without the memory check. Uses format and jpeg_quality of `options`.
Result<FlippedImage> flipImage(ByteSpan bytes, const FlipGreenOptions& options);

/// PNG with inverted green, and everything else unchanged.
struct FlippedPng {
    std::vector<std::uint8_t> bytes = {};
    std::uint32_t bits = 8;
};
Result<FlippedPng> flipPng(ByteSpan bytes);

/// Returns a KTX2 or DDS with green, or the channel that holds y, inverted in all levels, and everything else
/// unchanged. `format`: format of the file. Fails if the format cannot represent the result exactly.
Result<FlippedImage> flipTexture(ByteSpan bytes, ImageFileFormat format);

}  // namespace tspace
