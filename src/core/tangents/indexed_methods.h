// SPDX-License-Identifier: MIT
// One function for each method that needs no groups, and what they share.
#pragma once

#include "core/base/vec_math.h"
#include "core/tangents/indexed_plan.h"

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

/// The length of sum / count as a float, which a mean of floats can exceed only by its rounding.
float meanLength(const DVec3& sum, double count);

/// Write the outputs that are wanted; writeExtras all but the tangent.
void writeFrame(const TangentOutput& out, std::size_t entry, const CornerFrame& frame);
void writeExtras(const TangentOutput& out, std::size_t entry, const CornerFrame& frame);

/// Each writes the used outputs and sets the counts of `report` that it knows and the plan does not.
void evaluateLengyel(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, const Execution& execution,
                     Parallel& parallel, TangentReport& report);
void evaluateFlat(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, Parallel& parallel,
                  TangentReport& report);
void evaluateBasis(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, const Allocator* allocator,
                   Parallel& parallel, TangentReport& report);

}  // namespace tspace
