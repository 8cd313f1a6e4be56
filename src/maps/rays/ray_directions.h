// SPDX-License-Identifier: MIT
// Direction of the ray from a point of a low poly, and position of the cage on it.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "tspace/maps.h"

namespace tspace {

// Nearest point of a line segment, and distance from it.

/// Returns the parameter, from 0 at a to 1 at b, of the point of the segment that is nearest to `point`.
inline double nearestPart(const DVec3& point, const DVec3& a, const DVec3& b) {
    const DVec3 edge = b - a;
    const double squared = dot(edge, edge);
    return squared > 0 ? std::clamp(dot(point - a, edge) / squared, 0.0, 1.0) : 0.0;
}

/// Returns the squared distance of a point from the segment from a to b.
inline double squaredDistanceTo(const DVec3& point, const DVec3& a, const DVec3& b) {
    const DVec3 away = point - a - nearestPart(point, a, b) * (b - a);
    return dot(away, away);
}

/// Angle between faces above which an edge is hard, in degrees: a cylinder with 12 sides is still smooth.
inline constexpr float kHardDeg = 30.5F;
inline constexpr std::uint32_t kNoHardEdge = 0xffffffffu;

/// Edge at which faces meet at more than kHardDeg degrees.
struct HardEdge {
    Vec3 from = {}, to = {};
    Vec3 offset = {};                             ///< offset to the cage between its two faces, for a cage offset of 1
    Vec3 offset_at_from = {}, offset_at_to = {};  ///< offsets to the cage at its ends, from all faces at each end
};

/// Rays of a low poly: the direction at each point, and the distance to the cage. Const calls are thread-safe.
class RayField {
  public:
    RayField() = default;
    /// Computes the directions at corners and hard edges. `low` must be checked; its arrays and `rays`.skew must stay
    /// valid. `offset`: cage distance. Time: linear, except for a sort of the edges.
    RayField(const LowPoly& low, const RayOptions& rays, double offset, Parallel& parallel, const Allocator* allocator);

    /// Computes the unit outward direction at a point and the distance to the cage along it. Returns false if there is
    /// no direction.
    bool at(std::size_t triangle, const std::array<double, 3>& weights, DVec3& outward, double& height) const;

  private:
    /// Hard edges nearest to a corner, reached over faces that meet smoothly.
    using NearEdges = std::array<std::uint32_t, 2>;

    [[nodiscard]] double painted(std::size_t triangle, const std::array<double, 3>& weights) const;
    /// Returns whether a corner of the triangle has hard edges nearby.
    [[nodiscard]] bool isNearEdges(std::size_t triangle) const {
        if (near_.empty()) return false;
        const NearEdges* const corners = near_.data() + 3 * triangle;
        return corners[0][0] != kNoHardEdge || corners[1][0] != kNoHardEdge || corners[2][0] != kNoHardEdge;
    }
    /// Returns the direction at a point near hard edges. `straight`: direction of the point's face.
    [[nodiscard]] DVec3 bentAtEdges(std::size_t triangle, const DVec3& point, const DVec3& straight) const;

    LowPoly low_ = {};
    RayOptions rays_ = {};
    double offset_ = 0;
    double bend_ = 0;  ///< distance from a hard edge within which directions bend toward it
    /// Offset from a corner to the cage, for a cage offset of 1. It is longer than 1 if faces are inclined to the mean
    /// normal, so that the cage keeps its distance from the faces.
    Buffer<Vec3> averaged_ = {};
    Buffer<Vec3> straight_ = {};   ///< mean over the faces that meet smoothly at each corner; empty unless requested
    Buffer<NearEdges> near_ = {};  ///< one per corner; empty if no edge is hard
    Buffer<HardEdge> edges_ = {};
};

}  // namespace tspace
