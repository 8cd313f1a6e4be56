// SPDX-License-Identifier: MIT
// Vector arithmetic on blocks of corners, one array per component, in loops that the compiler turns into
// SIMD. Each lane does what vector_rules.h does, so the bits are those of the scalar code.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>

#include "core/vec_math.h"

namespace tspace::mikk {

inline constexpr std::size_t kBlock = 128;     // corners; a block's arrays take 10 KB and stay in the first cache
inline constexpr std::size_t kLaneGroup = 16;  // loops run over whole groups, so that no remainder loop is needed

struct Lanes3 {
    alignas(64) float x[kBlock] = {};
    alignas(64) float y[kBlock] = {};
    alignas(64) float z[kBlock] = {};

    void set(std::size_t i, const Vec3& v) {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
    [[nodiscard]] Vec3 get(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

inline std::size_t wholeGroups(std::size_t count) { return (count + kLaneGroup - 1) / kLaneGroup * kLaneGroup; }

/// v[i] = flatten(n[i], v[i]) for the first `count` lanes (and the rest of the last group).
inline void flattenLanes(const Lanes3& n, Lanes3& v, std::size_t count) {
    const std::size_t end = wholeGroups(count);
    for (std::size_t i = 0; i < end; ++i) {
        const float along = n.x[i] * v.x[i] + n.y[i] * v.y[i] + n.z[i] * v.z[i];
        const float x = v.x[i] - along * n.x[i], y = v.y[i] - along * n.y[i], z = v.z[i] - along * n.z[i];
        const float scale = 1.0f / std::sqrt(x * x + y * y + z * z);
        // All three are compared, without a branch.
        const int sound = int{std::fabs(x) > FLT_MIN} | int{std::fabs(y) > FLT_MIN} | int{std::fabs(z) > FLT_MIN};
        v.x[i] = sound != 0 ? scale * x : x;
        v.y[i] = sound != 0 ? scale * y : y;
        v.z[i] = sound != 0 ? scale * z : z;
    }
}

}  // namespace tspace::mikk
