// SPDX-License-Identifier: MIT
// The normal maps of a scene.
#pragma once

#include "commands/check/map_content.h"
#include "commands/check/normal_map.h"
#include "model/scene/scene.h"
#include "tspace/check.h"

namespace tspace {

/// What is known of green in one normal map, or in the part of it that one primitive shows. Where the file declares that it
/// points down, and it does, that is up: its readers turn it.
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
    std::uint64_t looked_at = 0;           ///< images that could be decoded
    std::uint64_t green_told = 0;          ///< of those: which way green points shows
    std::vector<MapLook> looks = {};       ///< per image of the scene: what its channels hold
    std::vector<bool> is_y_inverted = {};  ///< per image: y is, and no finding on green says so, since it is elsewhere
    std::vector<bool> is_declared = {};    ///< per image: the file says that green points down (TangentUse)
};

/// Looks at every image that is a normal map, once.
ImageFindings checkImages(const Scene& scene, const CheckOptions& options);

/// A note for each normal map whose scale is 0 or below.
std::vector<Finding> checkMapScales(const Scene& scene);

}  // namespace tspace
