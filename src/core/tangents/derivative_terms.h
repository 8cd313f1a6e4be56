// SPDX-License-Identifier: MIT
// dP/du and dP/dv of blocks of triangles, their sums at vertices, and frames from these sums, in single precision, for
// input where that is exact enough. Written once (derivative_terms_kernel.h), compiled for several CPUs, equal bits
// from all of them. Other input is left to the caller.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd/dispatch.h"

namespace tspace::derivatives {

struct TriangleSource {
    const std::byte* positions = nullptr;
    const std::byte* uvs = nullptr;
    std::size_t position_stride = 0, uv_stride = 0;
    std::uint32_t last_vertex = 0;  ///< right after its position nothing may be read
};

inline constexpr std::size_t kTermTriangles = 64;  ///< triangles per block, one per bit of a mask
inline constexpr std::size_t kTermGroup = 16;      ///< triangles and vertices are read by whole groups

/// Six floats per triangle and vertex, in two arrays for vertices.
struct DerivativeTerms {
    alignas(64) float rows[kTermTriangles][8];  ///< s.x s.y s.z t.x t.y t.z, s = dP/du, t = dP/dv; s.x is never -0
    std::uint64_t safe = 0;                     ///< bits of the triangles for which all this holds
    std::uint64_t mirrored = 0;                 ///< safe triangles with negative UV area
};

/// The arrays of sums.
struct SumArrays {
    float* heads = nullptr;  ///< s.x s.y s.z t.x of each vertex
    float* tails = nullptr;  ///< t.y t.z
};

/// The functions for one CPU.
struct DerivativeKernel {
    /// `vertices`: three per triangle, and valid ones up to the end of the last group.
    /// count <= kTermTriangles.
    void (*compute)(const TriangleSource& source, const std::uint32_t* vertices, std::size_t count,
                    DerivativeTerms& terms);
    /// Adds the rows of triangles `begin` to before `end` to the sums of their vertices.
    void (*add)(const DerivativeTerms& terms, const std::uint32_t* vertices, std::size_t begin, std::size_t end,
                SumArrays sums);
    /// Like `add`, only for the vertices from `first` up to, but not including, `past`.
    void (*add_some)(const DerivativeTerms& terms, const std::uint32_t* vertices, std::size_t begin, std::size_t end,
                     SumArrays sums, std::uint32_t first, std::uint32_t past);
    /// Finishes `count` vertices, a multiple of kTermGroup and at most 64: turns heads into tangents with the sign
    /// times `sign_factor` where single precision is enough, and returns the bits of these vertices. Reads the four
    /// bytes after each normal, too.
    std::uint64_t (*finish)(SumArrays sums, const std::byte* normals, std::size_t stride, float sign_factor,
                            std::size_t count);
};

TSPACE_DECLARE_KERNEL(DerivativeKernel derivativeKernel())
inline DerivativeKernel derivativeKernelFor(SimdTarget wish) {
    return simd::choose(wish, TSPACE_KERNEL_TABLE_NOT_AVX512(derivativeKernel))();
}

}  // namespace tspace::derivatives
