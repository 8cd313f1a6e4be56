// SPDX-License-Identifier: MIT
// Conversion between linear light and sRGB, colors of pictures, rectangles and lines. Uses no C library functions whose
// last bits differ between platforms.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "commands/shared/picture/visible_triangles.h"
#include "images/image.h"
#include "tspace/span.h"

namespace tspace {

/// Converts an sRGB value (0 to 1) to linear light (0 to 1).
double srgbToLight(double stored);
/// Returns linear light for the sRGB integers 0 to 2^bits - 1 (8 or 16 bits).
std::vector<float> srgbTable(unsigned bits);
/// Converts linear light to the nearest sRGB byte. Clamps to 0 to 1; NaN becomes 0.
std::uint8_t lightToSrgb(float light);

/// Colors of the background, and of text and lines on it.
inline constexpr Vec3 kBackground{0.925f, 0.933f, 0.945f}, kPictureInk{0.15f, 0.16f, 0.18f};

/// Colors of the view `sign`.
inline constexpr Vec3 kSignPlus{0.42f, 0.60f, 0.86f}, kSignMinus{0.95f, 0.66f, 0.33f},
    kSignNeither{0.90f, 0.20f, 0.80f}, kSignWrong{0.80f, 0.08f, 0.10f}, kSignStripes{0.20f, 0.20f, 0.24f};

/// Color of surfaces without data, and the first of the island colors.
inline constexpr Vec3 kNoData{0.55f, 0.55f, 0.55f}, kIslandColor{0.55f, 0.74f, 0.89f};

/// Returns a vector with components from -1 to 1 as a color: 0.5 v + 0.5.
inline Vec3 vectorColor(const Vec3& v) { return {0.5f * v.x + 0.5f, 0.5f * v.y + 0.5f, 0.5f * v.z + 0.5f}; }

/// Angles in degrees and their colors in heatColor. Colors between two stops are interpolated.
struct HeatStop {
    float degrees;
    Vec3 color;
};
inline constexpr std::array<HeatStop, 7> kHeatStops = {{{0, {0.16f, 0.19f, 0.35f}},
                                                        {1, {0.13f, 0.47f, 0.71f}},
                                                        {5, {0.20f, 0.71f, 0.48f}},
                                                        {15, {0.93f, 0.88f, 0.25f}},
                                                        {45, {0.96f, 0.55f, 0.12f}},
                                                        {90, {0.84f, 0.15f, 0.16f}},
                                                        {180, {0.95f, 0.35f, 0.90f}}}};
/// Returns the color of an angle in degrees, from 0 to 180.
Vec3 heatColor(float degrees);

// Rectangles and lines in pictures.

/// Fills a rectangle, clipped to the image.
void fillRect(RgbImage& image, std::int64_t left, std::int64_t top, std::int64_t width, std::int64_t height,
              const Vec3& color);

/// Draws the outline of the UV unit square, in a picture of points (u, -v, 0). `samples`: samples of the camera along
/// each side of a pixel.
void drawUvSquare(RgbImage& image, const Camera& camera, std::uint32_t samples);

/// Draws a white vertical line with dark borders through the center.
void drawDividingLine(RgbImage& image);

}  // namespace tspace
