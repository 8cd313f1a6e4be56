// SPDX-License-Identifier: MIT
#include "simd/lanes_neon.h"
#define TSPACE_LANES neon
#include "tangents/estimators/quadratic_recovery_kernel.h"
#include "tangents/estimators/two_weights_kernel.h"
