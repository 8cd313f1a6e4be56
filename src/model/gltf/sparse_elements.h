// SPDX-License-Identifier: MIT
// Elements that are nearly all zero, as morph targets have them.
#pragma once

#include "model/gltf/editor.h"

namespace tspace::gltf {

/// Keeps only the elements that are not zero, with their places, where most are zero and the file becomes smaller.
void makeSparseWhereSmaller(ElementData& data);

}  // namespace tspace::gltf
