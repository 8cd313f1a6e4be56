// SPDX-License-Identifier: MIT
// Contributions of blocks of triangles to sums of normals: weighted face normals, and the rounds of
// NormalWeighting::best. Implemented once (face_terms_kernel.h, best_sums_kernel.h), compiled for several CPUs, with
// equal bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"
#include "tspace/span.h"

namespace tspace::smooth {

// Terms of a block of triangles: the face normal times the angle at each corner, which is added to the corner's point.
// They are implemented once (face_terms_kernel.h) and compiled for several CPUs, with equal bits.

struct FaceSource {
    const std::byte* positions = nullptr;
    std::size_t stride = 0;
    /// vertex whose position is the last in memory: the bytes after it must not be read
    std::uint32_t last_vertex = 0;
    double factor = 1;  ///< normalFactor(convention)
    bool by_angle = false, by_area = false;
};

inline constexpr std::size_t kTermTriangles = 64;  ///< triangles per block, whose arrays fit into the L1 cache
/// Numbers of triangles and rows are rounded up to multiples of this, so that kernels process no partial groups.
inline constexpr std::size_t kTermGroup = 16;

// Thresholds for sums, as fractions of their weights. Below kVanished, a sum consists of rounding errors of normals
// that cancel. Below kDoubtful, the rounding of single-precision angles matters, so the sum is recomputed with angles
// in double precision.
inline constexpr double kVanished = 1e-10, kDoubtful = 1e-2;

struct FaceTerms {
    /// Unit normal times `size`, followed by `size`: twice the area if it is a weight, otherwise 1. Zeros for a
    /// degenerate triangle.
    alignas(64) double normal[kTermTriangles][4];
    alignas(64) double angle[3][kTermTriangles];  ///< angle at each corner, or 1 if it is not used as a weight
};

/// Functions of the kernel, compiled for one CPU.
struct FaceKernel {
    /// Computes the terms of `count` triangles, at most kTermTriangles. `vertices`: three per triangle, valid up to the
    /// end of the last group. Returns the number of degenerate triangles.
    std::size_t (*compute)(const FaceSource& source, const std::uint32_t* vertices, std::size_t count,
                           FaceTerms& terms);
    /// Adds angle * normal to rows of four doubles, one row per point, at sums[4 * (point - begin)], for points in
    /// [begin, end).
    void (*add)(const FaceTerms& terms, const std::uint32_t* points, std::size_t count, double* sums,
                std::uint32_t begin, std::uint32_t end);
    /// Finishes `count` rows of sums, a multiple of kTermGroup. The first four floats of each row become the unit
    /// normal and 0, or three zeros and -0 if the sum is not above `least` times the weights (the fourth number of the
    /// row). Returns the number of rows that have weights but no normal.
    std::uint64_t (*finish)(double* sums, std::size_t count, double least);
};

TSPACE_DECLARE_KERNEL(FaceKernel faceKernel())
inline FaceKernel faceKernelFor(SimdTarget requested) {
    return simd::choose(requested, TSPACE_KERNEL_TABLE(faceKernel))();
}

// Sums of NormalWeighting::best: the contributions of each triangle corner to its point, and the result of a point.
// There are two passes, because the second one needs the `max` normals of the first at both ends of an edge, and one
// per step of NormalOptions::refine. They are implemented once (best_sums_kernel.h) and compiled for several CPUs, with
// equal bits.

/// Input of a pass. Each point has a normal of each kind, which may be zero.
struct BestSource {
    FaceSource faces;  ///< faces, whose weights are not used
    float scale = 1;   ///< scale factor of positions: a power of four that brings them close to 1
    /// Means by angle * area, and by `max`; the four bytes after each array are also read. A step reads the normals of
    /// the previous pass as `robust`; zero normals remain zero, and edges to them are ignored.
    const Vec3 *robust = nullptr, *sharp = nullptr;
};

inline constexpr std::size_t kBestTriangles = 32;  ///< triangles per block
/// Numbers of triangles and points are rounded up to multiples of this, so that kernels process no partial groups.
inline constexpr std::size_t kBestGroup = 16;
/// rows of four floats in the fit; the last row contains maxima instead of sums
inline constexpr std::size_t kFitRows = 8;
inline constexpr std::size_t kStepRows = 2;  ///< rows of four floats in a step

/// Kernel of one pass of the weighting `best`, compiled for one SIMD instruction set.
struct BestKernel {
    std::size_t row_count;  ///< number of rows of four floats per corner and point
    /// Writes the rows of `count` triangles: corner k of triangle t to rows + 4 * row_count * (3 * t + k). `vertices`
    /// and `points`: three per triangle, valid up to the end of the last group. Triangles without area, or with values
    /// that are not finite, write zeros.
    void (*add)(const BestSource& source, const std::uint32_t* vertices, const std::uint32_t* points, std::size_t count,
                float* rows);
    /// Replaces the first row of each point by its unit normal, or zero. robust, sharp: the normals of the source, four
    /// floats per point. `count` is a multiple of kBestGroup.
    void (*finish)(float* sums, const float* robust, const float* sharp, std::size_t count);
};

/// Passes in order; each reads the results of the previous ones: `sharp` computes the means by `max`, `fit` the normals
/// from both means and the edges, `step` refines them.
struct BestKernels {
    BestKernel sharp, fit, step;
};

TSPACE_DECLARE_KERNEL(BestKernels bestKernels())
inline BestKernels bestKernelsFor(SimdTarget requested) {
    return simd::choose(requested, TSPACE_KERNEL_TABLE(bestKernels))();
}

}  // namespace tspace::smooth
