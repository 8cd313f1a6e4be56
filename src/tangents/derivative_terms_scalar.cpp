// SPDX-License-Identifier: MIT
#include "simd/lanes_scalar.h"
#define TSPACE_LANES scalar
#include "tangents/derivative_terms_kernel.h"
