// SPDX-License-Identifier: MIT
#include "simd/lanes_avx2.h"
#define TSPACE_LANES avx2
#include "normals/best_sums_kernel.h"
