// SPDX-License-Identifier: MIT
// Loads a glTF file and the bytes that it needs.
#pragma once

#include "model/gltf/document.h"
#include "model/io/file_io.h"
#include "model/io/path.h"

namespace tspace::gltf {

/// Parses a .glb or .gltf (distinguished by content), and reads its buffers. Checks asset.version, buffers, buffer
/// views and accessors (types, ranges), and that no buffer URI leaves the folder of `path`. Images are not read; an
/// image URI that may not be followed causes a warning.
Document parseDocument(Bytes file_bytes, const Path& path, const FileOptions& options);

/// Fails with unsupportedFile if a required extension compresses the geometry and this build cannot decode it. Adds one
/// warning for each other unknown required extension; their data is preserved unchanged.
void checkRequiredExtensions(Document& document);

}  // namespace tspace::gltf
