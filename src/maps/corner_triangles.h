// SPDX-License-Identifier: MIT
// UVs of corners as a list of triangles.
#pragma once

#include "core/base/memory.h"
#include "maps/uv_coverage.h"
#include "tspace/map_convert.h"

namespace tspace {

struct CornerTriangles {
    CornerTriangles(const MapSide& side, const Allocator* allocator)
        : uvs(allocator, side.uvs.count), corners(allocator, side.uvs.count) {
        for (std::size_t i = 0; i < uvs.size(); ++i) {
            uvs[i] = side.uvs[i];
            corners[i] = static_cast<std::uint32_t>(i);
        }
    }

    [[nodiscard]] UvTriangles triangles(TextureWrap wrap_u, TextureWrap wrap_v) const {
        return {.corners = {corners.data(), corners.size()},
                .uvs = {uvs.data(), uvs.size()},
                .wrap_u = wrap_u,
                .wrap_v = wrap_v};
    }
    [[nodiscard]] UvTriangles triangles(const MapImage& map) const { return triangles(map.wrap_u, map.wrap_v); }

    Buffer<Vec2> uvs;
    Buffer<std::uint32_t> corners;
};

}  // namespace tspace
