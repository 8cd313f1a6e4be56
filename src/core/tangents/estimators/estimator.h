// SPDX-License-Identifier: MIT
// The estimators of the methods `fast` and `best`. Both go over the triangles, `best` once more for each step, add some
// rows of numbers to each group, and then turn a group's rows into its tangent:
//
// fast   two_weights_kernel.h: two weighted means of the same vectors, mixed by the angle between them
// best   quadratic_recovery_kernel.h: a quadratic map from UVs to the tangent plane, fitted to the edges; then steps towards
//        frames that give the edges when they are interpolated
//
// Each is written once, and compiled for several CPUs with the same bits from all.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"

namespace tspace::estimators {

/// The vertex data of one call.
struct VertexSource : VertexArrays {
    /// Powers of four that all positions and UVs are multiplied with, so that their products stay in range.
    float position_scale = 1, uv_scale = 1;
};

inline constexpr std::size_t kBlockTriangles = 32;  ///< its rows stay in the first cache
inline constexpr std::size_t kLaneGroup = 16;       ///< kernels work on whole groups of so many lanes
inline constexpr std::size_t kStepRows = 2;         ///< rows of four floats of a step
/// Floats of a group that a step reads: dP/du and the robust mean's share, dP/dv and 0. Zeros: the group takes no part.
inline constexpr std::size_t kStepFloats = 8;

/// One method on one CPU.
struct Estimator {
    std::size_t row_count = 0;  ///< rows of four floats that a corner adds to its group
    /// Writes the rows of corner k of triangle t to rows + 4 * row_count * (3 * t + k). `vertices`: three per
    /// triangle, and valid ones up to the end of the last lane group. count <= kBlockTriangles. Triangles
    /// with values that are not finite write zeros.
    void (*add)(const VertexSource& source, const std::uint32_t* vertices, std::size_t count, float* rows) = nullptr;
    /// Turns the sums of `count` groups, up to the end of the last lane group, into results in place.
    /// normals: four floats per group. The first row becomes the unit tangent, the second the unit bitangent,
    /// and the last two numbers of these rows the lengths of dP/du and dP/dv, in scaled positions and UVs: {T.x, T.y,
    /// T.z, |dP/du|}, {B.x, B.y, B.z, |dP/dv|}. A direction that no triangle gives is zero, and never is anything not finite. With
    /// two rows, there are tangents only.
    void (*finish)(float* sums, const float* normals, std::size_t count) = nullptr;
    /// Like `add`, for a step; null if the method has none. groups: three per triangle; `from` has kStepFloats for each named
    /// group.
    void (*add_step)(const VertexSource& source, const std::uint32_t* vertices, const std::uint32_t* groups,
                     const float* from, std::size_t count, float* rows) = nullptr;
    /// from: kStepFloats per group. Where the first row becomes zero, the group stays as it is.
    void (*finish_step)(float* sums, const float* normals, const float* from, std::size_t count) = nullptr;
};

/// `tangents_only`: the second row of results is not needed.
TSPACE_DECLARE_KERNEL(Estimator twoWeights(bool tangents_only))
TSPACE_DECLARE_KERNEL(Estimator quadraticRecovery())
inline Estimator twoWeightsFor(SimdTarget wish, bool tangents_only) {
    return simd::choose(wish, TSPACE_KERNEL_TABLE_NOT_AVX512(twoWeights))(tangents_only);
}
inline Estimator quadraticRecoveryFor(SimdTarget wish) {
    return simd::choose(wish, TSPACE_KERNEL_TABLE(quadraticRecovery))();
}

}  // namespace tspace::estimators
