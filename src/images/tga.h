// SPDX-License-Identifier: MIT
// Writes uncompressed TGA with 8 bits per channel; docs/reference/image-files.md describes the format.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "images/float_image.h"

namespace tspace {

/// Encodes a TGA with 24 bits per pixel, or 32 with alpha; the first row is the top row. Channels are rounded as by
/// encodePng. Returns nullopt for sides of more than 65,535 pixels, which the format does not support.
std::optional<std::vector<std::uint8_t>> encodeTga(const FloatImage& image);
std::optional<std::vector<std::uint8_t>> encodeTga(const RgbImage& image);

}  // namespace tspace
