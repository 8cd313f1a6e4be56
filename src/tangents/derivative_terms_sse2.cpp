// SPDX-License-Identifier: MIT
#include "simd/lanes_sse2.h"
#define TSPACE_LANES sse2
#include "tangents/derivative_terms_kernel.h"
