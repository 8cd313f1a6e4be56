// SPDX-License-Identifier: MIT
// Numbers, lines and scales in pictures.
#pragma once

#include <string_view>

#include "commands/shared/picture/camera.h"
#include "images/image.h"
#include "tspace/vec.h"

namespace tspace {

/// Sets pixels `left` to `left + width - 1` of rows `top` ...; what lies outside of the image is left out.
void fillRect(RgbImage& image, std::int64_t left, std::int64_t top, std::int64_t width, std::int64_t height,
              const Vec3& color);

/// Digits, and spaces, each 5 x 7 dots of `dot` x `dot` pixels, one dot apart. Other characters count as spaces.
void drawDigits(RgbImage& image, std::int64_t left, std::int64_t top, std::int64_t dot, std::string_view text,
                const Vec3& color);

/// Lines around u and v from 0 to 1, in a picture of points (u, -v, 0). `samples`: of the camera, along a pixel.
void drawUvSquare(RgbImage& image, const Camera& camera, std::uint32_t samples);

/// Rows that the scale of heatColor takes in a picture of this width; 0: there is no room for it.
std::uint32_t heatScaleRows(std::uint32_t width);
/// The scale in the last heatScaleRows of a picture: a bar, and degrees under it.
void drawHeatScale(RgbImage& image);

}  // namespace tspace
