// SPDX-License-Identifier: MIT
// Packing and unpacking the geometry of a whole file, before anything is computed from it: frames belong to the values
// that are written.
#pragma once

#include <string>

#include "asset/gltf/document.h"

namespace tspace::gltf {

/// Brings the document to the given compression. `new_file_name` as for Editor. Returns false when nothing had to
/// change. Fails with unsupportedFile when this build has not the library.
bool recompress(Document& document, Compression compression, const std::string& new_file_name);

}  // namespace tspace::gltf
