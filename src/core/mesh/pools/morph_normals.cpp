// SPDX-License-Identifier: MIT
// Computes the normals of a pool and of its morph targets. Vertices are first split where the normals of the base
// differ, and then where a target bends faces that are coplanar, but not smooth, on the base.
#include "core/mesh/pools/morph_frames.h"

#include <utility>

#include "core/base/vec_math.h"
#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/pools/unit_lattice.h"

namespace tspace {
namespace {

/// Tolerance within which corners share an offset, for unit vectors: 0.0006 degrees. It covers the rounding of normals
/// that a target rotates equally.
constexpr float kTolerance = 1e-5f;

class PoolNormals {
  public:
    PoolNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives, const FramesOptions& options,
                std::span<FramesReport> reports)
        : pool_(pool), primitives_(primitives), options_(options), reports_(reports) {}

    Result<Done> compute(PoolWithNormals& result) {
        if (Result<Done> done = computeBase(); !done) return done;
        written_ = normals_;
        roundUnits(written_, options_.format);
        const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec3>(written_));
        Result<SplitResult> split = splitVertices(IndexView(spanOf(indices_)), pool_.positions.count, indices_.size(),
                                                  {&attribute, 1}, options_.execution);
        if (!split) return std::move(split).error();
        MorphSplit morph_split(*std::move(split), true);
        for (std::size_t target = 0; target < pool_.targets.count; ++target) {
            if (Result<Done> done = addTarget(target, morph_split); !done) return done;
        }
        write(morph_split, result);
        return Done{};
    }

  private:
    Result<Done> computeBase() {
        LocalMeshes local(pool_, primitives_.size());
        // reserved, because the elements of makers_ refer to the meshes and their options
        meshes_.reserve(primitives_.size());
        for (std::size_t p = 0; p < primitives_.size(); ++p) options_of_.push_back(optionsOf(p));
        for (std::size_t p = 0; p < primitives_.size(); ++p) {
            const std::vector<std::uint32_t>& corners = primitives_[p].indices;
            if (Result<Done> valid = validate(viewInPool(pool_, primitives_[p])); !valid) return valid;
            if (indices_.size() + corners.size() > kMaxCorners) {
                return Error{ErrorCode::tooLarge,
                             "the primitives that share these vertices have more than 2^31-1 corners in total"};
            }
            const std::size_t first = indices_.size();
            indices_.insert(indices_.end(), corners.begin(), corners.end());
            normals_.resize(indices_.size());
            meshes_.push_back(local.make(primitives_[p]));
            makers_.emplace_back(meshes_[p], primitives_[p].around.get(), options_of_[p], options_.execution);
            if (corners.empty()) continue;
            const Result<NormalReport> made = makers_[p].base(std::span(normals_).subspan(first));
            if (!made) return made.error();
            reports_[p].normals = *made;
            reports_[p].normals_generated = true;
        }
        return Done{};
    }

    [[nodiscard]] NormalOptions optionsOf(std::size_t primitive) const {
        NormalOptions options = options_.normals;
        options.smoothing_groups = primitives_[primitive].smoothing_groups;
        return options;
    }

    Result<Done> addTarget(std::size_t target, MorphSplit& split) {
        Result<MorphOffsets> moved = readTarget(pool_, target);
        if (!moved) return std::move(moved).error();
        std::vector<Vec3> offsets(normals_.size());
        std::size_t first = 0;
        for (std::size_t p = 0; p < meshes_.size(); first += primitives_[p++].indices.size()) {
            // The surroundings of a primitive may move even if the primitive does not.
            if (!pose_.take(meshes_[p], *moved) && !primitives_[p].around) continue;
            const std::span<Vec3> own = std::span(offsets).subspan(first, primitives_[p].indices.size());
            const Result<NormalReport> made = makers_[p].pose(StridedSpan<const Vec3>(pose_.positions()), target, own);
            if (!made) return made.error();
            for (std::size_t c = 0; c < own.size(); ++c) own[c] = offsetBetween(normals_[first + c], own[c]);
        }
        return split.add(offsets, kTolerance, options_.execution);
    }

    void write(MorphSplit& morph_split, PoolWithNormals& result) const {
        result.offsets = morph_split.finish();
        SplitResult& split = morph_split.split();
        result.vertices.positions = gather(pool_.positions, split.source_vertices);
        result.vertices.uvs = gather(pool_.uvs, split.source_vertices);
        result.vertices.normals = gatherNormals(written_, split.source_corners);
        result.source_vertices = std::move(split.source_vertices);
        std::size_t first = 0;
        for (const PrimitiveGeometry& primitive : primitives_) {
            const auto begin = split.indices.begin() + static_cast<std::ptrdiff_t>(first);
            first += primitive.indices.size();
            const auto end = split.indices.begin() + static_cast<std::ptrdiff_t>(first);
            result.primitives.push_back({.indices = {begin, end}, .face_sizes = primitive.face_sizes});
        }
        result.targets.count = pool_.targets.count;
        result.targets.read = [&old = pool_, &result](std::size_t target) { return readSplit(old, result, target); };
    }

    /// Returns a target of the old pool, for the new vertices, with the computed normals.
    static Result<MorphOffsets> readSplit(const PoolView& old, const PoolWithNormals& result, std::size_t target) {
        Result<MorphOffsets> offsets = readTarget(old, target);
        if (!offsets) return offsets;
        offsets->positions = gather(std::span<const Vec3>(offsets->positions), result.source_vertices);
        const VertexOffsets& normals = result.offsets[target];
        offsets->normals.assign(result.source_vertices.size(), Vec3{});
        for (std::size_t i = 0; i < normals.vertices.size(); ++i)
            offsets->normals[normals.vertices[i]] = normals.offsets[i];
        return offsets;
    }

    const PoolView& pool_;
    std::span<const PrimitiveGeometry> primitives_;
    const FramesOptions& options_;
    std::span<FramesReport> reports_;
    std::vector<LocalMesh> meshes_ = {};
    std::vector<NormalOptions> options_of_ = {};
    std::vector<BorderedNormals> makers_ = {};
    std::vector<std::uint32_t> indices_ = {};  ///< vertices of the corners of all primitives
    std::vector<Vec3> normals_ = {};           ///< normals of the base, one per corner
    /// Normals of the base as stored in the file. Offsets are relative to these, and are therefore 0 where nothing
    /// moves.
    std::vector<Vec3> written_ = {};
    MorphPose pose_ = {};
};

}  // namespace

Result<Done> generatePoolNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives,
                                 const FramesOptions& options, std::span<FramesReport> reports,
                                 PoolWithNormals& result) {
    return PoolNormals(pool, primitives, options, reports).compute(result);
}

// Rotates base normals that an artist chose (on bevels, on foliage) with the surface; they are not computed from the
// surface.

RotatedNormals::RotatedNormals(const PoolView& pool, std::span<const PrimitiveGeometry> primitives) {
    for (std::size_t v = 0; v < pool.positions.count; ++v) {
        positions_.push_back(pool.positions[v]);
        normals_.push_back(pool.normals[v]);
    }
    for (const PrimitiveGeometry& primitive : primitives)
        corners_.insert(corners_.end(), primitive.indices.begin(), primitive.indices.end());
}

std::vector<Vec3> RotatedNormals::offsets(std::span<const Vec3> positions) const {
    std::vector<Vec3> result(positions_.size());
    if (positions.empty()) return result;
    const std::vector<VertexRotation> turns = SurfaceRotations(positions_, normals_, corners_).under(positions);
    for (std::size_t v = 0; v < result.size(); ++v) {
        if (turns[v].isKnown()) result[v] = offsetBetween(normals_[v], turns[v].apply(normals_[v]));
    }
    return result;
}

VertexOffsets sparse(std::span<const Vec3> offsets) {
    VertexOffsets result;
    for (std::size_t v = 0; v < offsets.size(); ++v) {
        if (isZero(offsets[v])) continue;
        result.vertices.push_back(static_cast<std::uint32_t>(v));
        result.offsets.push_back(offsets[v]);
    }
    return result;
}

}  // namespace tspace
