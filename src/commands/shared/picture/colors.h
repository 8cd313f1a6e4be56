// SPDX-License-Identifier: MIT
// Light and colours, without functions of the C library whose last bits differ.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tspace/vec.h"

namespace tspace {

/// The light, 0 to 1, of a stored value of sRGB, 0 to 1.
double srgbToLight(double stored);
/// The light of the integers 0 to 2^bits - 1 (8 or 16 bits).
std::vector<float> srgbTable(unsigned bits);
/// The 8 bits of sRGB nearest to this light; beyond 0 and 1 the nearest of them, and 0 for NaN.
std::uint8_t lightToSrgb(float light);
/// Eight bits of a value from 0 to 1, as they are.
std::uint8_t storedByte(float value);

/// The background.
inline constexpr Vec3 kBackground{0.925f, 0.933f, 0.945f};

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

}  // namespace tspace
