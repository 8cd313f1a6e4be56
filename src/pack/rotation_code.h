// SPDX-License-Identifier: MIT
// The code of frame32: a lattice in the space of rotations, cut into 24 equal charts around those that turn axes into
// axes. docs/pack.md says how, and why its error is bounded.
#pragma once

#include <cstdint>

#include "pack/frame_code.h"

namespace tspace::pack {

std::uint32_t encodeRotation(const SoundFrame& frame);
/// Of any word; those that no chart needs decode as words of the last one.
DecodedFrame decodeRotation(std::uint32_t word);

}  // namespace tspace::pack
