// SPDX-License-Identifier: MIT
// A small rasteriser: one lit mesh on a plain background, textures read as they are, edges smoothed by more samples
// than pixels. No clipping, no shadows. Only sqrt is used of libm, so that the pixels are the same everywhere.
#pragma once

#include <cstdint>
#include <vector>

#include "../demo_model/crate.h"
#include "tspace/vec.h"

namespace picture {

/// What a vertex shader hands on.
struct Corner {
    tspace::Vec3 position;
    tspace::Vec3 normal;
    tspace::Vec2 uv;
    tspace::Vec4 tangent;  ///< xyz and the sign
};

struct Scene {
    std::vector<Corner> corners;  ///< three per triangle, counter-clockwise
    const crate::Textures* textures = nullptr;
    tspace::Vec3 eye, target;   ///< y is up
    float zoom = 1;             ///< what lies 1 / zoom beside the target's line, at distance 1, is at the border
    tspace::Vec3 to_key_light;  ///< any length
};

/// size * size pixels of RGB, from the top row downwards.
std::vector<std::uint8_t> draw(const Scene& scene, int size);

}  // namespace picture
