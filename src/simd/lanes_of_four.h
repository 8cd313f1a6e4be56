// SPDX-License-Identifier: MIT
// Four lanes. Included as lanes_arithmetic.h, behind it.

/// Of each quad of x (0 to 3) and the same of y (4 to 7) four floats.
template <int kA, int kB, int kC, int kD>
inline FloatVector inFours(FloatVector x, FloatVector y) {
    return __builtin_shufflevector(x, y, kA, kB, kC, kD);
}
inline constexpr Quads<0> kQuads;
inline FloatVector joinQuads(Quad a) { return a; }
template <std::size_t>
inline Quad quad(FloatVector v) {
    return v;
}
