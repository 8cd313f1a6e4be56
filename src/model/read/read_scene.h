// SPDX-License-Identifier: MIT
// Any model file as a Scene.
#pragma once

#include <string>

#include "model/scene/drawn_scene.h"
#include "model/scene/scene.h"

namespace tspace {

/// Reads a model. `with_images`: also the bytes of images that a TangentUse names; an image that cannot be read is no
/// error. Fails as generateFile does, also with tooLarge where a small file makes arrays that are far larger than
/// itself. Throws FileError.
Scene readScene(const std::string& input, const FileOptions& options, bool with_images);

/// The same with places and looks, and `with_images` the bytes of those images that pictures show. Faces of an OBJ file
/// without normals get those that generateFile gives them.
DrawnScene readDrawnScene(const std::string& input, const FileOptions& options, bool with_images);

}  // namespace tspace
