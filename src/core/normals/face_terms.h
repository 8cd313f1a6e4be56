// SPDX-License-Identifier: MIT
// The terms of a block of triangles: the face normal times the angle at the corner, which is added to the corner's
// point. Written once (face_terms_kernel.h), compiled for several CPUs, equal bits from all of them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"

namespace tspace::smooth {

struct FaceSource {
    const std::byte* positions = nullptr;
    std::size_t stride = 0;
    std::uint32_t last_vertex = 0;  ///< right after its position nothing may be read
    double factor = 1;              ///< normalFactor(convention)
    bool by_angle = false, by_area = false;
};

inline constexpr std::size_t kTermTriangles = 64;  ///< of one block; its arrays stay in the first cache
inline constexpr std::size_t kTermGroup = 16;      ///< triangles; vertices are read by whole groups

// Below the first fraction of the weights a sum is what rounding left of normals that cancel. Below the second it shows
// how single-precision angles were rounded: it is then taken again, with angles in double.
inline constexpr double kVanished = 1e-10, kDoubtful = 1e-2;

struct FaceTerms {
    /// The unit normal times `size`, and `size`: the area's double if that is a weight, else 1. Zeros if degenerate.
    alignas(64) double normal[kTermTriangles][4];
    alignas(64) double angle[3][kTermTriangles];  ///< of each corner, or 1 if that is no weight
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

}  // namespace tspace::smooth
