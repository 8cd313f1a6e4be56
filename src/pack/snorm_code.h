// SPDX-License-Identifier: MIT
// Frames in signed normalised integers, as engines and glTF store them: a quaternion, or N and T apart.
#pragma once

#include <array>
#include <cstdint>

#include "pack/frame_code.h"

namespace tspace::pack {

/// x, y, z, w as snorm16. The sign of w is the sign of the frame, so w is never 0.
std::array<std::int32_t, 4> encodeQuaternion(const SoundFrame& frame);
/// Of any four; no rotation (all zero) decodes as that of the axes.
DecodedFrame decodeQuaternion(const std::array<std::int32_t, 4>& code);

/// The components of a vector as snorm numbers of at most `most`, the nearest each.
std::array<std::int32_t, 3> encodeVector(const DVec3& v, std::int32_t most);
/// Made unit. A zero N reads as (0, 0, 1), a zero T as a basis from N.
DecodedFrame decodeVectors(const std::array<std::int32_t, 3>& normal, const std::array<std::int32_t, 3>& tangent);

}  // namespace tspace::pack
