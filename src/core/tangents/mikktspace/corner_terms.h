// SPDX-License-Identifier: MIT
// Contributions of the corners of a block of triangles to the sums of their nodes: the face tangent, projected
// perpendicular to N and normalized, times the corner's weight; and the bitangent and both lengths times that weight.
// The angle weight of MikkTSpace is Weighting::projected_angle; weightOrCosine computes it. Implemented once
// (corner_terms_kernel.h), compiled for several CPUs, with equal bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/build_parts.h"
#include "core/simd/dispatch.h"

namespace tspace::mikk {

enum class Weighting : std::uint32_t {
    projected_angle,  ///< angle between the two edges at the corner after projection perpendicular to N (mikktspace)
    one,
    angle,  ///< interior angle of the triangle
    area,   ///< area of the triangle
    none,   ///< no weights: only marks are written, because estimators compute their own sums
};

inline constexpr std::size_t kTermTriangles = 64;  ///< triangles per block, whose arrays fit into the L1 cache
inline constexpr std::size_t kTermCorners = 3 * kTermTriangles;
inline constexpr std::size_t kTermGroup = 16;  ///< maximum number of triangles that a kernel reads at once

/// Directions of corner k of triangle t, [component][k][t]: the projected tangent, and the projected bitangent before
/// it is normalized.
struct CornerDirections {
    alignas(64) float unit_s[3][3][kTermTriangles], projected_t[3][3][kTermTriangles];
};

/// Vertex arrays of one tangent computation, and the corner quantities that the kernel computes.
struct CornerSource : VertexArrays {
    Weighting weighting = Weighting::projected_angle;
    bool tangents_only = false;  ///< true: omit `t` and `lengths_t`
    /// true: the caller does not read rows of triangles that are degenerate or have no UV area, so the kernel may skip
    /// them
    bool adding_only = false;
    CornerDirections* directions = nullptr;  ///< output of directions; null: not requested
    bool with_marks = true;                  ///< false: omit `marks`
};

/// Marks of a corner, which prove that a group does not split. A threshold of 180 degrees separates only opposite
/// tangents or bitangents, whose cosine rounds to -1. If all tangents of a node have a component above kSideMargin on
/// one axis, or all have one below -kSideMargin, then any two of them have a cosine of at least 2 * kSideMargin^2 - 1,
/// and rounding is far smaller than that margin. Therefore, if all corners of a node share a mark of tangents, and a
/// mark of bitangents, its group cannot split. A NaN sets no mark.
inline constexpr std::uint32_t kFacesUp = 0x01;    ///< positive UV area
inline constexpr std::uint32_t kFacesDown = 0x02;  ///< negative UV area
inline constexpr std::uint32_t kFacing = kFacesUp | kFacesDown;
/// Marks of the projected tangent and of the projected bitangent: x above the margin, x below it, and the same for y
/// and z.
inline constexpr std::uint32_t kTangentSides = 0x3f << 2, kBitangentSides = 0x3f << 8;
inline constexpr std::uint32_t kAllMarks = kFacing | kTangentSides | kBitangentSides;
inline constexpr unsigned kFlagShift = 16;
inline constexpr std::uint32_t kNoUvArea = 1u << kFlagShift;  ///< the triangle has no usable UV area
/// Two corners are at the same position; all other marks are then undefined.
inline constexpr std::uint32_t kDegenerateMark = 2u << kFlagShift;
inline constexpr std::uint32_t kMirroredMark = 4u << kFlagShift;  ///< no positive UV area
/// Margin of the marks, and limits of squared lengths. Tangents whose squared length is below kSmallestSquare may not
/// be unit after normalization and set no marks. Bitangents are tested before normalization; they set marks if their
/// squared length is below kLargestSquare.
inline constexpr float kSideMargin = 1.0f / 128, kSmallestSquare = 1e-30f, kLargestSquare = 4;

/// Terms of a block of triangles: row 3 * t + k, of four floats, belongs to corner k of triangle t.
struct CornerTerms {
    alignas(64) float s[kTermCorners][4];            ///< weight * projected tangent, followed by the weight
    alignas(64) float t[kTermCorners][4];            ///< weight * projected bitangent, followed by weight * |dP/du|
    alignas(64) float lengths_t[3][kTermTriangles];  ///< weight * |dP/dv| of corner k of triangle t
    alignas(64) std::uint32_t marks[3][kTermTriangles];
};

/// Computes the terms of `count` triangles, at most kTermTriangles. `vertices`: three per triangle. Whole groups of 16
/// triangles are read, so the rest of the last group must contain valid indices.
TSPACE_DECLARE_KERNEL(void cornerTerms(const CornerSource& source, const std::uint32_t* vertices, std::size_t count,
                                       CornerTerms& terms))

using CornerTermsFunction = decltype(&scalar::cornerTerms);
inline CornerTermsFunction cornerTermsFor(SimdTarget requested) {
    return simd::choose(requested, TSPACE_KERNEL_TABLE(cornerTerms));
}

}  // namespace tspace::mikk
