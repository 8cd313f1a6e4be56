// SPDX-License-Identifier: MIT
// Random numbers that are equal on every machine, unlike those of the standard library's distributions.
// Based on: Steele, Lea & Flood, "Fast Splittable Pseudorandom Number Generators", 2014 (SplitMix64).
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "core/base/vec_math.h"

namespace tspace::accuracy {

class Random {
  public:
    /// Different seeds give unrelated sequences.
    explicit Random(std::initializer_list<std::uint64_t> seeds) {
        for (const std::uint64_t seed : seeds) state_ = mix(state_ ^ mix(seed + kStep));
    }
    std::uint64_t bits() { return mix(state_ += kStep); }
    /// Returns a number in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// Returns a number in [-size, size).
    double around(double size) { return size * (2 * unit() - 1); }
    bool coin() { return (bits() >> 63) != 0; }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }

  private:
    static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;
    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    std::uint64_t state_ = 0;
};

}  // namespace tspace::accuracy
