// SPDX-License-Identifier: MIT
// What morph targets add to the tangents of a pool: tangents of the moved shape with the groups of the base, minus
// those of the base. Where a target takes vertices apart that are equal on the base, groups are those of the moved
// shape.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/pools/morph_split.h"
#include "core/mesh/pools/weld_classes.h"
#include "tspace/tangents.h"

namespace tspace {

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

/// Where tangents are mended: corners whose offsets stay those of the file, in targets that have some.
struct KeptOffsets {
    std::span<const std::uint32_t> vertices = {};  ///< of the pool, one per corner
    const std::vector<bool>& is_new;               ///< one per corner
};

class MorphTangents {
  public:
    MorphTangents(const PoolView& pool, const GenerateOptions& options) : pool_(pool), options_(options) {}

    /// The next primitive as it was computed: triangles or quads, with normals. `report` gets its counts later.
    Result<Done> add(LocalMesh&& mesh, PrimitiveReport& report);

    /// One target after the other. `tangents`: of the base, one per corner of all primitives. Goes on with the split.
    /// `kept`: null, or where offsets of the file stay.
    Result<Done> compute(std::span<const Vec4> tangents, MorphSplit& split, const KeptOffsets* kept);

  private:
    struct Piece {
        LocalMesh mesh;
        TangentPlan plan;
        WeldClasses classes;
        std::vector<Vec4> unmended;  ///< of the base, one per corner
        PrimitiveReport* report = nullptr;
    };
    Result<Done> evaluateFaces(const Piece& piece, std::span<const Vec4> base, std::span<Vec3> offsets);
    Result<Done> evaluate(const Piece& piece, std::span<const Vec4> base, std::span<Vec3> offsets);
    Result<Done> regroup(const Piece& piece, const MeshView& posed);
    [[nodiscard]] bool staysAt(const Piece& piece, std::size_t corner) const;
    void carryOver(const Piece& piece, std::span<const Vec4> base);

    const PoolView& pool_;
    const GenerateOptions& options_;
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

}  // namespace tspace
