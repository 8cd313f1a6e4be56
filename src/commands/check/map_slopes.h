// SPDX-License-Identifier: MIT
// What a map holds, by its texels and by its slopes: x and y of a normal map are the slopes of a height field, and only under
// the correct reading of the channels do their derivatives agree (GreenBlocks).
#pragma once

#include <cstdint>
#include <span>

#include "commands/check/map_content.h"
#include "images/image.h"
#include "maps/layout/uv_coverage.h"
#include "tspace/map_files.h"

namespace tspace {

/// A decoded map. It knows no model.
struct DecodedMap {
    const RgbImage& image;
    std::span<const std::uint8_t> alpha = {};  ///< one per pixel; empty: none, or opaque
    const TexelMask& inside;                   ///< the texels that triangles show
    const MapLayout* declared = nullptr;       ///< layout that a texture file declares; null for PNG, JPEG and WebP
};

/// Judges what the map holds. `surface` and `in_world` as for lookAtTexels.
MapLook lookAtMap(const DecodedMap& map, std::span<const TexelOnSurface> surface = {},
                  std::span<const TexelOnSurface> in_world = {});

/// The reading whose height field is -h: x and y are both negated, so bumps are dents. Slopes do not tell it from `layout`.
MapLayout invertedRelief(MapLayout layout);

/// Whether red and green are exchanged and one of them is negated, as in an image that was turned by 90 or 270 degrees
/// without its vectors. `is_y_inverted`: under the layout of `look`.
bool isTurned(const MapLook& look, bool is_y_inverted);

}  // namespace tspace
