// SPDX-License-Identifier: MIT
// Normal maps: how they are read, and what can be done to them.
#pragma once

#include "tspace/flip_green.h"
#include "tspace/map_bake.h"
#include "tspace/map_convert.h"
#include "tspace/map_error.h"
#include "tspace/map_height.h"
#include "tspace/map_image.h"
#include "tspace/map_layers.h"
#include "tspace/map_layout.h"
#include "tspace/map_rays.h"
#include "tspace/map_reading.h"
#include "tspace/texture_wrap.h"
