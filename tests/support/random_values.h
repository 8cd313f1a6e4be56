// SPDX-License-Identifier: MIT
// Generators for property tests: valid vectors and arbitrary values.
#pragma once

#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tspace/span.h"

namespace tspace::test {

/// Returns an integer in [low, high). It is uniformly distributed in all test cases, whereas RapidCheck's own generator
/// starts near `low`.
inline int randomInt(int low, int high) { return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high)); }

/// Returns a float in [low, high] with 16 bits of resolution.
inline float randomFloat(float low, float high) {
    const int step = randomInt(0, 65537);
    return low + (high - low) * (static_cast<float>(step) / 65536.0f);
}

inline Vec2 randomVec2(float low = -1, float high = 1) { return {randomFloat(low, high), randomFloat(low, high)}; }

inline Vec3 randomVec3(float low = -1, float high = 1) {
    const float x = randomFloat(low, high), y = randomFloat(low, high);
    return {x, y, randomFloat(low, high)};
}

inline double dot(const Vec3& a, const Vec3& b) { return double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z; }
inline double norm(const Vec3& v) { return std::sqrt(test::dot(v, v)); }

inline Vec3 randomUnit() {
    const Vec3 v = randomVec3();
    const double l = norm(v);
    RC_PRE(l > 0.1);
    return {static_cast<float>(v.x / l), static_cast<float>(v.y / l), static_cast<float>(v.z / l)};
}

/// Returns a float of any kind: NaN, infinity, zero, a subnormal, a huge value, or an ordinary one.
inline float randomGarbage() {
    switch (randomInt(0, 8)) {
        case 0: return 0.0f;
        case 1: return -0.0f;
        case 2: return std::numeric_limits<float>::quiet_NaN();
        case 3:
            return *rc::gen::arbitrary<bool>() ? std::numeric_limits<float>::infinity()
                                               : -std::numeric_limits<float>::infinity();
        case 4: return std::bit_cast<float>(*rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint32_t>()));
        case 5: return std::numeric_limits<float>::max();
        case 6: return std::numeric_limits<float>::denorm_min();
        default: return randomFloat(-2, 2);
    }
}

inline Vec3 randomGarbageVec3() {
    const float x = randomGarbage(), y = randomGarbage();
    return {x, y, randomGarbage()};
}

inline bool isUnit(const Vec3& v, double tolerance = 1e-6) { return std::fabs(norm(v) - 1) <= tolerance; }

}  // namespace tspace::test
