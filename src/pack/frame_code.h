// SPDX-License-Identifier: MIT
// What all codes of this room read and give: a frame to encode, and one as decoded. A code is a function of the frame
// alone, and decodes in single precision, as a shader does; the encoder measures by decoding.
#pragma once

#include <algorithm>

#include "core/vec_math.h"

namespace tspace::pack {

/// A frame to encode: N and T unit and orthogonal within 5e-7.
struct SoundFrame {
    DVec3 normal, tangent;
    bool mirrored = false;  ///< the sign is -1
};

inline double squaredDistance(const Vec3& decoded, const DVec3& wanted) {
    const DVec3 d = toDouble(decoded) - wanted;
    return dot(d, d);
}

/// What a small turn in the frame's own axes moves N or T by, squared, whichever moves farther: x and y turn N, y and z
/// turn T.
inline double squaredReach(const DVec3& turn) { return turn.y * turn.y + std::max(turn.x * turn.x, turn.z * turn.z); }

}  // namespace tspace::pack
