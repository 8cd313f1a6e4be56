// SPDX-License-Identifier: MIT
// Four floats at any address, whatever the number of lanes. Included as lanes_arithmetic.h, before lanes_of_four.h or what
// stands for it: inFours, joinQuads and quad.

using Quad = float __attribute__((vector_size(16)));
using TwoDoubles = double __attribute__((vector_size(16)));
// Clang overlooks `aligned` behind the equals sign.
using QuadInMemory __attribute__((aligned(4), may_alias)) = Quad;
inline Quad loadQuad(const void* p) { return *static_cast<const QuadInMemory*>(p); }
inline void storeQuad(void* to, Quad quad) { *static_cast<QuadInMemory*>(to) = quad; }

/// Two floats as one double.
inline double loadTwo(const void* p) {
    double d;
    std::memcpy(&d, p, sizeof d);
    return d;
}
inline void storeTwo(void* to, double two) { std::memcpy(to, &two, sizeof two); }
inline Quad twoPairs(const void* a, const void* b) {
    return reinterpret_cast<Quad>(TwoDoubles{loadTwo(a), loadTwo(b)});
}
/// Three floats. `exact` reads no more; otherwise the four bytes after them are read too.
inline Quad loadVector(const std::byte* p, bool exact) {
    if (!exact) return loadQuad(p);
    float z;
    std::memcpy(&z, p + 8, sizeof z);
    return __builtin_shufflevector(reinterpret_cast<Quad>(TwoDoubles{loadTwo(p), 0}), Quad{z, 0, 0, 0}, 0, 1, 4, 5);
}

/// Numbers of the quads in a vector.
template <std::size_t... kNumbers>
struct Quads {};
