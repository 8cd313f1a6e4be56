// SPDX-License-Identifier: MIT
// The codes of oct32, frame48 and frame64: see angle_lanes.h.
#pragma once

#include "pack/angle_grid.h"
#include "pack/frame_code.h"

namespace tspace::pack {

/// i and j in [0, 2 * half], k in [0, 4 * quarter).
struct AngleCode {
    std::int32_t i = 0, j = 0, k = 0;
};

AngleCode encodeAngle(const AngleGrid& grid, const SoundFrame& frame);

}  // namespace tspace::pack
