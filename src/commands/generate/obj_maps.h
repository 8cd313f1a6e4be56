// SPDX-License-Identifier: MIT
// Normal maps of an OBJ file on their way into glTF: height maps, mended and inverted ones.
#pragma once

#include <span>
#include <vector>

#include "model/obj/obj_primitives.h"
#include "tspace/asset.h"

namespace tspace::obj {

/// Makes normal maps of grey images that materials name as `map_bump`, with the frames of their faces and the factor -bm
/// as strength in units of the model. What cannot be one is taken from its material, with a warning in the model. Then
/// mends and inverts others, as is asked for; all tangents are new, so none are made for a green that points down. The
/// primitives have their normals. Throws FileError.
std::vector<NormalMapReport> prepareMaps(std::span<const ObjPrimitive> primitives, const GenerateOptions& options,
                                         Model& model);

}  // namespace tspace::obj
