// SPDX-License-Identifier: MIT
// Edges at which the faces of a low poly meet at an angle, and which of them are near.
#pragma once

#include <array>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "tspace/span.h"

namespace tspace {

/// Faces that meet at more are not smooth, in degrees: 12 sides around a cylinder still are.
inline constexpr float kHardDeg = 30.5F;

struct HardEdges {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    struct Edge {
        std::array<std::uint32_t, 2> corners = {};  ///< where it begins and ends
        DVec3 way = {};                             ///< unit, or zero: the mean of its faces' normals
    };
    std::vector<Edge> edges = {};
    // One per corner; empty where no edge is hard:
    /// The hard edges that are nearest to it over faces that meet smoothly. At most `far` away.
    std::vector<std::array<std::uint32_t, 2>> nearest = {};
    std::vector<std::uint32_t> groups = {};  ///< equal for corners at one place whose faces meet smoothly: one of them
    std::vector<bool> at_edge = {};          ///< whether one of its group begins or ends a hard edge
};

/// `positions` three per triangle, and `roots` the first corner at the same place as each. Linear but for a sort of the edges;
/// the same result for any number of threads.
HardEdges findHardEdges(StridedSpan<const Vec3> positions, std::span<const std::uint32_t> roots, double far);

}  // namespace tspace
