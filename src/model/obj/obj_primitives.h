// SPDX-License-Identifier: MIT
// Indexed primitives from the faces of an OBJ file.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/owned_mesh.h"
#include "model/obj/obj_reader.h"
#include "model/scene/scene.h"
#include "tspace/generate.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/result.h"

namespace tspace::obj {

/// A future glTF primitive: the faces of one shape and material, all with UVs or all without.
struct ObjPrimitive {
    std::uint32_t shape = 0;
    std::uint32_t material = 0;
    bool has_uvs = false;
    bool normals_generated = false;         ///< for any of its faces
    std::vector<std::uint32_t> faces = {};  ///< into Model::faces, in file order
};

/// Whether any of its corners has a normal.
bool hasSomeNormals(const Model& model, const ObjPrimitive& primitive);

/// In order of first face.
std::vector<ObjPrimitive> collectPrimitives(const Model& model);

/// Gives every corner a normal: faces that lack one on any corner get new ones. Smoothing goes across shapes
/// and materials, as smoothing groups do, but not with normals_per_primitive. Adds to model.normals, marks the
/// primitives, and returns what was repaired.
Result<NormalReport> completeNormals(Model& model, std::vector<ObjPrimitive>& primitives,
                                     const GenerateOptions& options);

/// The primitive's polygons over vertices of their own, one per different (position, UV, normal) in order of first use.
/// Where a corner has no normal (before completeNormals) the mesh has none at all.
OwnedMesh buildMesh(const Model& model, const ObjPrimitive& primitive);
/// Three vertices per triangle of its polygons. Throws FileError.
std::vector<std::uint32_t> triangleCorners(const OwnedMesh& mesh);

// An OBJ file as a Scene.

/// The primitives that a glTF made from the model would have. `with_images`: also the bytes of normal maps. Throws
/// FileError.
Scene sceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images);

/// readScene with materials for rendering, and `with_images` base colours too. Faces are double-sided, since OBJ has no
/// culling.
DrawnScene drawnSceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images);

}  // namespace tspace::obj
