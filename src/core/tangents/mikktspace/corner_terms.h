// SPDX-License-Identifier: MIT
// What each corner of a block of triangles adds to the sums of its node: the projected tangent times the
// corner's weight, and the same for the bitangent and both lengths. Written once (corner_terms_kernel.h),
// compiled for several CPUs, same bits from all of them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"
#include "core/tangents/vertex_arrays.h"

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

/// Marks of a corner. The angular test under the threshold of 180 degrees separates only opposite tangents or bitangents:
/// those whose cosine rounds to -1. If all of a node have a component above kSideMargin on one axis, or all have one below
/// -kSideMargin, then every two of them have a cosine of 2 * kSideMargin^2 - 1 at least, far more than what rounding takes
/// away. So where all corners of a node have one such mark of tangents in common, and one of bitangents, its group cannot
/// split. A NaN sets no mark.
inline constexpr std::uint32_t kFacesUp = 0x01;    ///< positive UV area
inline constexpr std::uint32_t kFacesDown = 0x02;  ///< the opposite
inline constexpr std::uint32_t kFacing = kFacesUp | kFacesDown;
/// The projected tangent: above on x, below on x, and so on; and the same of the projected bitangent.
inline constexpr std::uint32_t kTangentSides = 0x3f << 2, kBitangentSides = 0x3f << 8;
inline constexpr std::uint32_t kAllMarks = kFacing | kTangentSides | kBitangentSides;
inline constexpr unsigned kFlagShift = 16;
inline constexpr std::uint32_t kNoUvArea = 1u << kFlagShift;  ///< the triangle has no usable UV area
/// Two corners at one position: nothing else means anything.
inline constexpr std::uint32_t kDegenerateMark = 2u << kFlagShift;
inline constexpr std::uint32_t kMirroredMark = 4u << kFlagShift;  ///< no positive UV area
/// Vectors of a smaller square may have no unit length after all. Bitangents are marked before they are brought to it, and
/// have a square below kLargestSquare.
inline constexpr float kSideMargin = 1.0f / 128, kSmallestSquare = 1e-30f, kLargestSquare = 4;

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
