// SPDX-License-Identifier: MIT
// dP/du and dP/dv of blocks of triangles, their sums at vertices, and frames from these sums, in single precision, for
// input where that is exact enough; other input is left to the caller. Implemented once (derivative_terms_kernel.h),
// compiled for several CPUs, with equal bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"

namespace tspace::derivatives {

struct TriangleSource {
    const std::byte* positions = nullptr;
    const std::byte* uvs = nullptr;
    std::size_t position_stride = 0, uv_stride = 0;
    std::uint32_t last_vertex = 0;  ///< the memory directly after its position must not be read
};

inline constexpr std::size_t kTermTriangles = 64;  ///< triangles per block, one per bit of a mask
inline constexpr std::size_t kTermGroup = 16;      ///< triangles and vertices are read in whole groups

/// Six floats per triangle and vertex, in two arrays for vertices.
struct DerivativeTerms {
    alignas(64) float rows[kTermTriangles][8];  ///< s.x s.y s.z t.x t.y t.z, s = dP/du, t = dP/dv; s.x is never -0
    std::uint64_t safe = 0;                     ///< bits of the triangles for which single precision is exact enough
    std::uint64_t mirrored = 0;                 ///< safe triangles with negative UV area
};

/// Arrays of the sums.
struct SumArrays {
    float* heads = nullptr;  ///< s.x s.y s.z t.x of each vertex
    float* tails = nullptr;  ///< t.y t.z
};

/// The functions for one CPU.
struct DerivativeKernel {
    /// `vertices`: three per triangle, valid up to the end of the last group. count <= kTermTriangles.
    void (*compute)(const TriangleSource& source, const std::uint32_t* vertices, std::size_t count,
                    DerivativeTerms& terms);
    /// Adds the rows of the triangles in [begin, end) to the sums of their vertices.
    void (*add)(const DerivativeTerms& terms, const std::uint32_t* vertices, std::size_t begin, std::size_t end,
                SumArrays sums);
    /// Like `add`, only for the vertices in [first, past).
    void (*add_some)(const DerivativeTerms& terms, const std::uint32_t* vertices, std::size_t begin, std::size_t end,
                     SumArrays sums, std::uint32_t first, std::uint32_t past);
    /// Finishes `count` vertices, a multiple of kTermGroup and at most 64: replaces heads by tangents with the sign
    /// times `sign_factor` if single precision is sufficient, and returns the bits of these vertices. Also reads the
    /// four bytes after each normal.
    std::uint64_t (*finish)(SumArrays sums, const std::byte* normals, std::size_t stride, float sign_factor,
                            std::size_t count);
};

TSPACE_DECLARE_KERNEL(DerivativeKernel derivativeKernel())
inline DerivativeKernel derivativeKernelFor(SimdTarget wish) {
    return simd::choose(wish, TSPACE_KERNEL_TABLE_NOT_AVX512(derivativeKernel))();
}

}  // namespace tspace::derivatives
