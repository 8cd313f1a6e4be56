// SPDX-License-Identifier: MIT
// Eight numbers side by side, which compilers turn into what the CPU has. Each operation is that of IEEE 754 by itself, so all CPUs
// give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tspace {

/// A number of four lanes twice: vectors of 16 bytes are what every CPU with lanes has.
struct Eight {
    using Four = float __attribute__((vector_size(16)));
    using FourInts = std::int32_t __attribute__((vector_size(16)));
    Four low = {}, high = {};

    Eight() = default;
    Eight(Four a, Four b) : low(a), high(b) {}
    Eight(float all) : low{all, all, all, all}, high(low) {}  // NOLINT(google-explicit-constructor): as float is

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
/// a < b ? x : y
inline Eight whereLess(const Eight& a, const Eight& b, const Eight& x, const Eight& y) {
    return {a.low < b.low ? x.low : y.low, a.high < b.high ? x.high : y.high};
}
/// Towards zero; |a| is below 2^31.
inline Eight whole(const Eight& a) {
    const auto of = [](Eight::Four four) {
        return __builtin_convertvector(__builtin_convertvector(four, Eight::FourInts), Eight::Four);
    };
    return {of(a.low), of(a.high)};
}
inline Eight between(const Eight& a, const Eight& least, const Eight& most) { return smaller(larger(a, least), most); }
/// To the nearest whole number; none is below 0.
inline Eight nearestWhole(const Eight& a) { return whole(a + 0.5F); }

}  // namespace tspace
