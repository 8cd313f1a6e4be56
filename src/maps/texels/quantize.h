// SPDX-License-Identifier: MIT
// Vectors as integers: with few bits, the length determines the accuracy of the direction.
#pragma once

#include "core/base/vec_math.h"

namespace tspace {

/// Set of the vectors that integers represent: n from 0 to `most` represents 2 n / most - 1.
struct IntegerVectors {
    unsigned most = 255;
    /// Minimum vector length. Shorter vectors would have too little weight under filters that mix texels.
    double least_length = 0.7;
    bool is_two_channel = false;  ///< true: z is reconstructed from x and y (unit vectors)
    double scale = 1;             ///< factor by which readers multiply x and y
};

/// Rounds each component of a vector to the nearest value that an integer channel from 0 to `most` can represent.
DVec3 roundedVector(unsigned most, const DVec3& vector);

/// Returns the integer vector whose direction, as decoded by readers, is closest to that of `direction`. It has any
/// length from the minimum to 1. With two channels, the length is 1 (z is as close as possible), and z of `direction`
/// must not be negative. `direction`: unit vector as stored, that is, with x and y divided by the scale.
DVec3 nearestIntegers(const IntegerVectors& numbers, const DVec3& direction);

}  // namespace tspace
