// SPDX-License-Identifier: MIT
// Welding of positions that are equal except for rounding: NormalOptions::weld_distance.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "tspace/mesh.h"

namespace tspace {

/// Pairs of different positions that are welded by the rule of NormalOptions::weld_distance (0: none, negative:
/// weld_auto). Vertices at equal positions remain at equal positions. After replacing the positions, code that welds
/// equal positions and treats triangles with two equal corners as degenerate follows the rule automatically.
class NearPositions {
  public:
    /// Finds the pairs in expected linear time; a distance much longer than the edges costs up to 125 comparisons per
    /// vertex. Memory: 24 bytes per vertex temporarily, 4 permanently; none if no two positions are close. Throws
    /// OutOfMemory.
    NearPositions(const MeshView& mesh, float distance, const Allocator* allocator, Parallel& parallel);

    /// Returns whether no positions are welded.
    [[nodiscard]] bool empty() const { return roots_.empty(); }
    /// Returns the positions of the mesh, or of a pose of it, each replaced by the position of the vertex it is welded
    /// to. Vertices that a pose moves apart by more than the weld distance keep their own positions.
    [[nodiscard]] Buffer<Vec3> moved(StridedSpan<const Vec3> positions) const;

  private:
    const Allocator* allocator_;
    double distance_ = 0;
    Buffer<std::uint32_t> roots_;
};

/// Returns an Error, with code ok for a valid weld_distance: a nonnegative length, or NormalOptions::weld_auto.
Error checkWeldDistance(float distance);

/// View of a mesh in which positions are replaced by NearPositions::moved. `mesh` must outlive it.
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
