// SPDX-License-Identifier: MIT
// Estimators of the methods `fast` and `best`. Both process the triangles (`best` once more for each step), add rows of
// numbers to each group, and then convert a group's rows to its tangent:
//
// fast   two_weights_kernel.h: two weighted means of the same vectors, blended by the angle between them
// best   quadratic_recovery_kernel.h: a quadratic map from UVs to the tangent plane, fitted to the edges; then
//        refinement steps toward frames that reproduce the edges by interpolation
//
// Each is implemented once, and compiled for several CPUs with equal bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"

namespace tspace::estimators {

/// Vertex data of a call, with scale factors.
struct VertexSource : VertexArrays {
    /// Factors (powers of four) by which all positions and UVs are multiplied, so that their products stay in range.
    float position_scale = 1, uv_scale = 1;
};

inline constexpr std::size_t kBlockTriangles = 32;  ///< triangles per block, whose rows fit into the L1 cache
/// Numbers of lanes are rounded up to multiples of this, so that kernels process no partial groups of lanes.
inline constexpr std::size_t kLaneGroup = 16;
inline constexpr std::size_t kStepRows = 2;  ///< number of rows of four floats in a step
/// Number of floats per group that a step reads: dP/du and the share of the robust mean, then dP/dv and 0. A group with
/// zeros is ignored.
inline constexpr std::size_t kStepFloats = 8;

/// Implementation of a method for one CPU.
struct Estimator {
    std::size_t row_count = 0;  ///< number of rows of four floats that a corner adds to its group
    /// Writes the rows of corner k of triangle t to rows + 4 * row_count * (3 * t + k). `vertices`: three per triangle,
    /// valid up to the end of the last lane group. count <= kBlockTriangles. Triangles with values that are not finite
    /// write zeros.
    void (*add)(const VertexSource& source, const std::uint32_t* vertices, std::size_t count, float* rows) = nullptr;
    /// Converts the sums of `count` groups, up to the end of the last lane group, to results in place. `normals`: four
    /// floats per group. The first row becomes the unit tangent, the second the unit bitangent, and their fourth
    /// numbers become the lengths of dP/du and dP/dv, in scaled positions and UVs: {T.x, T.y, T.z, |dP/du|}, {B.x, B.y,
    /// B.z, |dP/dv|}. Directions without contributing triangles are zero; all results are finite. With two rows, only
    /// tangents are computed.
    void (*finish)(float* sums, const float* normals, std::size_t count) = nullptr;
    /// Writes the rows of a refinement step, otherwise like `add`; null if the method has no steps. `groups`: three per
    /// triangle; `from`: kStepFloats floats for each of these groups.
    void (*add_step)(const VertexSource& source, const std::uint32_t* vertices, const std::uint32_t* groups,
                     const float* from, std::size_t count, float* rows) = nullptr;
    /// Finishes a refinement step. `from`: kStepFloats floats per group. If the first row becomes zero, the group is
    /// unchanged.
    void (*finish_step)(float* sums, const float* normals, const float* from, std::size_t count) = nullptr;
};

/// Estimators of the methods `fast` (twoWeights) and `best` (quadraticRecovery). `tangents_only`: the second row of
/// results is not needed.
TSPACE_DECLARE_KERNEL(Estimator twoWeights(bool tangents_only))
TSPACE_DECLARE_KERNEL(Estimator quadraticRecovery())
inline Estimator twoWeightsFor(SimdTarget requested, bool tangents_only) {
    return simd::choose(requested, TSPACE_KERNEL_TABLE_NOT_AVX512(twoWeights))(tangents_only);
}
inline Estimator quadraticRecoveryFor(SimdTarget requested) {
    return simd::choose(requested, TSPACE_KERNEL_TABLE(quadraticRecovery))();
}

}  // namespace tspace::estimators
