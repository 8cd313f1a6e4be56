// SPDX-License-Identifier: MIT
// Packs the geometry of whole files: by Draco, or by meshopt as it came.
#pragma once

#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/editor.h"
#include "tspace/generate.h"

namespace tspace::gltf {

// Giving plain triangle primitives the extension KHR_draco_mesh_compression.

/// Encodes every primitive of triangles (strips and fans become lists) that is not Draco-compressed yet. Float
/// positions are rounded to 14 bits, normals to 10 and UVs to 12; all else is stored exactly. The accessors then have
/// the rounded values. Vertices and triangles keep their order; a primitive that shares vertices with others gets its
/// own part of them. Morph targets stay plain. Returns warnings about extensions that name vertices.
std::vector<std::string> packDraco(Document& document, Editor& editor);

// The geometry of a whole file, from any compression to a given one: unpacked before anything is computed from it, and packed
// when all is done.

/// Unpacks geometry whose compression differs from the requested one. Draco is encoded here, before frames are
/// computed: it rounds, and frames must fit the rounded values. `new_file_name` as for Editor. Returns false when nothing
/// had to change. Fails with unsupportedFile when this build lacks the library.
bool unpackGeometry(Document& document, Compression compression, const std::string& new_file_name,
                    std::vector<std::string>& warnings);

/// Encodes plain geometry by meshopt, which is lossless and so can run after frames are computed. Returns false when
/// nothing had to change.
bool packGeometry(Document& document, Compression compression, const std::string& new_file_name);

}  // namespace tspace::gltf
