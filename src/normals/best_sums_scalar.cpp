// SPDX-License-Identifier: MIT
#include "simd/lanes_scalar.h"
#define TSPACE_LANES scalar
#include "normals/best_sums_kernel.h"
