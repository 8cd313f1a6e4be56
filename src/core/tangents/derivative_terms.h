// SPDX-License-Identifier: MIT
// dP/du and dP/dv of blocks of triangles, their sums at vertices, and frames from these sums, in single precision, for
// input for which that is accurate enough; the caller processes other input. The kernel is implemented once
// (derivative_terms_kernel.h) and compiled for several CPUs, with equal bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"

namespace tspace::derivatives {

struct TriangleSource {
    const std::byte* positions = nullptr;
    const std::byte* uvs = nullptr;
    std::size_t position_stride = 0, uv_stride = 0;
    /// vertex whose position is the last in memory: the bytes after it must not be read
    std::uint32_t last_vertex = 0;
};

inline constexpr std::size_t kTermTriangles = 64;  ///< triangles per block: one per bit of a mask
/// Numbers of triangles and vertices are rounded up to multiples of this, so that kernels process no partial groups.
inline constexpr std::size_t kTermGroup = 16;

/// Terms of a block of triangles, which are added to the sums of their vertices: six floats per triangle and vertex.
struct DerivativeTerms {
    /// s.x s.y s.z t.x t.y t.z, with s = dP/du and t = dP/dv; s.x is never -0
    alignas(64) float rows[kTermTriangles][8];
    std::uint64_t safe = 0;        ///< bits of the triangles for which single precision is accurate enough
    std::uint64_t mirrored = 0;    ///< safe triangles with negative UV area
    std::uint64_t degenerate = 0;  ///< triangles with two corners at the same position
};

/// Sums of all vertices, six floats per vertex in two arrays.
struct SumArrays {
    float* heads = nullptr;  ///< s.x s.y s.z t.x of each vertex
    float* tails = nullptr;  ///< t.y t.z of each vertex
};

/// Functions of the kernel, compiled for one CPU.
struct DerivativeKernel {
    /// Computes the terms of `count` triangles, at most kTermTriangles. `vertices`: three per triangle, valid up to the
    /// end of the last group.
    void (*compute)(const TriangleSource& source, const std::uint32_t* vertices, std::size_t count,
                    DerivativeTerms& terms);
    /// Adds the rows of the triangles in [begin, end) to the sums of their vertices.
    void (*add)(const DerivativeTerms& terms, const std::uint32_t* vertices, std::size_t begin, std::size_t end,
                SumArrays sums);
    /// Adds rows like `add`, but only for the vertices in [first, past).
    void (*add_some)(const DerivativeTerms& terms, const std::uint32_t* vertices, std::size_t begin, std::size_t end,
                     SumArrays sums, std::uint32_t first, std::uint32_t past);
    /// Finishes `count` vertices, a multiple of kTermGroup and at most 64. If single precision is sufficient for a
    /// vertex, replaces its head by the tangent with the sign times `sign_factor`. Returns the bits of these vertices.
    /// Also reads the four bytes after each normal.
    std::uint64_t (*finish)(SumArrays sums, const std::byte* normals, std::size_t stride, float sign_factor,
                            std::size_t count);
};

TSPACE_DECLARE_KERNEL(DerivativeKernel derivativeKernel())
inline DerivativeKernel derivativeKernelFor(SimdTarget requested) {
    return simd::choose(requested, TSPACE_KERNEL_TABLE_NOT_AVX512(derivativeKernel))();
}

}  // namespace tspace::derivatives
