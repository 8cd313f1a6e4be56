// SPDX-License-Identifier: MIT
// How a moved surface turns around its vertices, and how that turns normals that an artist has chosen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/vec.h"

namespace tspace {

/// The mean normals of the triangles around a vertex before and after, weighted by their angles.
struct VertexTurn {
    Vec3 from = {}, to = {};  ///< unit; both zero where one of them cannot be had
    /// No triangle around the vertex collapses or opens, and none is more than 40 degrees from the mean, before or after: else
    /// the mean is a matter of weights, and exporters differ.
    bool is_certain = false;

    [[nodiscard]] bool isKnown() const { return !(from == Vec3{}); }
    /// The normal, turned by the shortest rotation from `from` to `to`; as it is where the turn is not known.
    [[nodiscard]] Vec3 apply(const Vec3& normal) const;
};

/// The triangles around a vertex are those of all vertices with its position and normal, and, for one movement, its offset:
/// vertices are split for UVs, but a hard edge is one still.
class SurfaceTurns {
  public:
    /// One normal per position. `corners`: three per triangle. All must outlive this.
    SurfaceTurns(std::span<const Vec3> positions, std::span<const Vec3> normals,
                 std::span<const std::uint32_t> corners);

    /// One per vertex; `offsets` are added to the positions. Linear.
    [[nodiscard]] std::vector<VertexTurn> under(std::span<const Vec3> offsets) const;

  private:
    std::span<const Vec3> positions_;
    std::span<const std::uint32_t> corners_;
    std::vector<std::uint32_t> class_of_ = {};
};

}  // namespace tspace
