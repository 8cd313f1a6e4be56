// SPDX-License-Identifier: MIT
#include "core/simd/dispatch.h"

#include <cstdint>
#if defined(TSPACE_SIMD_X86)
#include <cpuid.h>
#endif

namespace tspace::simd {
namespace {

/// Returns the best target of this CPU. Equivalent to __builtin_cpu_supports on x86-64, but without the names of all
/// CPUs, which add 5 KB to each program.
SimdTarget bestOfCpu() {
#if defined(TSPACE_SIMD_X86)
    // bits of XCR0: registers that the operating system saves for threads
    constexpr std::uint32_t kYmm = 0x6, kZmm = 0xe6;
    std::uint32_t a = 0, b = 0, c = 0, d = 0, kept = 0;
    if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & bit_OSXSAVE) == 0) return SimdTarget::sse2;
    __asm__("xgetbv" : "=a"(kept), "=d"(d) : "c"(0));
    const bool has_leaf_7 = __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0;
    if (!has_leaf_7 || (kept & kYmm) != kYmm || (b & bit_AVX2) == 0) return SimdTarget::sse2;
    const bool has_avx512 = (b & bit_AVX512F) != 0 && (b & bit_AVX512DQ) != 0;
    return has_avx512 && (kept & kZmm) == kZmm ? SimdTarget::avx512 : SimdTarget::avx2;
#elif defined(TSPACE_SIMD_ARM64)
    return SimdTarget::neon;
#else
    return SimdTarget::scalar;
#endif
}

}  // namespace

SimdTarget resolve(SimdTarget requested) {
    static const SimdTarget best = bestOfCpu();
    if (requested == SimdTarget::best || requested > best) return best;
    // Targets whose value is between that of `scalar` and that of `neon` are for x86-64.
    return best == SimdTarget::neon && requested < best ? SimdTarget::scalar : requested;
}

}  // namespace tspace::simd
