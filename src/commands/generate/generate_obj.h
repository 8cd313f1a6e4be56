// SPDX-License-Identifier: MIT
// Wavefront OBJ in, glTF out.
#pragma once

#include <string>

#include "tspace/asset.h"

namespace tspace {

/// generateFile for an OBJ input; `output` is a .glb or .gltf.
Result<GenerateReport> generateObj(const std::string& input, const std::string& output, const GenerateOptions& options);

}  // namespace tspace
