// SPDX-License-Identifier: MIT
#include "simd/lanes_neon.h"
#define TSPACE_LANES neon
#include "normals/best_sums_kernel.h"
