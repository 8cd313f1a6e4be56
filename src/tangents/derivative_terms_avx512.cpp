// SPDX-License-Identifier: MIT
#include "simd/lanes_avx512.h"
#define TSPACE_LANES avx512
#include "tangents/derivative_terms_kernel.h"
