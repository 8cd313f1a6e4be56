// SPDX-License-Identifier: MIT
// Decides what to do with each primitive of a glTF file, and which primitives are computed together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/pools/primitive.h"
#include "core/mesh/surface/uvs.h"
#include "model/gltf/document.h"
#include "model/gltf/model.h"
#include "model/gltf/primitive_reader.h"
#include "tspace/generate.h"

namespace tspace {

struct Surroundings;

}  // namespace tspace

namespace tspace::gltf {

/// Primitives that draw the same triangles of one pool. They are computed once.
struct GeometryPlan {
    std::vector<std::size_t> primitives = {};  ///< indices of primitives; never empty
    Repairs repairs = {};                      ///< faults of the existing tangents
    /// Adjacent triangles of other primitives, see PrimitiveGeometry::around.
    std::shared_ptr<const Surroundings> around = {};
};

/// Primitives with the same attribute accessors and morph targets, whose tangents follow the same UV set with the same
/// texture transform.
struct PoolPlan {
    std::vector<GeometryPlan> geometries = {};
    std::vector<std::size_t> primitives = {};  ///< all primitives of the pool, in file order
    bool uses_uvs = true;
    std::size_t uv_set = 0;
    UvMatrix uv_matrix = {};
    bool has_normals = false;
    bool has_tangents = false;  ///< the file has tangents with normals; tangents without normals are ignored
    /// Normals are recomputed: has_normals is false, and vertices that differ only in their frames are welded.
    bool overwrites_normals = false;
    bool makes_tangents = true;    ///< false: only normals or normal offsets of targets are computed
    bool keeps_tangents = false;   ///< tangents are kept; morph targets without tangent deltas get them
    bool tries_quads = false;      ///< tangents may be computed on quads, if the existing tangents match quads
    bool is_from_blender = false;  ///< Blender wrote the file
    /// Targets that get new normal offsets although the base normals are kept; empty if there are none.
    std::vector<bool> morph_normals = {};
    std::uint64_t corner_count = 0;
    std::size_t vertex_count = 0;

    /// Returns whether existing tangents are kept, except for the repairs listed in the geometries.
    [[nodiscard]] bool repairsTangents() const {
        return !geometries.empty() && !geometries.front().repairs.vertices.empty();
    }

    /// Returns the approximate memory of the computation, most of it for lists of the corners' neighbors and tangents.
    [[nodiscard]] std::uint64_t workBytes() const {
        const std::uint64_t of_corner = (has_normals ? 96U : 128U) + (repairsTangents() ? 24U : 0U);
        return of_corner * corner_count + std::uint64_t{64} * vertex_count;
    }
};

struct GeneratePlan {
    std::vector<PoolPlan> pools = {};
    std::vector<PrimitiveReport> reports = {};  ///< one per primitive; final for primitives that are in no pool
    /// Some used texture has a transform, even if TextureTransform::ignore disables transforms.
    bool has_texture_transforms = false;
};

/// Returns whether a morph target changes the surface but has no tangent deltas.
bool lacksDeltas(const Primitive& primitive);

/// Normals that are recomputed regardless of the options: one entry per primitive in file order, or empty.
struct RecomputedNormals {
    /// per primitive: recompute its normals (as GenerateOptions::Normals::overwrite does for all)
    std::vector<bool> base = {};
    /// per primitive: recompute all normal deltas of its targets (as MorphNormals::all does for all)
    std::vector<bool> morphs = {};
    /// per primitive: its normals could not be read and were removed, so they are recomputed
    std::vector<bool> lost = {};
};

/// Returns whether GenerateOptions::Normals::overwrite recomputes the normals of the primitive.
bool overwritesNormals(const Document& document, const Primitive& primitive, const GenerateOptions& options);

GeneratePlan planGenerate(const Document& document, std::span<const Primitive> primitives,
                          const GenerateOptions& options, const RecomputedNormals& recomputed = {});

// Finds the primitives of a mesh that form one surface for computing normals.

/// For geometries with computed normals, adds the adjacent triangles of other primitives that form one surface with
/// them in the same mesh, and notes it in the reports. If several meshes draw a geometry, the first mesh is used. Does
/// nothing for flat normals, which do not depend on neighbors, or with normals_per_primitive.
void planSurroundings(Model& model, const GenerateOptions& options, GeneratePlan& plan);

}  // namespace tspace::gltf
