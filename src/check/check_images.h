// SPDX-License-Identifier: MIT
// The normal maps of a scene.
#pragma once

#include "asset/scene.h"
#include "check/normal_map.h"
#include "tspace/check.h"

namespace tspace {

/// What is known of green in one normal map, or in the part of it that one primitive shows.
enum class GreenSide {
    noMap,    ///< the primitive's tangents are for no normal map
    unread,   ///< the image could not be looked at
    unknown,  ///< it was, and says nothing: flat, or no height field
    up,
    down,
    mixed,  ///< up in one part and down in another
};

struct ImageFindings {
    std::vector<Finding> findings = {};
    std::vector<std::size_t> images = {};     ///< per finding: which image
    std::vector<GreenSide> image_green = {};  ///< per image of the scene
    /// Per primitive of the scene: of the normal map that its tangents are for (the first of its uses), in those texels
    /// that the primitive shows.
    std::vector<GreenSide> primitive_green = {};
    std::uint64_t looked_at = 0;  ///< images that could be decoded
};

/// Looks at every image that is a normal map, once.
ImageFindings checkImages(const Scene& scene, const CheckOptions& options);

}  // namespace tspace
