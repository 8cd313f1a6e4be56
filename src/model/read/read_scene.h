// SPDX-License-Identifier: MIT
// Functions that read model files of any format.
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

// Models as glTF documents: glTF itself, and the importer's result for other formats.

/// Reads the file, or FileOptions::content, like parseDocument. `progress` is called while the importer reads a file of
/// another format. Throws FileError.
Document loadDocument(const Path& path, const FileOptions& options, const Execution& execution = {.thread_count = 1},
                      const Progress& progress = {});

}  // namespace tspace::gltf

namespace tspace {

// Conversion of any model file to a Scene.

/// Reads a model. `with_images`: also the image bytes of every TangentUse; an unreadable image is not an error. Fails
/// like generateFile, and with tooLarge if the arrays of a small file are far larger than the file. Throws FileError.
Scene readScene(const std::string& input, const FileOptions& options, bool with_images);

/// Reads a scene with placements and surface looks. `with_images`: also the bytes of images that pictures need. Faces
/// of an OBJ file without normals get those that generateFile computes.
DrawnScene readDrawnScene(const std::string& input, const FileOptions& options, bool with_images);

/// Reads a scene like readDrawnScene, with everything that materials use: images of base color, metalness and emission,
/// and vertex colors as stored. `with_normal_maps`: also normal maps. OBJ has only base color images.
DrawnScene readMaterialScene(const std::string& input, const FileOptions& options, bool with_normal_maps);

/// Reads a scene like readDrawnScene, with all textures of materials, and with the pose stored in the file.
PosedScene readPosedScene(const std::string& input, const FileOptions& options, bool with_images);

}  // namespace tspace
