// SPDX-License-Identifier: MIT
#include "simd/lanes_neon.h"
#define TSPACE_LANES neon
#include "normals/face_terms_kernel.h"
