// SPDX-License-Identifier: MIT
// Detects the content of a map from its texels and its slopes. x and y of a normal map are the slopes of a height
// field, and their derivatives agree only if the channels are interpreted correctly (GreenBlocks).
#pragma once

#include <cstdint>
#include <span>

#include "commands/check/map_content.h"
#include "images/image.h"
#include "maps/layout/uv_coverage.h"
#include "tspace/map_files.h"

namespace tspace {

/// A decoded map, independent of a model.
struct DecodedMap {
    const RgbImage& image;
    std::span<const std::uint8_t> alpha = {};  ///< one per pixel; empty: none, or opaque
    const TexelMask& inside;                   ///< texels that triangles cover
    const MapLayout* declared = nullptr;       ///< layout that a texture file declares; null for PNG, JPEG and WebP
};

/// Detects the content of the map. `surface` and `in_world`: see analyzeTexels.
MapAnalysis analyzeMap(const DecodedMap& map, std::span<const TexelOnSurface> surface = {},
                       std::span<const TexelOnSurface> in_world = {});

/// Returns the layout whose height field is -h: x and y are both negated, so bumps become dents. Slopes cannot
/// distinguish it from `layout`.
MapLayout invertedRelief(MapLayout layout);

/// Returns whether red and green are exchanged and one of them is negated, as in an image that was rotated by 90 or 270
/// degrees without its vectors. `is_y_inverted`: y is inverted under the layout of `analysis`.
bool isRotated(const MapAnalysis& analysis, bool is_y_inverted);

}  // namespace tspace
