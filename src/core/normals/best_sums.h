// SPDX-License-Identifier: MIT
// NormalWeighting::best from sums: what each corner of a triangle adds to its point, and what a point makes of it. Two
// rounds, since the second one needs the `max` normals of the first at both ends of an edge, and one for each step of
// NormalOptions::refine. Written once (best_sums_kernel.h), compiled for several CPUs, same bits from all of them.
#pragma once

#include "core/normals/face_terms.h"
#include "tspace/vec.h"

namespace tspace::smooth {

/// Points have a normal of each kind, or zero.
struct BestSource {
    FaceSource faces;  ///< without weights
    float scale = 1;   ///< of positions: a power of four that brings them near 1
    /// Means by angle * area, and by `max`; four bytes behind each are read too. A step reads the normals of the round
    /// before as `robust`; those that are zero stay so, and edges to them do not count.
    const Vec3 *robust = nullptr, *sharp = nullptr;
};

inline constexpr std::size_t kBestTriangles = 32;  ///< of one block
inline constexpr std::size_t kBestGroup = 16;      ///< lanes; vertices and points are read by whole groups
inline constexpr std::size_t kFitRows = 8;         ///< of four floats; the last one has maxima in the place of sums
inline constexpr std::size_t kStepRows = 2;        ///< of four floats

/// One round, for one CPU.
struct BestKernel {
    std::size_t row_count;  ///< of four floats, per corner and point
    /// `vertices` and `points`: three per triangle, and valid ones up to the end of the last group. Corner k of
    /// triangle t writes to rows + 4 * row_count * (3 * t + k). Triangles without area, or with values that are not
    /// finite, write zeros.
    void (*add)(const BestSource& source, const std::uint32_t* vertices, const std::uint32_t* points, std::size_t count,
                float* rows);
    /// Makes the first row of each point its unit normal, or zero. robust, sharp: four floats per point, of the source.
    /// A multiple of kBestGroup.
    void (*finish)(float* sums, const float* robust, const float* sharp, std::size_t count);
};

/// The rounds in order, each of which reads the results before it: `sharp` gives the means by `max`, `fit` the normals
/// that both means and the edges give, `step` refines these.
struct BestKernels {
    BestKernel sharp, fit, step;
};

TSPACE_DECLARE_KERNEL(BestKernels bestKernels())
inline BestKernels bestKernelsFor(SimdTarget wish) { return simd::choose(wish, TSPACE_KERNEL_TABLE(bestKernels))(); }

}  // namespace tspace::smooth
