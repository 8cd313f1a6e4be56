// SPDX-License-Identifier: MIT
// Everything in the C++ API of the core library.
#pragma once

#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/frame.h"
#include "tspace/indexed_frames.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/pack.h"
#include "tspace/plan_buffers.h"
#include "tspace/result.h"
#include "tspace/span.h"
#include "tspace/tangents.h"
#include "tspace/winding.h"
