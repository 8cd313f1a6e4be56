// SPDX-License-Identifier: MIT
// From coordinates in double, as the file has them, to the floats that everything else works on.
#pragma once

#include <vector>

#include "model/obj/obj_model.h"
#include "tspace/asset.h"

namespace tspace::obj {

/// Sets the positions of the model, whose faces and corners are there. Where the coordinates are so far from the origin
/// that floats would not hold the shape, Model::offset is taken out of all of them first (one for the whole file, unless
/// `keep_coordinates`), and a warning says so; another one says where floats do not hold the shape in the end.
/// Positions that are not finite become zero.
void takePositions(std::vector<DVec3> positions, const FileOptions& options, Model& model);

}  // namespace tspace::obj
