// SPDX-License-Identifier: MIT
#include "simd/lanes_neon.h"
#define TSPACE_LANES neon
#include "tangents/derivative_terms_kernel.h"
