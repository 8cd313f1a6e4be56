// SPDX-License-Identifier: MIT
// The geometry of a whole file, from any compression to a given one: unpacked before anything is computed from it, and packed
// when all is done.
#pragma once

#include <string>
#include <vector>

#include "model/gltf/document.h"

namespace tspace::gltf {

/// Unpacks geometry whose compression differs from the requested one. Draco is encoded here, before frames are
/// computed: it rounds, and frames must fit the rounded values. `new_file_name` as for Editor. Returns false when nothing
/// had to change. Fails with unsupportedFile when this build lacks the library.
bool unpackGeometry(Document& document, Compression compression, const std::string& new_file_name,
                    std::vector<std::string>& warnings);

/// Encodes plain geometry by meshopt, which is lossless and so can run after frames are computed. Returns false when
/// nothing had to change.
bool packGeometry(Document& document, Compression compression, const std::string& new_file_name);

}  // namespace tspace::gltf
