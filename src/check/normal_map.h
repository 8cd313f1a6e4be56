// SPDX-License-Identifier: MIT
// Which way green points in a normal map.
#pragma once

#include "check/image.h"

namespace tspace {

enum class GreenVerdict { unknown, up, down };

struct GreenTest {
    GreenVerdict verdict = GreenVerdict::unknown;
    /// Correlation of the two mixed derivatives over the whole image: -1 for a perfect height field with green up, +1
    /// with green down.
    double correlation = 0;
    std::uint64_t block_count = 0;       ///< blocks that have enough relief to say something
    std::uint64_t down_block_count = 0;  ///< those that say "down"

    /// Of the verdict: how much of the blocks agree beyond an even split, 0 to 1.
    [[nodiscard]] double confidence() const;
};

/// A normal map is the slope of some height h: p = -nx/nz = dh/dx, and q = -ny/nz = dh/dy with y upwards. The order of
/// derivatives does not matter, so dq/dx = dp/dy. Where green points down, q has the wrong sign, and dq/dx = -dp/dy.
/// Real maps are not perfect height fields (baked over seams, painted over, compressed), so blocks of pixels vote. Flat
/// maps, and those with relief along one axis only, get no verdict.
GreenTest testGreen(const RgbImage& image);

}  // namespace tspace
