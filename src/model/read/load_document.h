// SPDX-License-Identifier: MIT
// Models as glTF documents: glTF itself, and what the importer makes of other formats.
#pragma once

#include "model/gltf/document.h"
#include "model/io/path.h"
#include "tspace/asset.h"

namespace tspace::gltf {

/// Reads the file, or FileOptions::content, as parseDocument does. `progress` is called while the importer reads a file
/// of another format. Throws FileError.
Document loadDocument(const Path& path, const FileOptions& options, const Execution& execution = {.thread_count = 1},
                      const Progress& progress = {});

}  // namespace tspace::gltf
