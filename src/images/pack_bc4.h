// SPDX-License-Identifier: MIT
// A channel of BC4 and BC5, packed from numbers that are finer than 8 bits.
#pragma once

#include <array>
#include <cstdint>

namespace tspace {

/// The block whose decoded values are nearest to `values` (0 to 1; those of a signed format as (v + 1) / 2) by the sum of squares:
/// of all pairs of ends near the least and the largest value, and their neighbours.
std::array<std::uint8_t, 8> packBc4(const std::array<float, 16>& values, bool is_signed);

}  // namespace tspace
