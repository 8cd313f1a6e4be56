// SPDX-License-Identifier: MIT
// The geometry of a whole file, from any compression to a given one: unpacked before anything is computed from it, and packed
// when all is done.
#pragma once

#include <string>
#include <vector>

#include "model/gltf/document.h"

namespace tspace::gltf {

/// Unpacks what is compressed otherwise than asked for. Draco is packed here as well: it rounds, and frames belong to the
/// values that are written. `new_file_name` as for Editor. Returns false when nothing had to change. Fails with
/// unsupportedFile when this build has not the library.
bool unpackGeometry(Document& document, Compression compression, const std::string& new_file_name,
                    std::vector<std::string>& warnings);

/// Packs what is not compressed yet, where the compression keeps every value: meshopt. Returns false when nothing had to
/// change.
bool packGeometry(Document& document, Compression compression, const std::string& new_file_name);

}  // namespace tspace::gltf
