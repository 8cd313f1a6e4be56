// SPDX-License-Identifier: MIT
#include "simd/lanes_scalar.h"
#define TSPACE_LANES scalar
#include "normals/face_terms_kernel.h"
