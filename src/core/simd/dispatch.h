// SPDX-License-Identifier: MIT
// Detection of the CPU's instruction sets, and selection of the functions compiled for them. A kernel is written once,
// as NAME_kernel.h; cmake/tspace_simd.cmake creates a source file of all kernels for each target.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tspace/execution.h"

// The scalar target is for CPUs without other lanes. Elsewhere only tests need it, for comparison: programs that do not
// link tspace_scalar_kernels are a sixteenth smaller.
#if !defined(TSPACE_SIMD_X86) && !defined(TSPACE_SIMD_ARM64)
#define TSPACE_SCALAR_LINKAGE
#elif defined(__ELF__)
#define TSPACE_SCALAR_LINKAGE [[gnu::weak]]
#define TSPACE_SCALAR_OR_NULL(function, other) scalar::function
#else  // on this platform, a reference to a function that is not linked would be an error
#define TSPACE_SCALAR_LINKAGE
#define TSPACE_SCALAR_OR_NULL(function, other) static_cast<decltype(&other::function)>(nullptr)
#endif

#define TSPACE_IN_NAMESPACE(target, ...) \
    namespace target {                   \
    __VA_ARGS__;                         \
    }
/// Declares a function of a kernel in the namespace of each target.
#define TSPACE_DECLARE_KERNEL(...)                                 \
    TSPACE_IN_NAMESPACE(scalar, TSPACE_SCALAR_LINKAGE __VA_ARGS__) \
    TSPACE_IN_NAMESPACE(sse2, __VA_ARGS__)                         \
    TSPACE_IN_NAMESPACE(avx2, __VA_ARGS__)                         \
    TSPACE_IN_NAMESPACE(avx512, __VA_ARGS__)                       \
    TSPACE_IN_NAMESPACE(neon, __VA_ARGS__)                         \
    TSPACE_IN_NAMESPACE(wasm, __VA_ARGS__)

/// Table of a kernel's functions in this build, for simd::choose. With NOT_AVX512, the AVX2 function, which is equally
/// fast, is used for AVX-512. With TSPACE_MIKKTSPACE_ONLY no kernel is compiled for AVX-512.
#if defined(TSPACE_SIMD_X86) && defined(TSPACE_MIKKTSPACE_ONLY)
#define TSPACE_KERNEL_TABLE(function) \
    { TSPACE_SCALAR_OR_NULL(function, sse2), sse2::function, avx2::function, avx2::function }
#elif defined(TSPACE_SIMD_X86)
#define TSPACE_KERNEL_TABLE(function) \
    { TSPACE_SCALAR_OR_NULL(function, sse2), sse2::function, avx2::function, avx512::function }
#define TSPACE_KERNEL_TABLE_NOT_AVX512(function) \
    { TSPACE_SCALAR_OR_NULL(function, sse2), sse2::function, avx2::function, avx2::function }
#elif defined(TSPACE_SIMD_ARM64)
#define TSPACE_KERNEL_TABLE(function) \
    { TSPACE_SCALAR_OR_NULL(function, neon), neon::function }
#elif defined(TSPACE_SIMD_WASM)
#define TSPACE_KERNEL_TABLE(function) \
    { wasm::function }
#else
#define TSPACE_KERNEL_TABLE(function) \
    { scalar::function }
#endif
#ifndef TSPACE_KERNEL_TABLE_NOT_AVX512
#define TSPACE_KERNEL_TABLE_NOT_AVX512(function) TSPACE_KERNEL_TABLE(function)
#endif

namespace tspace::simd {

/// Returns the target to run for a requested one: `best`, or a target that this CPU or build does not support, is
/// replaced by the best available one with a lower number. Never returns `best`. Thread-safe.
SimdTarget resolve(SimdTarget requested);

/// Returns the function for a requested target; for `scalar` without tspace_scalar_kernels, the one with the fewest
/// lanes.
template <class Function, std::size_t kTargets>
Function* choose(SimdTarget requested, Function* const (&table)[kTargets]) {
    if constexpr (kTargets == 1) return table[0];
    const SimdTarget target = resolve(requested);
    const std::size_t place = target == SimdTarget::neon ? kTargets - 1 : static_cast<std::size_t>(target) - 1;
    return table[place] != nullptr ? table[place] : table[1];
}

}  // namespace tspace::simd

namespace tspace {

// Vertex data of a call, as read by kernels.

struct VertexArrays {
    const std::byte* positions = nullptr;
    const std::byte* normals = nullptr;
    const std::byte* uvs = nullptr;
    std::size_t position_stride = 0, normal_stride = 0, uv_stride = 0;
    /// Last vertex in memory, after whose position and normal no memory may be read. If all bits are set, there is no
    /// such vertex.
    std::uint32_t last_vertex = 0;
};

/// Creates the arrays from nonempty spans with one entry per vertex.
template <class Pose, class Uvs>
VertexArrays vertexArrays(const Pose& pose, const Uvs& uvs) {
    return {reinterpret_cast<const std::byte*>(pose.positions.data),
            reinterpret_cast<const std::byte*>(pose.normals.data),
            reinterpret_cast<const std::byte*>(uvs.data),
            pose.positions.stride_bytes,
            pose.normals.stride_bytes,
            uvs.stride_bytes,
            static_cast<std::uint32_t>(pose.positions.count - 1)};
}

}  // namespace tspace
