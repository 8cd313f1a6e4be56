// SPDX-License-Identifier: MIT
// Unit vectors as normalized integers: 127 or 32767 steps from 0 to 1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/pack.h"
#include "tspace/span.h"

namespace tspace {

/// Returns the number of steps from 0 to 1; 0 for floats.
std::int32_t latticeSteps(VectorFormat format);

/// Lattice point for a unit vector, with a decoded length close to 1. Among the corners of the cell around the vector,
/// it is the one with the nearest direction whose length deviates by at most 0.006 (the glTF validator allows 0.0067),
/// or, if there is none, the one with the best length. Vectors that are not unit are rounded directly; NaN becomes 0.
struct LatticePoint {
    std::int32_t x = 0, y = 0, z = 0;
};
LatticePoint nearestUnit(const Vec3& vector, std::int32_t steps);

/// Replaces each vector by its value after a round trip through the format. Idempotent.
void roundUnits(std::span<Vec3> vectors, VectorFormat format);
void roundUnits(std::span<Vec4> tangents, VectorFormat format);

/// Returns the bytes of normals (three components each) and tangents (four; the sign is exactly +1 or -1) in this
/// format, tightly packed.
std::vector<std::uint8_t> packUnits(std::span<const Vec3> normals, VectorFormat format);
std::vector<std::uint8_t> packUnits(std::span<const Vec4> tangents, VectorFormat format);

}  // namespace tspace
