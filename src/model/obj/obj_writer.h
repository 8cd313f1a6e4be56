// SPDX-License-Identifier: MIT
// A new glTF document: meshes, materials, images, and the buffer that holds them.
#pragma once

#include <string>
#include <vector>

#include "core/base/owned_mesh.h"
#include "model/gltf/document.h"
#include "model/gltf/packed_layout.h"
#include "model/io/path.h"
#include "model/obj/obj_reader.h"

namespace tspace::obj {

/// An attribute that holds packed frames, and its elements, tightly packed.
struct PackedAttribute {
    gltf::PackedPart part;
    Bytes elements = {};
};

/// One primitive, ready to be written.
struct FinishedPrimitive {
    std::uint32_t shape = 0;
    std::uint32_t material = 0;
    OwnedMesh mesh = {};                ///< triangles, with indices
    std::vector<Vec3> bitangents = {};  ///< empty: none
    std::vector<PackedAttribute> packed = {};
    VectorFormat normal_format = VectorFormat::float32, tangent_format = VectorFormat::float32;
};

/// A document of the model, to be written to `output` (.glb, else .gltf with a .bin beside it), whose folder is the only one
/// that it names files in: images that lie there are named by URI, others go into its buffer. Textures that are missing,
/// forbidden or neither PNG nor JPEG are left out with a warning. Throws FileError.
gltf::Document toDocument(Model&& model, const std::vector<FinishedPrimitive>& primitives, const Path& output,
                          std::vector<std::string>& warnings);

}  // namespace tspace::obj
