// SPDX-License-Identifier: MIT
#include "simd/lanes_scalar.h"
#define TSPACE_LANES scalar
#include "tangents/mikktspace/corner_terms_kernel.h"
