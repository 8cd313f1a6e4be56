// SPDX-License-Identifier: MIT
// Where the ray of a point of a low poly points, and where the cage is on it.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

// Distance of a point from a segment.

/// Returns the parameter, from 0 at a to 1 at b, of the point of the segment that is nearest to `point`.
inline double nearestPart(const DVec3& point, const DVec3& a, const DVec3& b) {
    const DVec3 edge = b - a;
    const double squared = dot(edge, edge);
    return squared > 0 ? std::clamp(dot(point - a, edge) / squared, 0.0, 1.0) : 0.0;
}

/// The square of the distance.
inline double squaredDistanceTo(const DVec3& point, const DVec3& a, const DVec3& b) {
    const DVec3 away = point - a - nearestPart(point, a, b) * (b - a);
    return dot(away, away);
}

// Edges at which the faces of a low poly meet at an angle, and which of them are near.

/// Faces that meet at more are not smooth, in degrees: 12 sides around a cylinder still are.
inline constexpr float kHardDeg = 30.5F;

struct HardEdges {
    static constexpr std::uint32_t kNone = 0xffffffffu;

    struct Edge {
        std::array<std::uint32_t, 2> corners = {};  ///< its two end points
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

/// Interpolates an attribute at a point of a triangle; three values per triangle.
template <class T>
DVec3 mixedAt(const StridedSpan<const T>& values, std::size_t triangle, const std::array<double, 3>& weights) {
    DVec3 sum{};
    for (std::size_t i = 0; i < 3; ++i) sum = sum + weights[i] * toDouble(values[3 * triangle + i]);
    return sum;
}

/// An edge at which faces meet at over 30 degrees.
struct HardEdge {
    Vec3 from = {}, to = {};
    Vec3 way = {};                          ///< to the cage, for an offset of 1: between its faces
    Vec3 way_of_from = {}, way_of_to = {};  ///< between all faces at its ends
};

/// The rays of a low poly. Const calls are thread-safe.
class RayField {
  public:
    RayField() = default;
    /// `low` must be checked; its arrays and `rays`.skew must stay valid. `offset`: cage distance. Time: linear, except for a
    /// sort of the edges.
    RayField(const LowPoly& low, const RayOptions& rays, double offset, Parallel& parallel, const Allocator* allocator);

    /// The unit direction outwards at a point, and how far along it the cage is. False where there is none.
    bool at(std::size_t triangle, const std::array<double, 3>& weights, DVec3& outward, double& height) const;

  private:
    static constexpr std::uint32_t kNoEdge = 0xffffffffu;
    /// The hard edges that are nearest to a corner, over faces that meet smoothly.
    using NearEdges = std::array<std::uint32_t, 2>;

    [[nodiscard]] DVec3 faceOf(std::size_t triangle) const;
    [[nodiscard]] double painted(std::size_t triangle, const std::array<double, 3>& weights) const;
    /// Whether a corner of a triangle has hard edges nearby.
    [[nodiscard]] bool isNearEdges(std::size_t triangle) const {
        if (near_.empty()) return false;
        const NearEdges* const corners = near_.data() + 3 * triangle;
        return corners[0][0] != kNoEdge || corners[1][0] != kNoEdge || corners[2][0] != kNoEdge;
    }
    /// The way at a point near hard edges, where `straight` is the way of its face.
    [[nodiscard]] DVec3 bentAtEdges(std::size_t triangle, const DVec3& point, const DVec3& straight) const;

    LowPoly low_ = {};
    RayOptions rays_ = {};
    double offset_ = 0;
    double bend_ = 0;  ///< distance from a hard edge within which directions bend towards it
    /// From a corner to the cage, for an offset of 1: longer than 1 where faces lean away from the mean, so that the cage
    /// is as far from them.
    Buffer<Vec3> averaged_ = {};
    Buffer<Vec3> straight_ = {};   ///< the mean over faces that meet smoothly; empty unless it is asked for
    Buffer<NearEdges> near_ = {};  ///< one per corner; empty where nothing is hard
    Buffer<HardEdge> edges_ = {};
};

}  // namespace tspace
