// SPDX-License-Identifier: MIT
// Any model file as a Scene.
#pragma once

#include <string>

#include "asset/scene.h"

namespace tspace {

/// Reads a model. `with_images`: also the bytes of images that a TangentUse names; an image that cannot be read is no
/// error. Fails as generateFile does, also with tooLarge where a small file makes arrays that are far larger than
/// itself. Throws FileError.
Scene readScene(const std::string& input, const FileOptions& options, bool with_images);

}  // namespace tspace
