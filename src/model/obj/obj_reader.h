// SPDX-License-Identifier: MIT
// Reads OBJ and MTL files into a Model. Functions throw FileError.
#pragma once

#include <string>
#include <vector>

#include "model/io/path.h"
#include "model/obj/obj_model.h"
#include "tspace/asset.h"

namespace tspace::obj {

/// Fails with cannotRead, invalidFile (place: "line N") and unsupportedFile. MTL files that are missing or
/// forbidden are left out with a warning.
Model readModel(const Path& path, const FileOptions& options);

/// The materials of the named libraries. `names` is what stands after `mtllib`: a file name, or several with
/// spaces between.
std::vector<Material> readMaterials(const std::vector<std::string>& names, Model& model);

}  // namespace tspace::obj
