// SPDX-License-Identifier: MIT
#include "simd/lanes_avx2.h"
#define TSPACE_LANES avx2
#include "tangents/derivative_terms_kernel.h"
