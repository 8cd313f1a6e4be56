// SPDX-License-Identifier: MIT
// Morph targets: one split for a mesh and all its targets, and what targets add to tangents and normals.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/pools/primitive.h"
#include "core/mesh/surface/surface.h"
#include "tspace/indexed_frames.h"
#include "tspace/tangents.h"

namespace tspace {

// One split for a mesh and all its morph targets: a vertex whose corners one target moves apart is split for all.

/// Offsets after a further split: each vertex from `old_count` on has those of its source, which is an earlier vertex.
VertexOffsets spread(const VertexOffsets& offsets, std::span<const std::uint32_t> sources, std::size_t old_count);

class MorphSplit {
  public:
    /// Goes on from `split`. `may_split` false: where corners of a vertex differ, the first one counts.
    MorphSplit(SplitResult&& split, bool may_split);

    /// The next target, by an offset per corner, which must be finite. Corners whose offsets differ by no more than
    /// `tolerance` from the first corner of their vertex share that one's.
    Result<Done> add(std::span<const Vec3> offsets, float tolerance, const Execution& execution);

    /// Offsets of each target for the vertices there are now.
    [[nodiscard]] std::vector<VertexOffsets> finish();

    [[nodiscard]] SplitResult& split() { return split_; }

  private:
    struct Target {
        VertexOffsets offsets = {};
        std::size_t vertex_count = 0;  ///< number of vertices before splitting
    };
    [[nodiscard]] bool agree(std::span<const Vec3> offsets, float tolerance) const;
    Result<Done> refine(std::span<const Vec3> offsets, float tolerance, const Execution& execution);
    SplitResult split_;
    bool may_split_;
    std::vector<std::uint32_t> parents_;  ///< the vertex that each was split from by a target, or itself
    std::vector<Target> targets_ = {};
};

// Offsets that morph targets add to the tangents of a pool: tangents of the moved shape with the groups of the base,
// minus those of the base. Where a target takes vertices apart that are equal on the base, the moved shape is grouped
// anew.

/// Vertices with equal position, normal and UV, over which the grouping methods go on.
class WeldClasses {
  public:
    /// Expected linear time; keeps 4 bytes per vertex.
    explicit WeldClasses(const LocalMesh& mesh) : classes_(findEqualVertices(mesh.positions, mesh.normals, mesh.uvs)) {}

    [[nodiscard]] std::uint32_t of(std::uint32_t vertex) const { return classes_.class_of[vertex]; }

    /// Marks the classes whose vertices, those that `corners` name, have different positions or normals in a pose.
    /// Returns whether there is one. Linear.
    bool findApart(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                   std::span<const Vec3> normals, std::vector<bool>& apart) const;

    /// Marks all classes of a triangle that has a marked one, `rounds` times. Linear in each.
    void spread(const LocalMesh& mesh, unsigned rounds, std::vector<bool>& apart) const;

  private:
    EqualVertices classes_;
};

/// Target `i` of a pool. Fails with countMismatch where its counts are not those of the pool.
Result<MorphOffsets> readTarget(const PoolView& pool, std::size_t i);

/// A mesh moved by a target. Its arrays are used again for the next one.
class MorphPose {
  public:
    /// Returns false, and has no pose, when no vertex of the mesh moves.
    bool take(const LocalMesh& mesh, const MorphOffsets& offsets);

    [[nodiscard]] std::span<const Vec3> positions() const { return positions_; }
    [[nodiscard]] std::span<const Vec3> normals() const { return normals_; }

  private:
    std::vector<Vec3> positions_, normals_;
};

/// to - from, without signed zeros; zero where it is not finite.
Vec3 offsetBetween(const Vec3& from, const Vec3& to);

/// For repair: corners whose offsets stay those of the file, in targets that have offsets.
struct KeptOffsets {
    std::span<const std::uint32_t> vertices = {};  ///< vertex of the pool for each corner
    const std::vector<bool>& is_new;               ///< one per corner
};

class MorphTangents {
  public:
    MorphTangents(const PoolView& pool, const FramesOptions& options) : pool_(pool), options_(options) {}

    /// The next primitive as it was computed: triangles or quads, with normals. `report` gets its counts later.
    Result<Done> add(LocalMesh&& mesh, FramesReport& report);

    /// One target after the other. `tangents`: of the base, one per corner of all primitives. Goes on with the split.
    /// `kept`: null, or where offsets of the file stay.
    Result<Done> compute(std::span<const Vec4> tangents, MorphSplit& split, const KeptOffsets* kept);

  private:
    struct Piece {
        LocalMesh mesh;
        TangentPlan plan;
        WeldClasses classes;
        std::vector<Vec4> unmended;  ///< of the base, one per corner
        FramesReport* report = nullptr;
    };
    Result<Done> evaluateFaces(const Piece& piece, std::span<const Vec4> base, std::span<Vec3> offsets);
    Result<Done> evaluate(const Piece& piece, std::span<const Vec4> base, std::span<Vec3> offsets);
    Result<Done> regroup(const Piece& piece, const MeshView& posed);
    [[nodiscard]] bool staysAt(const Piece& piece, std::size_t corner) const;
    void carryOver(const Piece& piece, std::span<const Vec4> base);

    const PoolView& pool_;
    const FramesOptions& options_;
    std::vector<Piece> pieces_ = {};
    MorphPose pose_ = {};
    std::vector<Vec4> tangents_ = {}, regrouped_ = {};
    std::vector<bool> apart_ = {}, stays_ = {};
};

/// Corners whose tangent differs from that of their vertex by sign, or in direction by more than 5 degrees. `computed`
/// is unit.
std::uint64_t countDiffering(std::span<const Vec4> computed, std::span<const Vec4> of_vertices,
                             std::span<const std::uint32_t> vertices);

/// Corners where the two differ in direction by more than 5 degrees.
std::uint64_t countDiffering(std::span<const Vec4> computed, std::span<const Vec4> written);

// Normals for a pool that has none, and for its morph targets.

/// The pool after its normals: with them, and split where corners have different ones, on the base or in a target.
struct PoolWithNormals {
    OwnedMesh vertices = {};
    MorphTargets targets = {};  ///< they read those of the pool it was made from, which must outlive it
    std::vector<PrimitiveGeometry> primitives = {};   ///< primitives with the same corners
    std::vector<std::uint32_t> source_vertices = {};  ///< new vertex -> old vertex, identity first
    std::vector<VertexOffsets> offsets = {};  ///< one per target: what it adds to the normals of the new vertices
};

/// Normals by options.normals. Which edges are hard is the base's matter; what a target adds makes the normals of the
/// moved shape. Fills the normals of the reports. The result must stay where it is: its targets point into it.
Result<Done> generatePoolNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                 const FramesOptions& options, std::span<FramesReport> reports,
                                 PoolWithNormals& result);

// Offsets that morph targets should add to normals that stay.

class TurnedNormals {
  public:
    /// The pool has normals.
    TurnedNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives);

    /// Per vertex the offset that turns its normal as the surface around it turns, when a target adds `positions` (one
    /// per vertex, or none). Zero where nothing turns, and where triangles vanish.
    [[nodiscard]] std::vector<Vec3> offsets(std::span<const Vec3> positions) const;

  private:
    std::vector<Vec3> positions_ = {}, normals_ = {};
    std::vector<std::uint32_t> corners_ = {};
};

/// The vertices whose offset is not zero.
VertexOffsets sparse(std::span<const Vec3> offsets);

}  // namespace tspace
