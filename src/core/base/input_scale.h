// SPDX-License-Identifier: MIT
// Powers of four that bring coordinates near 1, so that fourth powers of small UVs do not vanish. Multiplying
// with them changes no bit of a mantissa, and none of a square root's. So it does not matter to results which
// one is chosen, nor whether all positions, or all UVs, are four times as large.
#pragma once

#include <algorithm>
#include <cfloat>

#include "core/base/range_lists.h"
#include "tspace/tangents.h"

namespace tspace {

struct InputScale {
    float positions = 1, uvs = 1;

    /// The factor for lengths of dP/du in scaled units.
    [[nodiscard]] float lengthFactor() const {
        return static_cast<float>(std::clamp(static_cast<double>(uvs) / positions, double{FLT_MIN}, double{FLT_MAX}));
    }
};

/// From a sample of at most 1024 triangles, so that it does not matter which corners share a vertex, nor what vertices
/// no triangle names. Zeros, what is not finite, and degenerate triangles do not count. `uvs` may be empty.
InputScale inputScale(const TriangleGroups& triangles, const StridedSpan<const Vec3>& positions,
                      const StridedSpan<const Vec2>& uvs);

}  // namespace tspace
