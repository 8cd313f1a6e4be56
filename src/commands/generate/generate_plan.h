// SPDX-License-Identifier: MIT
// What to do with each primitive of a glTF file, and which primitives are computed together.
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

/// Primitives that draw the same triangles of one pool: computed once.
struct GeometryPlan {
    std::vector<std::size_t> primitives = {};         ///< numbers into the list of primitives; never empty
    Mends mends = {};                                 ///< faults of the existing tangents
    std::shared_ptr<const Surroundings> around = {};  ///< see PrimitiveGeometry::around
};

/// Primitives over the same attribute accessors and morph targets whose tangents follow the same UV set, turned the
/// same way.
struct PoolPlan {
    std::vector<GeometryPlan> geometries = {};
    std::vector<std::size_t> primitives = {};  ///< all of them, in file order
    bool uses_uvs = true;
    std::size_t uv_set = 0;
    UvMatrix uv_matrix = {};
    bool has_normals = false;
    bool has_tangents = false;  ///< there are tangents with normals; others do not count
    /// Normals are made anew: has_normals is false, and vertices that only frames keep apart are one.
    bool overwrites_normals = false;
    bool makes_tangents = true;            ///< false: normals alone, or what targets add to them
    bool keeps_tangents = false;           ///< they stay, and morph targets without tangent deltas get some
    bool tries_quads = false;              ///< tangents may be computed on quads, if those that are there show it
    bool is_blenders = false;              ///< Blender wrote the file
    std::vector<bool> morph_normals = {};  ///< targets that get new offsets of normals that stay; empty: none
    std::uint64_t corner_count = 0;
    std::size_t vertex_count = 0;

    /// The tangents that are there stay, but where the geometries say.
    [[nodiscard]] bool mendsTangents() const {
        return !geometries.empty() && !geometries.front().mends.vertices.empty();
    }

    /// Approximate memory of the computation, most of it for lists of the corners' neighbors and tangents.
    [[nodiscard]] std::uint64_t workBytes() const {
        const std::uint64_t of_corner = (has_normals ? 96U : 128U) + (mendsTangents() ? 24U : 0U);
        return of_corner * corner_count + std::uint64_t{64} * vertex_count;
    }
};

struct GeneratePlan {
    std::vector<PoolPlan> pools = {};
    std::vector<PrimitiveReport> reports = {};  ///< one per primitive; final for those in no pool
    bool has_texture_transforms =
        false;  ///< of textures that tangents follow, or would but for TextureTransform::ignore
};

/// Whether a morph target that moves the surface leaves the tangents behind.
bool lacksDeltas(const Primitive& primitive);

/// Normals that are made whatever the options say: one per primitive in file order, or none.
struct NormalWishes {
    std::vector<bool> anew = {};    ///< like GenerateOptions::Normals::overwrite, per primitive
    std::vector<bool> morphs = {};  ///< like MorphNormals::all, per primitive
};

GeneratePlan planGenerate(const Document& document, std::span<const Primitive> primitives,
                          const GenerateOptions& options, const NormalWishes& wishes = {});

// Finds the primitives of a mesh that form one surface for computing normals.

/// Gives the geometries whose normals are made the triangles of other primitives of their mesh that they are one surface
/// with, and notes it in the reports. A geometry that several meshes draw gets those of the first. Nothing for flat normals,
/// which look at no neighbours, nor with normals_per_primitive.
void planSurroundings(Model& model, const GenerateOptions& options, GeneratePlan& plan);

}  // namespace tspace::gltf
