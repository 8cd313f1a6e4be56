// SPDX-License-Identifier: MIT
// Everything in the C++ API of the core library.
#pragma once

#include "tspace/arena.h"
#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/frame.h"
#include "tspace/indexed_frames.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/pack.h"
#include "tspace/position_noise.h"
#include "tspace/result.h"
#include "tspace/sanitize.h"
#include "tspace/span.h"
#include "tspace/split.h"
#include "tspace/tangents.h"
#include "tspace/triangulate.h"
#include "tspace/vec.h"
#include "tspace/winding.h"
