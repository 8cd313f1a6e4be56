// SPDX-License-Identifier: MIT
// Which texels of an image the triangles of a UV map show.
#pragma once

#include <cstdint>
#include <span>

#include "maps/texel_mask.h"
#include "tspace/texture_wrap.h"
#include "tspace/vec.h"

namespace tspace {

/// Triangles as a texture is read with them.
struct UvTriangles {
    std::span<const std::uint32_t> corners = {};  ///< three per triangle, each smaller than uvs.size()
    std::span<const Vec2> uvs = {};               ///< one per vertex, after any transform; v runs down
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
};

/// Adds to the mask each texel whose centre lies inside of a triangle or on its edge. UVs are rounded to 1/256 texel,
/// and from there on all is exact: triangles that share an edge leave no gap. Outside of 0 to 1 the image goes on as
/// the wrap modes say. Triangles with UVs that are not finite, or that repeat the image more than 64 times, are left
/// out, and so is what shows the edge of a clamped image alone.
///
/// steps    how much work is left: a step is a row of a triangle, or 64 texels of one. Each takes some nanoseconds, and
///          kCoverSteps is more than sound models need
///
/// False where the steps ran out, as they do for hostile UV maps: the mask then has all texels.
bool coverTexels(const UvTriangles& triangles, TexelMask& mask, std::uint64_t& steps);

inline constexpr std::uint64_t kCoverSteps = std::uint64_t{1} << 26;

}  // namespace tspace
