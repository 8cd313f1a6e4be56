// SPDX-License-Identifier: MIT
// An OBJ file as a Scene.
#pragma once

#include <span>

#include "model/obj/obj_primitives.h"
#include "model/scene/drawn_scene.h"
#include "model/scene/scene.h"

namespace tspace::obj {

/// The primitives that a glTF made from the model would have. `with_images`: also the bytes of normal maps. Throws
/// FileError.
Scene sceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images);

/// The same with looks, and `with_images` base colours too. Both sides are drawn, since nothing in an OBJ file says that
/// one is not.
DrawnScene drawnSceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images);

}  // namespace tspace::obj
