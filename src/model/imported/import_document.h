// SPDX-License-Identifier: MIT
// Formats that tspace-import, a program of its own, converts to GLB.
#pragma once

#include "model/gltf/document.h"
#include "model/io/path.h"
#include "tspace/asset.h"

namespace tspace {

/// True for the extensions of formats that tspace reads through the importer (.fbx, .ply, .stl, .dae, .3ds, ...).
bool isImportedFormat(const Path& path);

/// Runs the importer on the file, with limits on memory and time, and parses what it wrote. `path` and `folder` are
/// those of the file. `progress` is called while the importer works, and may end it by throwing. Fails with
/// unsupportedFile when there is no importer; with invalidFile when it cannot read the file, crashes, or passes a limit.
gltf::Document importDocument(const Path& path, const FileOptions& options, const Progress& progress = {});

}  // namespace tspace
