// SPDX-License-Identifier: MIT
// The choice of a kernel for this CPU.
#include "tangents/estimators/estimator.h"

#include "simd/dispatch.h"

namespace tspace::estimators {

Estimator twoWeightsFor(SimdTarget wish, bool tangents_only) {
    switch (simd::resolve(wish)) {
#if defined(TSPACE_SIMD_X86)
        case SimdTarget::avx512:
            return avx512::twoWeights(tangents_only);
        case SimdTarget::avx2:
            return avx2::twoWeights(tangents_only);
        case SimdTarget::sse2:
            return sse2::twoWeights(tangents_only);
#elif defined(TSPACE_SIMD_ARM64)
        case SimdTarget::neon:
            return neon::twoWeights(tangents_only);
#endif
        default:
            return scalar::twoWeights(tangents_only);
    }
}

Estimator quadraticRecoveryFor(SimdTarget wish) {
    switch (simd::resolve(wish)) {
#if defined(TSPACE_SIMD_X86)
        case SimdTarget::avx512:
            return avx512::quadraticRecovery();
        case SimdTarget::avx2:
            return avx2::quadraticRecovery();
        case SimdTarget::sse2:
            return sse2::quadraticRecovery();
#elif defined(TSPACE_SIMD_ARM64)
        case SimdTarget::neon:
            return neon::quadraticRecovery();
#endif
        default:
            return scalar::quadraticRecovery();
    }
}

}  // namespace tspace::estimators
