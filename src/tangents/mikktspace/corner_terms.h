// SPDX-License-Identifier: MIT
// What each corner of a block of triangles adds to the sums of its node: the projected tangent times the
// corner's weight, and the same for the bitangent and both lengths. Written once (corner_terms_kernel.h),
// compiled for several CPUs, same bits from all of them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/dispatch.h"
#include "tangents/vertex_arrays.h"

namespace tspace::mikk {

enum class Weighting : std::uint32_t {
    projected_angle,  ///< the angle between the corner's two edges after projection along N (mikktspace)
    one,
    angle,  ///< the interior angle
    area,   ///< the triangle's area
    none,   ///< nothing is summed: only marks and counts are written
};

/// The vertex data of one call.
struct CornerSource : VertexArrays {
    Weighting weighting = Weighting::projected_angle;
    bool tangents_only = false;  ///< leave out `t` and `lengths_t`
    /// Leave out rows of triangles that are degenerate or have no UV area, where that is less work.
    bool adding_only = false;
};

inline constexpr std::size_t kTermTriangles = 64;  ///< of one block; its arrays stay in the first cache
inline constexpr std::size_t kTermCorners = 3 * kTermTriangles;

/// Marks of a corner. If all corners of a node have enough of them in common, its group cannot split under
/// the threshold of 180 degrees, which separates only opposite tangents or bitangents. With unit tangents s
/// in the plane across the normal, W the sum of all weights, w the smallest and S the sum of all weighted
/// tangents:
///
/// 1. Were two tangents a right angle or more apart, |S| <= W - (2 - sqrt(2)) w. So |S| > W - 0.4 w
///    (see node_sums.h) shows that all are less than a right angle apart; by that margin, less than 74 degrees.
/// 2. A bitangent that turns left (right) lies on that side of its tangent, 45 to 135 degrees from it. If all
///    turn to one side, then no two are further apart than 74 + 90 degrees.
///
/// Normals need a length near 1 for this (node_sums.h), and tangents must not be so close to the normal that
/// what is left of them is mostly error: kSmallestSquare. A NaN sets no mark.
inline constexpr std::uint32_t kFacesUp = 0x01;    ///< positive UV area
inline constexpr std::uint32_t kFacesDown = 0x02;  ///< the opposite
inline constexpr std::uint32_t kFacing = kFacesUp | kFacesDown;
inline constexpr std::uint32_t kTurnsLeft = 0x04;
inline constexpr std::uint32_t kTurnsRight = 0x08;
inline constexpr std::uint32_t kNotLight = 0x10;   ///< its weight is above kLightWeight
inline constexpr std::uint32_t kNotMiddle = 0x20;  ///< above kMiddleWeight
inline constexpr std::uint32_t kHeavy = 0x40;      ///< above kHeavyWeight
inline constexpr std::uint32_t kAllMarks = 0x7f;
inline constexpr std::uint32_t kNoUvArea = 0x100;        ///< the triangle has no usable UV area
inline constexpr std::uint32_t kDegenerateMark = 0x200;  ///< two corners at one position: nothing else means anything
inline constexpr std::uint32_t kMirroredMark = 0x400;    ///< no positive UV area
inline constexpr float kLightWeight = 1.0f / 128, kMiddleWeight = 1.0f / 16, kHeavyWeight = 1.0f / 4;
inline constexpr float kSmallestSquare = 0.04f, kTurnMargin = 0.15f;

/// Rows of four: row 3 * t + k belongs to corner k of triangle t.
struct CornerTerms {
    alignas(64) float s[kTermCorners][4];            ///< weight * projected tangent, weight
    alignas(64) float t[kTermCorners][4];            ///< weight * projected bitangent, weight * |dP/du|
    alignas(64) float lengths_t[3][kTermTriangles];  ///< weight * |dP/dv| of corner k of triangle t
    alignas(64) std::uint32_t marks[3][kTermTriangles];
};

/// `vertices`: three per triangle; whole groups of 16 triangles are read, so the rest of the last one must
/// hold valid numbers too. count <= kTermTriangles.
TSPACE_DECLARE_KERNEL(void cornerTerms(const CornerSource& source, const std::uint32_t* vertices, std::size_t count,
                                       CornerTerms& terms))

using CornerTermsFunction = decltype(&scalar::cornerTerms);
inline CornerTermsFunction cornerTermsFor(SimdTarget wish) {
    return simd::choose(wish, TSPACE_KERNEL_TABLE(cornerTerms));
}

}  // namespace tspace::mikk
