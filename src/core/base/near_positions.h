// SPDX-License-Identifier: MIT
// Positions that are equal but for rounding, as one: NormalOptions::weld_distance.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "tspace/mesh.h"

namespace tspace {

/// Positions that are not equal but count as one, by the rule of NormalOptions::weld_distance (0: there are none, negative:
/// weld_auto). Vertices at equal positions stay at equal positions. Whoever welds by equal positions afterwards, and takes
/// triangles with two equal corners for degenerate, follows the rule without knowing it.
class NearPositions {
  public:
    /// Expected linear time; a distance much longer than the edges takes up to 125 comparisons per vertex. 24 bytes per
    /// vertex for a while and 4 that stay, and nothing where no two are near. Throws OutOfMemory.
    NearPositions(const MeshView& mesh, float distance, const Allocator* allocator, Parallel& parallel);

    /// Whether all positions stay as they are.
    [[nodiscard]] bool empty() const { return roots_.empty(); }
    /// The positions of the mesh, or of a pose of it, each that of the vertex it counts as one with. In a pose that holds
    /// where the two are near as well.
    [[nodiscard]] Buffer<Vec3> moved(StridedSpan<const Vec3> positions) const;

  private:
    const Allocator* allocator_;
    double distance_ = 0;
    Buffer<std::uint32_t> roots_;
};

/// An Error with code ok for a valid weld_distance: a length, or NormalOptions::weld_auto.
Error checkWeldDistance(float distance);

/// A mesh whose positions are those of NearPositions. `mesh` must outlive it.
class NearMesh {
  public:
    NearMesh(const MeshView& mesh, float distance, const Allocator* allocator, Parallel& parallel)
        : near_(mesh, distance, allocator, parallel), view_(mesh) {
        if (near_.empty()) return;
        positions_ = near_.moved(mesh.positions);
        view_.positions = {positions_.data(), positions_.size()};
    }
    NearMesh(const NearMesh&) = delete;
    NearMesh& operator=(const NearMesh&) = delete;

    [[nodiscard]] const NearPositions& near() const { return near_; }
    [[nodiscard]] const MeshView& view() const { return view_; }

  private:
    NearPositions near_;
    Buffer<Vec3> positions_;
    MeshView view_;
};

}  // namespace tspace
