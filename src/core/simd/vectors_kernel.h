// SPDX-License-Identifier: MIT
// Vectors of three on lanes, and how they are read. Included after lanes_*.h, with TSPACE_LANES set to its
// namespace.
#pragma once

namespace tspace::simd::TSPACE_LANES {

inline Floats zero() { return broadcast(0.0f); }
inline Floats minus(Floats a) { return broadcast(-0.0f) - a; }

struct Vectors {
    Floats x, y, z;
};
inline Vectors operator-(Vectors a, Vectors b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vectors operator+(Vectors a, Vectors b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vectors operator*(Floats k, Vectors v) { return {k * v.x, k * v.y, k * v.z}; }
inline Floats dot(Vectors a, Vectors b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vectors cross(Vectors a, Vectors b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Whether nothing may be read behind an array. With TSPACE_SMALL arrays are copies, with room behind them.
#ifdef TSPACE_SMALL
inline constexpr bool kEndsMatter = false;
#else
inline constexpr bool kEndsMatter = true;
#endif

/// Rarely called, and long: kept out of the loops.
[[gnu::noinline]] inline Vectors gatherExactly(const std::byte* base, std::size_t stride, const std::uint32_t* index) {
    Vectors v;
    gather3(base, stride, index, true, v.x, v.y, v.z);
    return v;
}

/// `exact`: no byte after a vector may be read.
[[gnu::always_inline]] inline Vectors gatherVectors(const std::byte* base, std::size_t stride,
                                                    const std::uint32_t* index, bool exact) {
    if (kEndsMatter && exact) [[unlikely]]
        return gatherExactly(base, stride, index);
    Vectors v;
    if (stride == 12) {  // addresses need no multiplication
        gather3(base, 12, index, false, v.x, v.y, v.z);
    } else {
        gather3(base, stride, index, false, v.x, v.y, v.z);
    }
    return v;
}

/// Whether any vertex is the last one, which has nothing after it to be read along.
inline bool namesLast(const std::uint32_t* vertices, std::uint32_t last) {
    if (!kEndsMatter) return false;
    std::uint32_t named = 0;
    for (std::size_t i = 0; i < 3 * kWidth; ++i) named |= vertices[i] == last ? 1u : 0u;
    return named != 0;
}

}  // namespace tspace::simd::TSPACE_LANES
