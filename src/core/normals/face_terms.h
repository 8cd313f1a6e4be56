// SPDX-License-Identifier: MIT
// What blocks of triangles add to sums of normals: face normals with their weights, and the rounds of NormalWeighting::best.
// Written once (face_terms_kernel.h, best_sums_kernel.h), compiled for several CPUs, equal bits from all of them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"
#include "tspace/span.h"

namespace tspace::smooth {

// The terms of a block of triangles: the face normal times the angle at the corner, which is added to the corner's
// point. Written once (face_terms_kernel.h), compiled for several CPUs, equal bits from all of them.

struct FaceSource {
    const std::byte* positions = nullptr;
    std::size_t stride = 0;
    std::uint32_t last_vertex = 0;  ///< right after its position nothing may be read
    double factor = 1;              ///< normalFactor(convention)
    bool by_angle = false, by_area = false;
};

inline constexpr std::size_t kTermTriangles = 64;  ///< triangles per block; its arrays fit in the first-level cache
inline constexpr std::size_t kTermGroup = 16;      ///< triangles; vertices are read by whole groups

// Below the first fraction of the weights a sum is what rounding left of normals that cancel. Below the second it shows
// how single-precision angles were rounded: it is then taken again, with angles in double.
inline constexpr double kVanished = 1e-10, kDoubtful = 1e-2;

struct FaceTerms {
    /// The unit normal times `size`, and `size`: the area's double if that is a weight, else 1. Zeros if degenerate.
    alignas(64) double normal[kTermTriangles][4];
    alignas(64) double angle[3][kTermTriangles];  ///< angle at each corner, or 1 if it is not used as a weight
};

/// The functions for one CPU.
struct FaceKernel {
    /// `vertices`: three per triangle, and valid ones up to the end of the last group. count <= kTermTriangles. Returns
    /// how many triangles are degenerate.
    std::size_t (*compute)(const FaceSource& source, const std::uint32_t* vertices, std::size_t count,
                           FaceTerms& terms);
    /// Adds angle * normal to rows of four, one row per point, sums[4 * (point - begin)], for points from `begin` to
    /// before `end`.
    void (*add)(const FaceTerms& terms, const std::uint32_t* points, std::size_t count, double* sums,
                std::uint32_t begin, std::uint32_t end);
    /// Finishes `count` rows of sums, a multiple of kTermGroup: writes four floats to the front of each row, the unit
    /// normal and 0; or three zeros and -0 where the sum is not above `least` times the weights (the fourth number).
    /// Returns the count of such rows that have weights.
    std::uint64_t (*finish)(double* sums, std::size_t count, double least);
};

TSPACE_DECLARE_KERNEL(FaceKernel faceKernel())
inline FaceKernel faceKernelFor(SimdTarget wish) { return simd::choose(wish, TSPACE_KERNEL_TABLE(faceKernel))(); }

// NormalWeighting::best from sums: what each corner of a triangle adds to its point, and what a point makes of it. Two
// rounds, since the second one needs the `max` normals of the first at both ends of an edge, and one for each step of
// NormalOptions::refine. Written once (best_sums_kernel.h), compiled for several CPUs, same bits from all of them.

/// Points have a normal of each kind, or zero.
struct BestSource {
    FaceSource faces;  ///< without weights
    float scale = 1;   ///< scale of positions: a power of four that brings them near 1
    /// Means by angle * area, and by `max`; four bytes behind each are read too. A step reads the normals of the round
    /// before as `robust`; those that are zero stay so, and edges to them do not count.
    const Vec3 *robust = nullptr, *sharp = nullptr;
};

inline constexpr std::size_t kBestTriangles = 32;  ///< triangles per block
inline constexpr std::size_t kBestGroup = 16;      ///< lanes; vertices and points are read by whole groups
inline constexpr std::size_t kFitRows = 8;         ///< rows of four floats; the last one has maxima instead of sums
inline constexpr std::size_t kStepRows = 2;        ///< rows of four floats

/// One round, for one CPU.
struct BestKernel {
    std::size_t row_count;  ///< rows of four floats per corner and point
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
