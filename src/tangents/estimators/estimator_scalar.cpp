// SPDX-License-Identifier: MIT
#include "simd/lanes_scalar.h"
#define TSPACE_LANES scalar
#include "tangents/estimators/quadratic_recovery_kernel.h"
#include "tangents/estimators/two_weights_kernel.h"
