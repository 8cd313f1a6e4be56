// SPDX-License-Identifier: MIT
// The lists of extensions that a file names at its root.
#pragma once

#include "model/gltf/document.h"

namespace tspace::gltf {

/// Names the extension in extensionsUsed and extensionsRequired, where it is not named yet.
void requireExtension(Document& document, const char* name);

/// Takes the name out of both lists; an empty list goes too.
void dropExtension(Document& document, const char* name);

}  // namespace tspace::gltf
