// SPDX-License-Identifier: MIT
// The choice of a kernel for this CPU.
#include "normals/face_terms.h"

#include "simd/dispatch.h"

namespace tspace::smooth {

FaceKernel faceKernelFor(SimdTarget wish) {
    switch (simd::resolve(wish)) {
#if defined(TSPACE_SIMD_X86)
        case SimdTarget::avx512:
            return avx512::faceKernel();
        case SimdTarget::avx2:
            return avx2::faceKernel();
        case SimdTarget::sse2:
            return sse2::faceKernel();
#elif defined(TSPACE_SIMD_ARM64)
        case SimdTarget::neon:
            return neon::faceKernel();
#endif
        default:
            return scalar::faceKernel();
    }
}

}  // namespace tspace::smooth
