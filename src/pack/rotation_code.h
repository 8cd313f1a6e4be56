// SPDX-License-Identifier: MIT
// The code of frame32: see rotation_lanes.h.
#pragma once

#include <cstdint>

#include "pack/frame_code.h"

namespace tspace::pack {

std::uint32_t encodeRotation(const SoundFrame& frame);

}  // namespace tspace::pack
