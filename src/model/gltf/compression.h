// SPDX-License-Identifier: MIT
// Geometry compression of whole files, with Draco or meshopt.
#pragma once

#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/editor.h"
#include "tspace/generate.h"

namespace tspace::gltf {

// Adds KHR_draco_mesh_compression to uncompressed triangle primitives.

/// Encodes every triangle primitive that is not Draco-compressed yet (strips and fans become lists). Float positions
/// are quantized to 14 bits, normals to 10 and UVs to 12; everything else is stored exactly. The accessors then contain
/// the quantized values. Vertices and triangles keep their order; a primitive that shares vertices with others gets a
/// copy of its vertices. Morph targets stay uncompressed. Returns warnings about extensions that reference vertices.
std::vector<std::string> packDraco(Document& document, Editor& editor);

// Conversion of a file's geometry from any compression to a requested one: it is decompressed before frames are
// computed, and compressed at the end.

/// Decompresses geometry whose compression differs from the requested one. Draco encoding happens here, before frames
/// are computed, because it quantizes and frames must match the quantized values. `new_file_name`: see Editor. Returns
/// whether anything changed. Fails with unsupportedFile if this build lacks the library.
bool unpackGeometry(Document& document, Compression compression, const std::string& new_file_name,
                    std::vector<std::string>& warnings);

/// Encodes uncompressed geometry with meshopt, which is lossless and can therefore run after frames are computed.
/// Returns whether anything changed.
bool packGeometry(Document& document, Compression compression, const std::string& new_file_name);

}  // namespace tspace::gltf
