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

/// readScene with materials for rendering, and `with_images` base colours too. Faces are double-sided, since OBJ has no
/// culling.
DrawnScene drawnSceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images);

}  // namespace tspace::obj
