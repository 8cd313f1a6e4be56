// SPDX-License-Identifier: MIT
// Converting one texel from one frame and reading to another, and the UVs of a side of a conversion.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "maps/layout/uv_coverage.h"
#include "maps/texels/shading.h"
#include "tspace/maps.h"

namespace tspace {

/// The numbers in which the output is stored.
struct TexelNumbers {
    unsigned bits = 16;       ///< 8, 16, or 32: no integers
    bool are_chosen = false;  ///< the integers are chosen later: what changes stays as it was computed
    [[nodiscard]] unsigned most() const { return (1U << bits) - 1; }  ///< largest integer value for 8 or 16 bits
};

struct ConvertedTexel {
    Vec3 texel = {};
    double change_deg = 0;  ///< between what it shows, and what the texel before would show on the new side
    bool is_below_horizon = false;
    bool stays = false;  ///< but for green: both sides read it alike, and integers stand for it
};

/// The nearest channels for a vector as an image stores it.
Vec3 channelsOf(const DVec3& stored, const TexelNumbers& numbers);

/// Returns nothing if there is no solution: a singular or non-finite frame, or a texel without direction.
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

// The error of a map that was converted from one set of frames to another.

/// The frame of a side of a conversion at a point of a triangle.
ShadingFrame sideFrame(const MapSide& side, std::size_t triangle, const std::array<double, 3>& weights);

/// Angles at points of all triangles, one for each texel that a triangle shows, filtered as renderers do.
struct CarriedError {
    double mean_deg = 0;              ///< between the new map on the new frames and the old one on the old
    double mean_unconverted_deg = 0;  ///< between the old map on the new frames and on the old
    std::uint64_t count = 0;          ///< 0: no triangle has such a point, or frames there
};

/// `from` and `to` have the same triangles in the same order, in tangent space. `converted`: as many texels as `map`
/// has. Time: linear in the texels that triangles show. Equal results for any number of threads.
CarriedError measureCarried(const MapImage& map, std::span<const Vec3> converted, const MapSide& from,
                            const MapSide& to, Parallel& parallel);

}  // namespace tspace
