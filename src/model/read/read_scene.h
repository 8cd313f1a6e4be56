// SPDX-License-Identifier: MIT
// A model file of any format.
#pragma once

#include <string>

#include "model/gltf/document.h"
#include "model/io/path.h"
#include "model/scene/scene.h"
#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/generate.h"
#include "tspace/mesh.h"

namespace tspace::gltf {

// Models as glTF documents: glTF itself, and what the importer makes of other formats.

/// Reads the file, or FileOptions::content, as parseDocument does. `progress` is called while the importer reads a file
/// of another format. Throws FileError.
Document loadDocument(const Path& path, const FileOptions& options, const Execution& execution = {.thread_count = 1},
                      const Progress& progress = {});

}  // namespace tspace::gltf

namespace tspace {

// Any model file as a Scene.

/// Reads a model. `with_images`: also the bytes of images that a TangentUse names; an image that cannot be read is no
/// error. Fails as generateFile does, also with tooLarge where a small file makes arrays that are far larger than
/// itself. Throws FileError.
Scene readScene(const std::string& input, const FileOptions& options, bool with_images);

/// Like readScene, with placements and looks, and `with_images` the bytes of the images that pictures need. Faces of an OBJ
/// file without normals get those that generateFile computes.
DrawnScene readDrawnScene(const std::string& input, const FileOptions& options, bool with_images);

/// Like readDrawnScene, with everything that materials use: images of base color, metalness and emission, and vertex colors as
/// stored. `with_normal_maps`: normal maps too. OBJ has only base color images.
DrawnScene readMaterialScene(const std::string& input, const FileOptions& options, bool with_normal_maps);

/// readDrawnScene with all that materials show, as the file poses it.
PosedScene readPosedScene(const std::string& input, const FileOptions& options, bool with_images);

}  // namespace tspace
