// SPDX-License-Identifier: MIT
// Frames in signed normalised integers, as engines and glTF store them: a quaternion, or N and T apart.
#pragma once

#include <array>
#include <cstdint>

#include "pack/frame_code.h"

namespace tspace::pack {

/// x, y, z, w as snorm16. The sign of w is the sign of the frame, so w is never 0.
std::array<std::int32_t, 4> encodeQuaternion(const SoundFrame& frame);

/// The components of a vector as snorm numbers of at most `most`, the nearest each.
std::array<std::int32_t, 3> encodeVector(const DVec3& v, std::int32_t most);

}  // namespace tspace::pack
