// SPDX-License-Identifier: MIT
#include "simd/lanes_sse2.h"
#define TSPACE_LANES sse2
#include "normals/best_sums_kernel.h"
