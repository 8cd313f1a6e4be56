// SPDX-License-Identifier: MIT
// Loading a glTF file and the bytes that it needs.
#pragma once

#include "model/gltf/document.h"
#include "model/io/file_io.h"
#include "model/io/path.h"

namespace tspace::gltf {

/// Reads a .glb or .gltf (told apart by content) from its bytes, and its buffers. Checks asset.version, buffers, buffer views
/// and accessors (types, ranges), and that no URI of a buffer leads out of the folder, which is that of `path`. Images are
/// not read; a URI of one that may not be followed gets a warning.
Document parseDocument(Bytes file_bytes, const Path& path, const FileOptions& options);

/// Fails with unsupportedFile when a required extension hides the geometry and this build cannot decode it. Adds one
/// warning for each other required extension that this program does not know; their data survives untouched.
void checkRequiredExtensions(Document& document);

}  // namespace tspace::gltf
