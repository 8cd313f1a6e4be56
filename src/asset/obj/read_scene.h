// SPDX-License-Identifier: MIT
// An OBJ file as a Scene.
#pragma once

#include <span>

#include "asset/obj/obj_primitives.h"
#include "asset/scene.h"

namespace tspace::obj {

/// The primitives that a glTF made from the model would have. `with_images`: also the bytes of normal maps. Throws
/// FileError.
Scene sceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images);

}  // namespace tspace::obj
