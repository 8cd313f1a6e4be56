// SPDX-License-Identifier: MIT
// Vectors of eight numbers, which compilers translate to SIMD instructions of the target CPU. Each operation conforms
// to IEEE 754, so the result is identical on all CPUs.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tspace {

/// Eight floats as two vectors of four: every CPU with SIMD has 16-byte vectors.
struct Eight {
    using Four = float __attribute__((vector_size(16)));
    using FourInts = std::int32_t __attribute__((vector_size(16)));
    Four low = {}, high = {};

    Eight() = default;
    Eight(Four a, Four b) : low(a), high(b) {}
    // NOLINT(google-explicit-constructor): implicit, like the conversion from float
    Eight(float all) : low{all, all, all, all}, high(low) {}

    [[nodiscard]] float operator[](std::size_t lane) const { return lane < 4 ? low[lane] : high[lane - 4]; }
    void set(std::size_t lane, float value) {
        Four& half = lane < 4 ? low : high;
        half[lane % 4] = value;
    }
};

inline Eight operator+(const Eight& a, const Eight& b) { return {a.low + b.low, a.high + b.high}; }
inline Eight operator-(const Eight& a, const Eight& b) { return {a.low - b.low, a.high - b.high}; }
inline Eight operator*(const Eight& a, const Eight& b) { return {a.low * b.low, a.high * b.high}; }
inline Eight operator/(const Eight& a, const Eight& b) { return {a.low / b.low, a.high / b.high}; }

inline Eight smaller(const Eight& a, const Eight& b) {
    return {a.low < b.low ? a.low : b.low, a.high < b.high ? a.high : b.high};
}
inline Eight larger(const Eight& a, const Eight& b) {
    return {a.low > b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}
/// Returns a < b ? x : y for each lane.
inline Eight whereLess(const Eight& a, const Eight& b, const Eight& x, const Eight& y) {
    return {a.low < b.low ? x.low : y.low, a.high < b.high ? x.high : y.high};
}
/// Truncates toward zero; |a| must be below 2^31.
inline Eight whole(const Eight& a) {
    const auto of = [](Eight::Four four) {
        return __builtin_convertvector(__builtin_convertvector(four, Eight::FourInts), Eight::Four);
    };
    return {of(a.low), of(a.high)};
}
inline Eight between(const Eight& a, const Eight& least, const Eight& most) { return smaller(larger(a, least), most); }
/// Rounds to the nearest integer; a must not be negative.
inline Eight nearestWhole(const Eight& a) { return whole(a + 0.5F); }

}  // namespace tspace
