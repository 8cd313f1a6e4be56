// SPDX-License-Identifier: MIT
#include "simd/lanes_avx2.h"
#define TSPACE_LANES avx2
#include "tangents/mikktspace/corner_terms_kernel.h"
