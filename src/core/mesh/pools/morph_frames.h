// SPDX-License-Identifier: MIT
// Morph targets: one split for a mesh and all its targets, and their offsets for tangents and normals.
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

// Split that a mesh and all its morph targets share: a vertex whose corners differ in any target is split for all.

/// Returns offsets after a further split: each vertex from `old_count` on has the offset of its source, an earlier
/// vertex.
VertexOffsets spread(const VertexOffsets& offsets, std::span<const std::uint32_t> sources, std::size_t old_count);

class MorphSplit {
  public:
    /// Continues from `split`. If `may_split` is false, the first corner of a vertex determines its offset.
    MorphSplit(SplitResult&& split, bool may_split);

    /// Adds the next target, with one finite offset per corner. Corners whose offsets differ by at most `tolerance`
    /// from the first corner of their vertex share its offset.
    Result<Done> add(std::span<const Vec3> offsets, float tolerance, const Execution& execution);

    /// Returns the offsets of each target for the final vertices.
    [[nodiscard]] std::vector<VertexOffsets> finish();

    [[nodiscard]] SplitResult& split() { return split_; }

  private:
    struct Target {
        VertexOffsets offsets = {};
        std::size_t vertex_count = 0;  ///< number of vertices before the split
    };
    [[nodiscard]] bool agree(std::span<const Vec3> offsets, float tolerance) const;
    Result<Done> refine(std::span<const Vec3> offsets, float tolerance, const Execution& execution);
    SplitResult split_;
    bool may_split_;
    std::vector<std::uint32_t> parents_;  ///< vertex that each vertex was split from by a target, or the vertex itself
    std::vector<Target> targets_ = {};
};

// Offsets of morph targets for the tangents of a pool: tangents of the moved shape with the groups of the base, minus
// those of the base. If a target separates vertices that are equal on the base, the moved shape is regrouped.

/// Classes of vertices with equal position, normal and UV. Tangents may be averaged over all vertices of a class.
class WeldClasses {
  public:
    /// Finds the classes in expected linear time; keeps 4 bytes per vertex.
    explicit WeldClasses(const LocalMesh& mesh) : classes_(findEqualVertices(mesh.positions, mesh.normals, mesh.uvs)) {}

    [[nodiscard]] std::uint32_t of(std::uint32_t vertex) const { return classes_.class_of[vertex]; }

    /// Marks the classes whose vertices, among those used by `corners`, have different positions or normals in a pose.
    /// Returns whether there are any such classes. Linear.
    bool findApart(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                   std::span<const Vec3> normals, std::vector<bool>& apart) const;

    /// Marks all classes of each triangle that has a marked class, `rounds` times. Linear in each round.
    void spread(const LocalMesh& mesh, unsigned rounds, std::vector<bool>& apart) const;

  private:
    EqualVertices classes_;
};

/// Reads target `i` of a pool. Fails with countMismatch if its counts differ from those of the pool.
Result<MorphOffsets> readTarget(const PoolView& pool, std::size_t i);

/// Mesh moved by a morph target. Its arrays are reused for the next target.
class MorphPose {
  public:
    /// Returns false, without a pose, if no vertex of the mesh moves.
    bool take(const LocalMesh& mesh, const MorphOffsets& offsets);

    [[nodiscard]] std::span<const Vec3> positions() const { return positions_; }
    [[nodiscard]] std::span<const Vec3> normals() const { return normals_; }

  private:
    std::vector<Vec3> positions_, normals_;
};

/// Returns `to` - `from`, without negative zeros; zero if the difference is not finite.
Vec3 offsetBetween(const Vec3& from, const Vec3& to);

/// Corners that keep the offsets of the file while tangents are repaired, in targets that have offsets.
struct KeptOffsets {
    std::span<const std::uint32_t> vertices = {};  ///< vertex of the pool for each corner
    /// one per corner; true: the corner gets new offsets, false: it keeps those of the file
    const std::vector<bool>& is_new;
};

class MorphTangents {
  public:
    MorphTangents(const PoolView& pool, const FramesOptions& options) : pool_(pool), options_(options) {}

    /// Adds the next primitive, with the faces that its tangents were computed on, and normals. compute() fills counts
    /// of `report`.
    Result<Done> add(LocalMesh&& mesh, FramesReport& report);

    /// Processes all targets. `tangents`: tangents of the base, one per corner of all primitives. Continues the split.
    /// `kept`: null, or the corners that keep the offsets of the file.
    Result<Done> compute(std::span<const Vec4> tangents, MorphSplit& split, const KeptOffsets* kept);

  private:
    struct Piece {
        LocalMesh mesh;
        TangentPlan plan;
        WeldClasses classes;
        std::vector<Vec4> unrepaired;  ///< tangents of the base before repair, one per corner
        FramesReport* report = nullptr;
    };
    Result<Done> evaluateFaces(const Piece& piece, std::span<const Vec4> base, std::span<Vec3> offsets);
    Result<Done> evaluate(const Piece& piece, std::span<const Vec4> base, std::span<Vec3> offsets);
    Result<Done> regroup(const Piece& piece, const MeshView& posed);
    [[nodiscard]] bool isUnchangedAt(const Piece& piece, std::size_t corner) const;
    void keepLostTangents(const Piece& piece, std::span<const Vec4> base);

    const PoolView& pool_;
    const FramesOptions& options_;
    std::vector<Piece> pieces_ = {};
    MorphPose pose_ = {};
    std::vector<Vec4> tangents_ = {}, regrouped_ = {};
    std::vector<bool> apart_ = {}, stays_ = {};
};

/// Counts corners whose tangent differs from their vertex's tangent by sign, or in direction by more than 5 degrees.
/// `computed` is unit.
std::uint64_t countDiffering(std::span<const Vec4> computed, std::span<const Vec4> of_vertices,
                             std::span<const std::uint32_t> vertices);

/// Counts corners at which two lists of tangents differ in direction by more than 5 degrees.
std::uint64_t countDiffering(std::span<const Vec4> computed, std::span<const Vec4> written);

// Normals for a pool without normals, and for its morph targets.

/// The pool with computed normals, split where corners differ, on the base or in a target.
struct PoolWithNormals {
    OwnedMesh vertices = {};
    /// targets read from the original pool, which must outlive this struct
    MorphTargets targets = {};
    std::vector<PrimitiveGeometry> primitives = {};  ///< the primitives, with the new vertex of each corner
    /// old vertex of each new vertex; the first vertices are unchanged
    std::vector<std::uint32_t> source_vertices = {};
    std::vector<VertexOffsets> offsets = {};  ///< offsets of each target for the normals of the new vertices
};

/// Computes normals with options.normals. The base determines hard edges; the offsets of a target give the normals of
/// the moved shape. Fills the normals of the reports. The result must not be moved: its targets point into it.
Result<Done> generatePoolNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                 const FramesOptions& options, std::span<FramesReport> reports,
                                 PoolWithNormals& result);

// Morph offsets for normals that are kept: the offsets rotate them like the surface.

class RotatedNormals {
  public:
    /// Requires a pool with normals.
    RotatedNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives);

    /// Returns, per vertex, the offset that rotates its normal like the surface around it if a target adds `positions`
    /// (one per vertex, or none). The offset is zero if the surface does not rotate, or if triangles collapse.
    [[nodiscard]] std::vector<Vec3> offsets(std::span<const Vec3> positions) const;

  private:
    std::vector<Vec3> positions_ = {}, normals_ = {};
    std::vector<std::uint32_t> corners_ = {};
};

/// Returns the vertices whose offset is not zero.
VertexOffsets sparse(std::span<const Vec3> offsets);

}  // namespace tspace
