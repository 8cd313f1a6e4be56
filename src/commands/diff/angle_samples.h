// SPDX-License-Identifier: MIT
// Many angles, and their statistics.
#pragma once

#include <vector>

#include "tspace/diff.h"

namespace tspace {

class AngleSamples {
  public:
    /// Degrees between two directions of any length. Pairs of unusable directions (zero, or not finite) are counted,
    /// unless both are. Returns the angle, or 0.
    double add(const Vec3& a, const Vec3& b);
    void append(const AngleSamples& other);

    /// Sorts; O(n log n).
    [[nodiscard]] AngleStatistics statistics() const;

  private:
    std::vector<float> degrees_ = {};
    std::uint64_t unusable_count_ = 0;
};

}  // namespace tspace
