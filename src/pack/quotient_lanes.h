// SPDX-License-Identifier: MIT
// Whole numbers divided by constants. Included as frame_lanes.h.
#pragma once

#include "pack/frame_lanes.h"

namespace tspace::pack::TSPACE_LANES {

/// n / kBy, exact for n < 2^31: with 2^s <= kBy < 2^(s + 1) and m = ceil(2^(32 + s) / kBy), what m adds to the quotient,
/// n (m kBy - 2^(32 + s)) / 2^(32 + s) / kBy, is less than 1 / kBy, since the bracket is less than 2^(s + 1).
template <std::uint32_t kBy>
inline Bits quotient(Bits n) {
    constexpr int kShift = [] {
        int s = 0;
        while (kBy >> (s + 1) != 0) ++s;
        return s;
    }();
    constexpr std::uint64_t kFactor = ((std::uint64_t{1} << (32 + kShift)) + kBy - 1) / kBy;
    static_assert(kFactor >> 32 == 0);
    return shiftRight<kShift>(highProduct(n, static_cast<std::uint32_t>(kFactor)));
}

}  // namespace tspace::pack::TSPACE_LANES
