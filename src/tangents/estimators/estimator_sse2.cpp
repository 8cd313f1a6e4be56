// SPDX-License-Identifier: MIT
#include "simd/lanes_sse2.h"
#define TSPACE_LANES sse2
#include "tangents/estimators/quadratic_recovery_kernel.h"
#include "tangents/estimators/two_weights_kernel.h"
