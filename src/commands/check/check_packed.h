// SPDX-License-Identifier: MIT
// The packed frames of a scene.
#pragma once

#include <vector>

#include "model/scene/scene.h"
#include "tspace/check.h"

namespace tspace {

struct PackedFindings {
    std::vector<Finding> findings = {};
    std::vector<PackedFramesInfo> infos = {};  ///< all that there are, in the order of the scene
};

/// Reads all packed frames back and compares them with the normals and tangents beside them; each once, however many
/// primitives share them.
PackedFindings checkPacked(const Scene& scene, const CheckOptions& options);

}  // namespace tspace
