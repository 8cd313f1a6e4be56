// SPDX-License-Identifier: MIT
// Meshes of the shared glTF models and their poses, for shaders/tspace_evaluate.*.
#pragma once

#include <string>
#include <vector>

#include "evaluate_cases.h"

namespace tspace::shaders {

/// Returns the paths of the glTF files of the shared test data. Returns none if the data is absent.
std::vector<std::string> sharedModels();

/// Returns the primitives of a model that have normals and UVs. Each has its rest pose, a bent pose, one pose per morph
/// target, and those of its skins. Primitives are skipped if they have more triangles than the environment variable
/// TSPACE_MODEL_TRIANGLES (default: 1,000). Throws FileError.
std::vector<PosedMesh> meshesOfModel(const std::string& path);

}  // namespace tspace::shaders
