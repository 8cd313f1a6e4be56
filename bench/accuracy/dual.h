// SPDX-License-Identifier: MIT
// Dual numbers with derivatives along s and t: exact derivatives of any formula (automatic differentiation, forward
// mode).
#pragma once

#include <cmath>

namespace tspace::accuracy {

struct Dual {
    double value = 0, ds = 0, dt = 0;

    constexpr Dual() = default;
    constexpr Dual(double v) : value(v) {}  // implicit, so that formulas can contain constants
    constexpr Dual(double v, double along_s, double along_t) : value(v), ds(along_s), dt(along_t) {}
};

inline Dual operator-(const Dual& a) { return {-a.value, -a.ds, -a.dt}; }
inline Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.ds + b.ds, a.dt + b.dt}; }
inline Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.ds - b.ds, a.dt - b.dt}; }
inline Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.ds * b.value + a.value * b.ds, a.dt * b.value + a.value * b.dt};
}

/// Returns a function's dual number, given its `value` and `slope` at a.
inline Dual chain(const Dual& a, double value, double slope) { return {value, slope * a.ds, slope * a.dt}; }

inline Dual operator/(const Dual& a, const Dual& b) { return a * chain(b, 1 / b.value, -1 / (b.value * b.value)); }
inline Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return chain(a, root, 0.5 / root);
}
inline Dual sin(const Dual& a) { return chain(a, std::sin(a.value), std::cos(a.value)); }
inline Dual cos(const Dual& a) { return chain(a, std::cos(a.value), -std::sin(a.value)); }
inline Dual exp(const Dual& a) { return chain(a, std::exp(a.value), std::exp(a.value)); }
inline Dual cosh(const Dual& a) { return chain(a, std::cosh(a.value), std::sinh(a.value)); }
inline Dual sinh(const Dual& a) { return chain(a, std::sinh(a.value), std::cosh(a.value)); }

}  // namespace tspace::accuracy
