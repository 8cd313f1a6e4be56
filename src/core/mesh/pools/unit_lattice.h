// SPDX-License-Identifier: MIT
// Unit vectors as normalised integers: 127 or 32767 steps from 0 to 1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/pack.h"
#include "tspace/span.h"

namespace tspace {

/// Steps from 0 to 1; 0 for floats.
std::int32_t latticeSteps(VectorFormat format);

/// The lattice point next to a unit vector whose length, as a reader computes it, is near 1: of the corners of the cell
/// around the vector the one of nearest direction whose length is off by at most 0.006 (the glTF validator allows
/// 0.0067), else the one of best length. Vectors that are not unit are rounded as they are, NaN to 0.
struct LatticePoint {
    std::int32_t x = 0, y = 0, z = 0;
};
LatticePoint nearestUnit(const Vec3& vector, std::int32_t steps);

/// Each vector becomes what a reader of this format gets. Rounding twice is rounding once.
void roundUnits(std::span<Vec3> vectors, VectorFormat format);
void roundUnits(std::span<Vec4> tangents, VectorFormat format);

/// Bytes of normals (three components each) and tangents (four; the sign is exactly +1 or -1) in this format, tightly
/// packed.
std::vector<std::uint8_t> packUnits(std::span<const Vec3> normals, VectorFormat format);
std::vector<std::uint8_t> packUnits(std::span<const Vec4> tangents, VectorFormat format);

}  // namespace tspace
