// SPDX-License-Identifier: MIT
// Creates a glTF document: meshes, materials, images, and their buffer.
#pragma once

#include <string>
#include <vector>

#include "core/base/owned_mesh.h"
#include "model/gltf/document.h"
#include "model/gltf/packed_layout.h"
#include "model/io/path.h"
#include "model/obj/obj_reader.h"

namespace tspace::obj {

/// Attribute of packed frames with its elements, tightly packed.
struct PackedAttribute {
    gltf::PackedPart part;
    Bytes elements = {};
};

/// Primitive that is ready to be written.
struct FinishedPrimitive {
    std::uint32_t shape = 0;
    std::uint32_t material = 0;
    OwnedMesh mesh = {};                ///< triangles with indices
    std::vector<Vec3> bitangents = {};  ///< one per vertex; empty if there are none
    std::vector<PackedAttribute> packed = {};
    VectorFormat normal_format = VectorFormat::float32, tangent_format = VectorFormat::float32;
};

/// Returns a document of the model, to be written to `output` (.glb, or .gltf with a .bin next to it). It references
/// only files in the folder of `output`: images in this folder are referenced by URI, others are stored in its buffer.
/// Textures that are missing, forbidden or neither PNG nor JPEG are skipped with a warning. Throws FileError.
gltf::Document toDocument(Model&& model, const std::vector<FinishedPrimitive>& primitives, const Path& output,
                          std::vector<std::string>& warnings);

}  // namespace tspace::obj
