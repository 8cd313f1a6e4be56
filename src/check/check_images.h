// SPDX-License-Identifier: MIT
// The normal maps of a scene.
#pragma once

#include "asset/scene.h"
#include "tspace/check.h"

namespace tspace {

struct ImageFindings {
    std::vector<Finding> findings = {};
    std::vector<std::size_t> images = {};      ///< per finding: which image
    std::vector<bool> green_points_down = {};  ///< per image of the scene
    std::uint64_t looked_at = 0;               ///< images that could be decoded
};

/// Looks at every image that is a normal map, once.
ImageFindings checkImages(const Scene& scene, const CheckOptions& options);

/// True when the primitive's tangents are for a normal map whose green points down.
bool isGreenDown(const ScenePrimitive& primitive, const ImageFindings& images);

}  // namespace tspace
