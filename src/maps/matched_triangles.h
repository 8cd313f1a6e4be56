// SPDX-License-Identifier: MIT
// Which triangle of one mesh is which of another, where both are one surface with the same UVs.
#pragma once

#include "core/base/memory.h"
#include "maps/texel_triangles.h"
#include "tspace/map_convert.h"

namespace tspace {

/// For each triangle of `side` the one of `other` with the same UVs and, where both have them, positions, or kNoTriangle. Corners
/// may begin elsewhere, but run the same way round. Of several with the same corners each is matched once, in order.
/// O(n log n).
Buffer<std::uint32_t> matchTriangles(const MapSide& side, const MapSide& other, const Allocator* allocator);

/// For texels inside of triangles of both, which may lie over each other: takes the triangle of `other` that is nearest in
/// space to where `places` has the texel on `side`. Both have positions.
void chooseByPosition(const MapSide& side, const UvTriangles& triangles, const TexelTriangles& places,
                      const MapSide& other, const UvTriangles& other_triangles, TexelTriangles& other_places,
                      const Allocator* allocator);

}  // namespace tspace
