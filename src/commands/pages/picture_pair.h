// SPDX-License-Identifier: MIT
// Two pictures of one location, before and after a change, with the camera and the light that show the difference best.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "commands/render/model_picture.h"

namespace tspace {

/// PNGs of equal size. Empty if no camera and light shows a difference.
struct PicturePair {
    std::vector<std::uint8_t> before = {}, after = {};
    /// grayscale: the largest difference of any channel, times `gain`; black where neither side shows the primitive
    std::vector<std::uint8_t> difference = {};
    unsigned gain = 1;
    double differing_share = 0;  ///< share of the pixels that show the primitive and differ
    bool is_clay = false;        ///< base colors are omitted, because they would hide the difference
};

/// A primitive of a model that was prepared for RenderShow::lit.
struct PicturedPrimitive {
    const ModelPicture& model;
    std::size_t primitive = 0;
};

/// Draws both pictures with the camera and light that show the largest difference. Tries cameras above `triangles` of
/// the primitive before the change, cameras from six sides of the whole primitive, and cameras above the location with
/// the largest difference, each with lights from all directions. A view of `triangles` is chosen if it shows at least
/// half of the largest difference, unless the whole primitive shows a clear difference. In this view, a frame marks the
/// triangles if the pixels around them differ by at least half of the mean difference. Differences of other primitives
/// are not counted. The bytes are the same on every machine. Throws FileError.
PicturePair drawPair(const PicturedPrimitive& before, std::span<const std::size_t> triangles,
                     const PicturedPrimitive& after);

}  // namespace tspace
