// SPDX-License-Identifier: MIT
#include "simd/lanes_avx512.h"
#define TSPACE_LANES avx512
#include "tangents/estimators/quadratic_recovery_kernel.h"
#include "tangents/estimators/two_weights_kernel.h"
