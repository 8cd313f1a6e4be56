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
#else
    return SimdTarget::scalar;
#endif
}

}  // namespace

SimdTarget resolve(SimdTarget wish) {
    static const SimdTarget best = bestOfCpu();
    return wish == SimdTarget::best || wish > best ? best : wish;
}

}  // namespace tspace::simd
