// SPDX-License-Identifier: MIT
// Converting one texel from one frame and reading to another, and the UVs of a side of a conversion.
#pragma once

#include <optional>

#include "core/base/memory.h"
#include "maps/shading.h"
#include "maps/uv_coverage.h"
#include "tspace/map_convert.h"

namespace tspace {

/// The numbers in which the output is stored.
struct TexelNumbers {
    unsigned bits = 16;  ///< 8, 16, or 32: no integers
    /// With 8 bits: the angle to the texels around, in radians. Filtering gives a longer one more weight among them.
    double spread = 0;
    [[nodiscard]] unsigned most() const { return (1U << bits) - 1; }  ///< of 8 or 16
};

struct ConvertedTexel {
    Vec3 texel = {};
    double change_deg = 0;  ///< between what it shows, and what the texel before would show on the new side
    bool is_below_horizon = false;
};

/// The nearest channels for a vector as an image stores it.
Vec3 channelsOf(const DVec3& stored, const TexelNumbers& numbers);

/// Nothing where there is no answer: a frame that is singular or not finite, a texel without direction.
std::optional<ConvertedTexel> convertTexel(const Vec3& texel, const ShadingFrame& from, const MapReading& from_reading,
                                           const ShadingFrame& to, const MapReading& to_reading,
                                           const TexelNumbers& numbers);

/// The UVs of a side of a conversion, one per corner, as a list of triangles.
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
