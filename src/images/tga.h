// SPDX-License-Identifier: MIT
// TGA: 8 bits a channel, not packed. Written alone; see docs/reference/image-files.md.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "images/float_image.h"

namespace tspace {

/// A TGA of 24 bits a pixel, or of 32 where there is alpha, its first row the top one. Channels are rounded as encodePng's.
/// Nothing for more than 65,535 pixels along a side, which the format cannot say.
std::optional<std::vector<std::uint8_t>> encodeTga(const FloatImage& image);
std::optional<std::vector<std::uint8_t>> encodeTga(const RgbImage& image);

}  // namespace tspace
