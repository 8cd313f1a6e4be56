// SPDX-License-Identifier: MIT
// The choice of a kernel for this CPU.
#include "normals/best_sums.h"

#include "simd/dispatch.h"

namespace tspace::smooth {

BestKernel bestKernelFor(SimdTarget wish) {
    switch (simd::resolve(wish)) {
#if defined(TSPACE_SIMD_X86)
        case SimdTarget::avx512:
            return avx512::bestKernel();
        case SimdTarget::avx2:
            return avx2::bestKernel();
        case SimdTarget::sse2:
            return sse2::bestKernel();
#elif defined(TSPACE_SIMD_ARM64)
        case SimdTarget::neon:
            return neon::bestKernel();
#endif
        default:
            return scalar::bestKernel();
    }
}

}  // namespace tspace::smooth
