// SPDX-License-Identifier: MIT
// Vector arithmetic of the core: floats, doubles, directions, the frame of a triangle's UVs, angles, vectors of four
// floats. Every operation rounds once, in the order written (the build forbids contraction), because the bit-exact
// methods depend on it: dot is (x*x + y*y) + z*z.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__) && defined(__ARM_NEON)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#include "tspace/span.h"

namespace tspace {

inline Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(float k, const Vec3& v) { return {k * v.x, k * v.y, k * v.z}; }
inline float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const Vec3& v) { return std::sqrt(dot(v, v)); }
inline bool isFinite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Vector in double precision, for results that must be correct for any float input, without overflow or underflow.
struct DVec3 {
    double x = 0, y = 0, z = 0;
};
inline DVec3 toDouble(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Vec3 toFloat(const DVec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline DVec3 operator+(const DVec3& a, const DVec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline DVec3 operator-(const DVec3& a, const DVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline DVec3 operator*(double k, const DVec3& v) { return {k * v.x, k * v.y, k * v.z}; }
inline double dot(const DVec3& a, const DVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline DVec3 cross(const DVec3& a, const DVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const DVec3& v) { return std::sqrt(dot(v, v)); }

// Functions for directions: tests, normalization that works for every finite vector, and a basis around a unit vector.

inline bool isZero(const Vec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }
inline bool isDirection(const Vec3& v) { return isFinite(v) && !isZero(v); }

/// Normalizes v; returns false, and leaves v unchanged, if it is zero or not finite. First scales the largest component
/// to 1: squares of products of small floats would underflow even in double precision.
inline bool normalize(DVec3& v) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
    const double largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    if (largest == 0) return false;
    const DVec3 scaled{v.x / largest, v.y / largest, v.z / largest};
    v = (1 / length(scaled)) * scaled;
    return true;
}

/// Normalizes like normalize(), except for rounding, with one division instead of four if the squared length is a
/// normal number.
inline bool normalizeOrdinary(DVec3& v) {
    const double squared = dot(v, v);
    if (!(squared > 1e-280 && squared < 1e280)) return normalize(v);
    v = (1 / std::sqrt(squared)) * v;
    return true;
}

/// Lengths of normals and tangents below this are treated as zero.
inline constexpr double kLeastLength = 1e-6;
/// Maximum deviation of a unit vector's length from 1: explained by 8-bit rounding, and allowed by the glTF validator.
inline constexpr double kMostFromUnit = 0.00674;

/// Returns the factor that normalizes a normal: 1 for lengths within kMostFromUnit of 1, and for normals without a
/// direction.
inline double unitScale(const Vec3& normal) {
    const double squared = dot(toDouble(normal), toDouble(normal));
    if (std::fabs(squared - 1) <= 0.0134) return 1;  // the length is then within kMostFromUnit
    const double size = std::sqrt(squared);
    if (!(size >= kLeastLength && std::isfinite(size)) || std::fabs(size - 1) <= kMostFromUnit) return 1;
    return 1 / size;
}
/// Returns the normal times its unitScale, with unchanged bits if that is 1.
inline Vec3 withUnitLength(const Vec3& normal) {
    const double scale = unitScale(normal);
    return scale == 1 ? normal : toFloat(scale * toDouble(normal));
}

/// Two axes that form a right-handed orthonormal basis (x, y, n) with a unit vector. Exact if n is parallel to an axis.
struct PlaneAxes {
    DVec3 x, y;
};

inline PlaneAxes planeAxes(const DVec3& n) {
    const double s = n.z < 0 ? -1.0 : 1.0;  // treats -0 as +0, so that equal normals have equal bases
    const double a = -1 / (s + n.z);
    const double b = n.x * n.y * a;
    return {{1 + s * n.x * n.x * a, s * b, -s * n.x}, {b, s + n.y * n.y * a, -n.y}};
}

// dP/du and dP/dv of a triangle before the division by its UV determinant.
// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001.

/// `tangent / determinant` is dP/du, `bitangent / determinant` is dP/dv. The sum over a fan of triangles does not
/// depend on the triangulation of a polygon: by Green's theorem it is the integral of P dv (and of -P du) along the
/// border.
struct UvFrame {
    DVec3 tangent;           ///< t2 E1 - t1 E2
    DVec3 bitangent;         ///< s1 E2 - s2 E1
    double determinant = 0;  ///< s1 t2 - s2 t1
};

/// Computes the frame from two edges and their UV differences: (s1, t1) belongs to e1, (s2, t2) to e2.
inline UvFrame uvFrame(const DVec3& e1, const DVec3& e2, double s1, double t1, double s2, double t2) {
    return {t2 * e1 - t1 * e2, s1 * e2 - s2 * e1, s1 * t2 - s2 * t1};
}

/// Computes the frame from the edges P1-P0 and P2-P0. Differences of floats in double precision are exact or nearly so,
/// and their products do not overflow, so collinear UVs of usual size give exactly zero.
inline UvFrame uvFrame(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec2& uv0, const Vec2& uv1,
                       const Vec2& uv2) {
    return uvFrame(toDouble(p1) - toDouble(p0), toDouble(p2) - toDouble(p0), double{uv1.x} - double{uv0.x},
                   double{uv1.y} - double{uv0.y}, double{uv2.x} - double{uv0.x}, double{uv2.y} - double{uv0.y});
}

/// Returns whether a UV determinant is nonzero and finite, so that dividing by it is allowed.
inline bool hasUvArea(double determinant) { return determinant != 0 && std::isfinite(determinant); }

// Angles in double precision without libm, whose last bits differ between platforms: only + - * / and sqrt are used.

inline constexpr double kPi = 3.14159265358979323846;

/// Returns atan2(y, x) for y >= 0, in [0, pi]; 0 for (0, 0). x and y must be finite and below 1e300. Absolute error
/// below 1e-15 (tested against libm).
inline double polarAngle(double x, double y) {
    const double width = x < 0 ? -x : x;
    const double small = width < y ? width : y;
    const double large = width < y ? y : width;
    if (large == 0) return 0;

    // atan(s) = atan(c) + atan(t) with t = (s - c) / (1 + s c). If c is the multiple of 1/4 nearest to s, |t| <= 1/8.
    constexpr double kAtanOfQuarters[5] = {0, 0.24497866312686414, 0.46364760900080615, 0.64350110879328437,
                                           0.78539816339744828};
    const int quarter = static_cast<int>(small / large * 4 + 0.5);
    const double c = 0.25 * quarter;
    const double t = (small - c * large) / (large + c * small);
    // Nine terms of the series of atan: the first omitted term is below (1/8)^19 / 19 = 4e-19.
    const double q = t * t;
    double sum = 1.0 / 17;
    for (int odd = 15; odd >= 1; odd -= 2) sum = 1.0 / odd - q * sum;
    double angle = kAtanOfQuarters[quarter] + t * sum;

    if (y > width) angle = 0.5 * kPi - angle;
    return x < 0 ? kPi - angle : angle;
}

struct SineCosine {
    double sine = 0, cosine = 1;
};

/// Returns sine and cosine of an angle in radians; absolute error below 1e-15 for |angle| <= 100, increasing with the
/// angle beyond (tested against libm). (0, 1) if the angle is not finite.
inline SineCosine sineCosine(double angle) {
    if (!std::isfinite(angle)) return {};
    // pi / 2 as two summands: the first has few bits, so that its small multiples are exact.
    constexpr double kHalfPiHigh = 1.57079632673412561417e+00;
    constexpr double kHalfPiLow = 6.07710050650619224932e-11;
    const double rest = std::fmod(angle, 2 * kPi * (1 << 20));  // exact; usual angles are unchanged
    const double quarters = std::floor(rest / (0.5 * kPi) + 0.5);
    const double x = (rest - quarters * kHalfPiHigh) - quarters * kHalfPiLow;
    // |x| <= pi / 4: the first omitted terms are below 0.79^19 / 19! = 1e-19 and 0.79^18 / 18! = 2e-18.
    const double q = x * x;
    double sine = 1, cosine = 1;
    for (int n = 17; n >= 3; n -= 2) sine = 1 - q / (n * (n - 1)) * sine;
    for (int n = 16; n >= 2; n -= 2) cosine = 1 - q / (n * (n - 1)) * cosine;
    sine *= x;
    const unsigned quarter = static_cast<unsigned>(static_cast<int>(std::fmod(quarters, 4))) & 3;
    const SineCosine half = quarter % 2 == 0 ? SineCosine{sine, cosine} : SineCosine{cosine, -sine};
    return quarter < 2 ? half : SineCosine{-half.sine, -half.cosine};
}

/// Returns the angle between two vectors, in [0, pi]; accurate also near 0 and pi, where acos of the dot product is
/// not. 0 if either vector is zero.
inline double angleBetween(const DVec3& a, const DVec3& b) { return polarAngle(dot(a, b), length(cross(a, b))); }

// Vectors of four floats, with the vector extensions of GCC and Clang: SSE2 on x86-64, NEON on 64-bit ARM, other units
// or scalar code elsewhere. Every lane rounds like the scalar operation, so the bits are equal everywhere.

using Float4 = float __attribute__((vector_size(16)));
/// Result of a comparison: in each lane, all bits are set or none.
using Mask4 = std::int32_t __attribute__((vector_size(16)));
using Double2 = double __attribute__((vector_size(16)));  ///< carries two pairs of floats

// Unaligned Float4 (its address may be any multiple of 4 bytes) that may alias any type. Clang ignores `aligned` after
// the equals sign.
using Float4InMemory __attribute__((aligned(4), may_alias)) = Float4;

inline Float4 splat(float f) { return Float4{f, f, f, f}; }
inline Float4 abs4(Float4 v) { return std::bit_cast<Float4>(std::bit_cast<Mask4>(v) & 0x7fffffff); }
inline Float4 or4(Float4 a, Float4 b) {
    return std::bit_cast<Float4>(std::bit_cast<Mask4>(a) | std::bit_cast<Mask4>(b));
}

/// Returns the lanes as bits: bit i is the highest bit of lane i.
inline unsigned laneBits(Mask4 mask) {
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_ps(std::bit_cast<__m128>(mask)));
#elif defined(__aarch64__) && defined(__ARM_NEON)
    constexpr Mask4 kBits = {1, 2, 4, 8};
    return vaddvq_u32(std::bit_cast<uint32x4_t>((mask >> 31) & kBits));
#elif defined(__wasm_simd128__)
    return static_cast<unsigned>(wasm_i32x4_bitmask(std::bit_cast<v128_t>(mask)));
#else
    unsigned bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits |= mask[i] < 0 ? 1u << i : 0;
    return bits;
#endif
}

/// Returns, per lane, a where the mask is set, otherwise b.
inline Float4 select4(Mask4 mask, Float4 a, Float4 b) {
    return std::bit_cast<Float4>((mask & std::bit_cast<Mask4>(a)) | (~mask & std::bit_cast<Mask4>(b)));
}
inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }

inline Float4 sqrt4(Float4 v) {
#ifdef __SSE2__
    return std::bit_cast<Float4>(_mm_sqrt_ps(std::bit_cast<__m128>(v)));
#else
    return Float4{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

inline Float4 loadFloat4(const float* p) { return *reinterpret_cast<const Float4InMemory*>(p); }
inline void storeFloat4(float* p, Float4 v) { *reinterpret_cast<Float4InMemory*>(p) = v; }

/// Returns the bits of two floats as a double.
inline double pairBits(const float* p) {
    double bits;
    std::memcpy(&bits, p, sizeof bits);
    return bits;
}
/// Returns two floats in the lower half, with zeros in the upper half.
inline Float4 loadPair(const float* p) { return std::bit_cast<Float4>(Double2{pairBits(p), 0.0}); }
inline void storePair(float* p, Float4 v) {
    const double bits = std::bit_cast<Double2>(v)[0];
    std::memcpy(p, &bits, sizeof bits);
}
inline Float4 joinPairs(const float* low, const float* high) {
    return std::bit_cast<Float4>(Double2{pairBits(low), pairBits(high)});
}

/// Stores the first three lanes.
inline void storeVec3(Vec3& to, Float4 v) {
    storePair(&to.x, v);
    to.z = v[2];
}

/// Four vectors, with one array per component.
struct Vec3x4 {
    Float4 x, y, z;
};

inline Vec3x4 operator+(const Vec3x4& a, const Vec3x4& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3x4 operator*(Float4 k, const Vec3x4& v) { return {k * v.x, k * v.y, k * v.z}; }
inline Float4 dot(const Vec3x4& a, const Vec3x4& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3x4 cross(const Vec3x4& a, const Vec3x4& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Transposes a matrix given by rows.
inline void transpose4(Float4& a, Float4& b, Float4& c, Float4& d) {
    const Float4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Float4 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Float4 cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Float4 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// Loads four vectors, each with two loads that stay inside its 12 bytes: x y and y z.
inline Vec3x4 gatherVec3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    Float4 x = joinPairs(&a.x, &a.y), y = joinPairs(&b.x, &b.y), y_again = joinPairs(&c.x, &c.y),
           z = joinPairs(&d.x, &d.y);
    transpose4(x, y, y_again, z);
    return {x, y, z};
}

// Additions of rows, which all sums over corners use.

/// Performs to[0..3] += row[0..3]; both pointers must be aligned to 16 bytes.
inline void addRow(float* to, const float* row) {
    using Row __attribute__((may_alias)) = Float4;
    *reinterpret_cast<Row*>(to) += *reinterpret_cast<const Row*>(row);
}

/// Performs to[0..2] += row[0..2], where `row` has four numbers.
inline void addVector(float* to, const float* row) {
    const Float4 sum = __builtin_shufflevector(loadPair(to), Float4{to[2], 0, 0, 0}, 0, 1, 4, 5) + loadFloat4(row);
    storePair(to, sum);
    to[2] = sum[2];
}

}  // namespace tspace
