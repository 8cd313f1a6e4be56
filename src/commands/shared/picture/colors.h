// SPDX-License-Identifier: MIT
// Light and colours, without functions of the C library whose last bits differ; rectangles and lines in pictures.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "commands/shared/picture/visible_triangles.h"
#include "images/image.h"
#include "tspace/span.h"

namespace tspace {

/// The light, 0 to 1, of a stored value of sRGB, 0 to 1.
double srgbToLight(double stored);
/// The light of the integers 0 to 2^bits - 1 (8 or 16 bits).
std::vector<float> srgbTable(unsigned bits);
/// The 8 bits of sRGB nearest to this light; beyond 0 and 1 the nearest of them, and 0 for NaN.
std::uint8_t lightToSrgb(float light);
/// Eight bits of a value from 0 to 1, as they are.
std::uint8_t storedByte(float value);

/// The background, and what is written or drawn on it.
inline constexpr Vec3 kBackground{0.925f, 0.933f, 0.945f}, kPictureInk{0.15f, 0.16f, 0.18f};

/// The colours of `sign`.
inline constexpr Vec3 kSignPlus{0.42f, 0.60f, 0.86f}, kSignMinus{0.95f, 0.66f, 0.33f},
    kSignNeither{0.90f, 0.20f, 0.80f}, kSignWrong{0.80f, 0.08f, 0.10f}, kSignStripes{0.20f, 0.20f, 0.24f};

/// Color for missing data; and the first of the island colors.
inline constexpr Vec3 kNothingKnown{0.55f, 0.55f, 0.55f}, kIslandColor{0.55f, 0.74f, 0.89f};

/// A vector with components from -1 to 1 as a colour: 0.5 v + 0.5.
inline Vec3 vectorColor(const Vec3& v) { return {0.5f * v.x + 0.5f, 0.5f * v.y + 0.5f, 0.5f * v.z + 0.5f}; }

/// Degrees where the colours of heatColor change, and the colours there. Between two of them a colour is mixed.
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
/// The colour of an angle in degrees, 0 to 180.
Vec3 heatColor(float degrees);

// Rectangles and lines in pictures.

/// Sets pixels `left` to `left + width - 1` of rows `top` ...; what lies outside of the image is left out.
void fillRect(RgbImage& image, std::int64_t left, std::int64_t top, std::int64_t width, std::int64_t height,
              const Vec3& color);

/// Lines around u and v from 0 to 1, in a picture of points (u, -v, 0). `samples`: of the camera, along a pixel.
void drawUvSquare(RgbImage& image, const Camera& camera, std::uint32_t samples);

/// A white line with dark borders down the middle.
void drawDividingLine(RgbImage& image);

}  // namespace tspace
