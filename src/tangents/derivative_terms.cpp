// SPDX-License-Identifier: MIT
// The choice of a kernel for this CPU.
#include "tangents/derivative_terms.h"

#include "simd/dispatch.h"

namespace tspace::derivatives {

DerivativeKernel derivativeKernelFor(SimdTarget wish) {
    switch (simd::resolve(wish)) {
#if defined(TSPACE_SIMD_X86)
        case SimdTarget::avx512:
            return avx512::derivativeKernel();
        case SimdTarget::avx2:
            return avx2::derivativeKernel();
        case SimdTarget::sse2:
            return sse2::derivativeKernel();
#elif defined(TSPACE_SIMD_ARM64)
        case SimdTarget::neon:
            return neon::derivativeKernel();
#endif
        default:
            return scalar::derivativeKernel();
    }
}

}  // namespace tspace::derivatives
