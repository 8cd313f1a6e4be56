// SPDX-License-Identifier: MIT
// Giving plain triangle primitives the extension KHR_draco_mesh_compression.
#pragma once

#include "model/gltf/editor.h"

namespace tspace::gltf {

/// Encodes every primitive of triangles (strips and fans become lists) that is not Draco-compressed yet. Float
/// positions are rounded to 14 bits, normals to 10 and UVs to 12; all else is stored exactly. The accessors then have
/// the rounded values. Vertices and triangles keep their order; a primitive that shares vertices with others gets its
/// own part of them. Morph targets stay plain. Returns warnings about extensions that name vertices.
std::vector<std::string> packDraco(Document& document, Editor& editor);

}  // namespace tspace::gltf
