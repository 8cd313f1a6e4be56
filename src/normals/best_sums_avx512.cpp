// SPDX-License-Identifier: MIT
#include "simd/lanes_avx512.h"
#define TSPACE_LANES avx512
#include "normals/best_sums_kernel.h"
