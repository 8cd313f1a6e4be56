// SPDX-License-Identifier: MIT
// Vectors as integers: with few bits, the length decides how well they point.
#pragma once

#include "core/vec_math.h"

namespace tspace {

/// What integers stand for: n from 0 to `most` for 2 n / most - 1.
struct IntegerVectors {
    unsigned most = 255;
    /// Shorter ones lose under filters that make texels unit.
    double least_length = 0.7;
    bool is_two_channel = false;  ///< z follows from x and y, whose vector is unit
};

/// Each component to the nearest that an integer stands for.
DVec3 roundedVector(unsigned most, const DVec3& vector);

/// The vector of integers that points nearest to a direction, of any length from the least to what fits. With two channels the
/// length is 1 (z as close as it can be), and z must not be negative. `direction` is unit.
DVec3 nearestIntegers(const IntegerVectors& numbers, const DVec3& direction);

}  // namespace tspace
