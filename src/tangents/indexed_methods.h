// SPDX-License-Identifier: MIT
// One function for each method that needs no groups, and what they share.
#pragma once

#include "core/vec_math.h"
#include "tangents/indexed_plan.h"

namespace tspace {

/// All outputs of one corner.
struct CornerFrame {
    Vec4 tangent;
    Vec3 bitangent;
    float magnitude_s = 0;
    float magnitude_t = 0;
    bool is_default = false;  ///< no face gave a tangent
};

/// dP/du and dP/dv at a corner, before they are made into a frame. Zero: no face gave any.
struct Derivatives {
    DVec3 s, t;
};

/// Gram-Schmidt against N as given: T' = unit(T - N (N.T)), sign = dot(cross(N, T'), B) < 0 ? -1 : 1;
/// bitangent = unit(B), or that of sign * cross(N, T') where B is zero. Where T' has no length or is not
/// finite: (1, 0, 0), sign 1, bitangent (0, 1, 0), magnitudes 1. Sign and bitangent are multiplied with
/// `sign_factor`. Never gives a NaN.
CornerFrame makeCornerFrame(const Derivatives& derivatives, const Vec3& normal, float sign_factor);

/// Writes the outputs that are asked for.
void writeCorner(const TangentOutput& out, std::size_t corner, const CornerFrame& frame);

/// Each writes the corners that are used and returns how many of them hold the default.
std::uint64_t evaluateLengyel(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                              const Allocator* allocator, Parallel& parallel);
std::uint64_t evaluateFlat(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                           Parallel& parallel);
std::uint64_t evaluateBasis(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                            Parallel& parallel);

}  // namespace tspace
