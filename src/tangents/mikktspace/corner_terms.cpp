// SPDX-License-Identifier: MIT
// The choice of a kernel for this CPU.
#include "tangents/mikktspace/corner_terms.h"

#include "simd/dispatch.h"

namespace tspace::mikk {

CornerTermsFunction cornerTermsFor(SimdTarget wish) {
    switch (simd::resolve(wish)) {
#if defined(TSPACE_SIMD_X86)
        case SimdTarget::avx512:
            return avx512::cornerTerms;
        case SimdTarget::avx2:
            return avx2::cornerTerms;
        case SimdTarget::sse2:
            return sse2::cornerTerms;
#elif defined(TSPACE_SIMD_ARM64)
        case SimdTarget::neon:
            return neon::cornerTerms;
#endif
        default:
            return scalar::cornerTerms;
    }
}

}  // namespace tspace::mikk
