// SPDX-License-Identifier: MIT
// generateFile for glTF inputs.
#pragma once

#include <string>

#include "tspace/asset.h"

namespace tspace::gltf {

Result<GenerateReport> generateGltf(const std::string& input, const std::string& output,
                                    const GenerateOptions& options);

}  // namespace tspace::gltf
