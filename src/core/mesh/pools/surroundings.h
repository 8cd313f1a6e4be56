// SPDX-License-Identifier: MIT
// Normals of a primitive that is one surface with others: their triangles at the border count too.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/pools/morph_targets.h"
#include "tspace/normals.h"

namespace tspace {

/// Triangles of other primitives around one. They get no normals here.
struct Surroundings {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> normals = {};  ///< empty, or one per vertex: one that stays; zero where there is none
    std::vector<std::uint32_t> indices = {};
    std::size_t triangles_before = 0;  ///< of them, those whose primitive is before this one in the file
    std::uint64_t point_count = 0;     ///< positions that the primitive shares with the others
    /// As MorphTargets::read, for these vertices; no function: targets do not move them.
    std::function<Result<MorphOffsets>(std::size_t)> read = {};
};

/// The normals of one primitive, on the base and in poses, one after the other.
class BorderedNormals {
  public:
    /// `around`: null where nothing is around the mesh, which has polygons only then. All must outlive this.
    BorderedNormals(const LocalMesh& mesh, const Surroundings* around, const NormalOptions& options,
                    const Execution& execution);

    /// generateNormals of the mesh, one per corner of it. Where a vertex around the mesh has a normal that stays, and that is
    /// within 30 degrees (and within the crease angle) of the one that would be made at the same position, it is taken.
    /// Sums are in the order of the file, so that both sides of a border get the same bits.
    Result<NormalReport> base(StridedSpan<Vec3> out);
    /// generatePoseNormals, after base(); `positions` are those of the mesh as target `target` moves it.
    Result<NormalReport> pose(const StridedSpan<const Vec3>& positions, std::size_t target, StridedSpan<Vec3> out);

  private:
    [[nodiscard]] MeshView whole() const;
    void choose(std::span<const Vec3> normals);
    NormalReport take(const NormalReport& of_whole, std::span<const Vec3> normals, StridedSpan<Vec3> out) const;

    const LocalMesh& mesh_;
    const Surroundings* around_;
    const NormalOptions& options_;
    const Execution& execution_;
    std::vector<Vec3> positions_ = {};  ///< of the mesh, then of what is around it
    std::vector<std::uint32_t> indices_ = {};
    std::size_t first_corner_ = 0;           ///< of the mesh
    std::vector<std::uint32_t> stays_ = {};  ///< per corner of the mesh: the vertex around it whose normal it takes
    std::uint64_t degenerate_around_ = 0;
};

}  // namespace tspace
