// SPDX-License-Identifier: MIT
#include "simd/lanes_sse2.h"
#define TSPACE_LANES sse2
#include "normals/face_terms_kernel.h"
