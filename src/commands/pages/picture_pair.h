// SPDX-License-Identifier: MIT
// Two pictures of one place, before and after a change, with the camera and the light that show the difference best.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "commands/render/model_picture.h"

namespace tspace {

/// PNGs of one size. Empty where no camera and light shows a difference.
struct PicturePair {
    std::vector<std::uint8_t> before = {}, after = {};
    std::vector<std::uint8_t> difference = {};  ///< brightness: the largest difference of a channel, times `gain`
    unsigned gain = 1;
    double differing_share = 0;  ///< share of the pixels that differ
    bool is_clay = false;        ///< without base colors, which would hide the difference
};

/// A primitive of a model, which was prepared for RenderShow::lit.
struct PicturedPrimitive {
    const ModelPicture& model;
    std::size_t primitive = 0;
};

/// Tries, in this order, cameras over `triangles` of the primitive before the change, from six sides of all of it, and over the
/// place where these differ most, each with lights from all around; the largest difference wins, and the place itself where it
/// shows half of that. A frame marks the place, beside it. The same bytes on every machine. Throws FileError.
PicturePair drawPair(const PicturedPrimitive& before, std::span<const std::size_t> triangles,
                     const PicturedPrimitive& after);

}  // namespace tspace
