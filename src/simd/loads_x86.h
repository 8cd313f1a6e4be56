// SPDX-License-Identifier: MIT
// Reading and writing two or three floats at any address. Included inside the namespace of each lanes_*.h for x86, so
// that each CPU has functions of its own: see the rules in lanes_scalar.h. Without a guard, for the same reason.

/// Two floats as one double.
inline double loadTwo(const std::byte* p) {
    double d;
    std::memcpy(&d, p, sizeof d);
    return d;
}
/// Three floats. `exact` reads no more; otherwise the four bytes after them are read too.
inline __m128 loadVector(const std::byte* p, bool exact) {
    const float* f = reinterpret_cast<const float*>(p);
    if (!exact) return _mm_loadu_ps(f);
    return _mm_movelh_ps(_mm_castpd_ps(_mm_set_sd(loadTwo(p))), _mm_load_ss(f + 2));
}
/// Two floats of each.
inline __m128 loadPair(const std::byte* a, const std::byte* b) {
    return _mm_castpd_ps(_mm_set_pd(loadTwo(b), loadTwo(a)));
}
/// The lower two floats to one row, the others to the next.
template <std::size_t kStep>
inline void storeTwoPairs(float* rows, __m128 pairs) {
    _mm_storel_pi(reinterpret_cast<__m64*>(rows), pairs);
    _mm_storeh_pi(reinterpret_cast<__m64*>(rows + kStep), pairs);
}
