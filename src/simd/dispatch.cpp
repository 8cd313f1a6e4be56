// SPDX-License-Identifier: MIT
#include "simd/dispatch.h"

namespace tspace::simd {

namespace {

SimdTarget bestOfCpu() {
#if defined(TSPACE_SIMD_X86)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return SimdTarget::avx512;
    if (__builtin_cpu_supports("avx2")) return SimdTarget::avx2;
    return SimdTarget::sse2;
#elif defined(TSPACE_SIMD_ARM64)
    return SimdTarget::neon;
#else
    return SimdTarget::scalar;
#endif
}

}  // namespace

SimdTarget resolve(SimdTarget wish) {
    static const SimdTarget best = bestOfCpu();
    if (wish == SimdTarget::best || wish > best) return best;
    // The numbers between the two are those of x86-64.
    return best == SimdTarget::neon && wish < best ? SimdTarget::scalar : wish;
}

}  // namespace tspace::simd
