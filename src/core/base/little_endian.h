// SPDX-License-Identifier: MIT
// Numbers in bytes with the low one first, as glTF has them, on machines of either order.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

namespace tspace {

/// Turns each number of `number_bytes` between this machine's order and that of files.
inline void turnLittleEndian(std::span<std::uint8_t> bytes, std::size_t number_bytes) {
    if constexpr (std::endian::native == std::endian::little) return;
    for (std::size_t at = 0; at + number_bytes <= bytes.size(); at += number_bytes)
        std::reverse(bytes.data() + at, bytes.data() + at + number_bytes);
}

template <class Number>
Number loadLittleEndian(const std::uint8_t* from) {
    std::uint8_t bytes[sizeof(Number)];
    std::memcpy(bytes, from, sizeof bytes);
    turnLittleEndian(bytes, sizeof bytes);
    return std::bit_cast<Number>(bytes);
}

template <class Number>
void storeLittleEndian(Number number, std::uint8_t* to) {
    std::memcpy(to, &number, sizeof number);
    turnLittleEndian({to, sizeof number}, sizeof number);
}

}  // namespace tspace
