// SPDX-License-Identifier: MIT
// Bit layout of one-channel blocks, which texel_format.cpp decodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tspace {

/// Packs a BC4 block. If `first` > `second`, the block has eight values, otherwise six values plus 0 and 1. Endpoints
/// of signed formats may be negative. Codes 0 and 1 select the endpoints, the other codes the interpolated values;
/// codes are given row by row.
inline std::array<std::uint8_t, 8> packBc4Block(int first, int second, const std::array<std::uint8_t, 16>& codes) {
    std::array<std::uint8_t, 8> block{static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(second)};
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) bits |= std::uint64_t{codes[i]} << 3 * i;
    for (std::size_t i = 0; i < 6; ++i) block[2 + i] = static_cast<std::uint8_t>(bits >> 8 * i);
    return block;
}

/// Modifiers of EAC codes; the block's multiplier scales them.
inline constexpr std::int8_t kEacModifiers[16][8] = {
    {-3, -6, -9, -15, 2, 5, 8, 14}, {-3, -7, -10, -13, 2, 6, 9, 12}, {-2, -5, -8, -13, 1, 4, 7, 12},
    {-2, -4, -6, -13, 1, 3, 5, 12}, {-3, -6, -8, -12, 2, 5, 7, 11},  {-3, -7, -9, -11, 2, 6, 8, 10},
    {-4, -7, -8, -11, 3, 6, 7, 10}, {-3, -5, -8, -11, 2, 4, 7, 10},  {-2, -6, -8, -10, 1, 5, 7, 9},
    {-2, -5, -8, -10, 1, 4, 7, 9},  {-2, -4, -8, -10, 1, 3, 7, 9},   {-2, -5, -7, -10, 1, 4, 6, 9},
    {-3, -4, -7, -10, 2, 3, 6, 9},  {-1, -2, -3, -10, 0, 1, 2, 9},   {-4, -6, -8, -9, 3, 5, 7, 8},
    {-3, -5, -7, -9, 2, 4, 6, 8}};

/// Packs one EAC channel: `base` as stored, `multiplier` and `table` up to 15. `codes` are row by row; the block stores
/// them column by column, starting with the highest bits.
inline std::array<std::uint8_t, 8> packEacBlock(int base, int multiplier, int table,
                                                const std::array<std::uint8_t, 16>& codes) {
    std::array<std::uint8_t, 8> block{static_cast<std::uint8_t>(base),
                                      static_cast<std::uint8_t>(multiplier << 4 | table)};
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) bits |= std::uint64_t{codes[i % 4 * 4 + i / 4]} << (45 - 3 * i);
    for (std::size_t i = 0; i < 6; ++i) block[2 + i] = static_cast<std::uint8_t>(bits >> (40 - 8 * i));
    return block;
}

}  // namespace tspace
