// SPDX-License-Identifier: MIT
// Indexed primitives built from the faces of an OBJ file.
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

/// Primitive of the future glTF: the faces of one shape and material, either all with UVs or all without.
struct ObjPrimitive {
    std::uint32_t shape = 0;
    std::uint32_t material = 0;
    bool has_uvs = false;
    bool normals_generated = false;         ///< true: normals were generated for some of the faces
    std::vector<std::uint32_t> faces = {};  ///< indices into Model::faces, in file order
};

/// Returns whether any corner of the primitive has a normal.
bool hasSomeNormals(const Model& model, const ObjPrimitive& primitive);

/// Returns the primitives in order of their first face.
std::vector<ObjPrimitive> collectPrimitives(const Model& model);

/// Gives every corner a normal: faces that lack a normal at any corner get new ones. Smoothing crosses shapes and
/// materials, as smoothing groups do, except with normals_per_primitive. Adds to model.normals, marks the primitives,
/// and returns the report.
Result<NormalReport> completeNormals(Model& model, std::vector<ObjPrimitive>& primitives,
                                     const GenerateOptions& options);

/// Returns the primitive's polygons with separate vertices, one per distinct (position, UV, normal) in order of first
/// use. If any corner lacks a normal (before completeNormals), the mesh has no normals.
OwnedMesh buildMesh(const Model& model, const ObjPrimitive& primitive);
/// Returns three vertices per triangle of the mesh's polygons. Throws FileError.
std::vector<std::uint32_t> triangleCorners(const OwnedMesh& mesh);

// Conversion of an OBJ file to a Scene.

/// Returns a scene with the primitives that a glTF converted from the model would have. `with_images`: also the bytes
/// of normal maps. Throws FileError.
Scene sceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images);

/// Returns the scene with materials for rendering. `with_images`: with the bytes of base color images and normal maps.
/// Faces are double-sided, since OBJ has no culling.
DrawnScene drawnSceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images);

}  // namespace tspace::obj
