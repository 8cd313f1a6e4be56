// SPDX-License-Identifier: MIT
// Vectors as integers: with few bits, the length decides how well they point.
#pragma once

#include "core/base/vec_math.h"

namespace tspace {

/// The vectors that integers stand for: n from 0 to `most` is 2 n / most - 1.
struct IntegerVectors {
    unsigned most = 255;
    /// Shorter vectors lose weight under filters that make texels unit.
    double least_length = 0.7;
    bool is_two_channel = false;  ///< z follows from x and y, whose vector is unit
    double scale = 1;             ///< readers multiply x and y by it
};

/// Each component to the nearest that an integer stands for.
DVec3 roundedVector(unsigned most, const DVec3& vector);

/// The vector of integers that points nearest to a direction as readers see it, of any length from the least to what fits. With
/// two channels the length is 1 (z as close as it can be), and z must not be negative. `direction`, before the scale, is unit.
DVec3 nearestIntegers(const IntegerVectors& numbers, const DVec3& direction);

}  // namespace tspace
