// SPDX-License-Identifier: MIT
// Hashing for tables that are looked up and never walked, so that their order can decide nothing.
// Based on: Steele, Lea & Flood, "Fast splittable pseudorandom number generators", 2014 (the mixing step).
#pragma once

#include <bit>
#include <cstdint>

#include "tspace/vec.h"

namespace tspace {

/// Spreads every bit of the input over all bits of the result.
inline std::uint64_t mixBits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// The hash of a sequence: start with any number and fold in one value after the other.
inline std::uint64_t foldHash(std::uint64_t hash, std::uint64_t value) {
    return mixBits((hash + 0x9e3779b97f4a7c15u) ^ value);
}

/// Equal for positions that compare equal: -0 and +0 are one number.
inline std::uint64_t hashPosition(const Vec3& p) {
    const auto bits = [](float f) { return std::uint64_t{std::bit_cast<std::uint32_t>(f == 0.0f ? 0.0f : f)}; };
    return foldHash(mixBits(bits(p.x) | bits(p.y) << 32), bits(p.z));
}

}  // namespace tspace
