// SPDX-License-Identifier: MIT
// Which frames need no mending. Included once per CPU, after lanes_*.h and with TSPACE_LANES set to its namespace.
#pragma once

#include "core/pack/frame_lanes.h"

namespace tspace::pack::TSPACE_LANES {

/// Bit i: N and T of frame i are unit and orthogonal, to float rounding; what is not a number is not.
std::uint64_t soundFrames(const FrameBlock& frames, std::size_t count) {
    const Doubles one = broadcastDouble(1.0), tolerance = broadcastDouble(kSoundTolerance);
    const auto isUnit = [&](DoubleVectors v) { return tolerance + tolerance > absolute(dot(v, v) - one); };
    std::uint64_t sound = 0;
    for (std::size_t at = 0; at < count; at += kPart) {
        const DoubleVectors n = loadAsDoubles(frames.normal, at), t = loadAsDoubles(frames.tangent, at);
        sound |= std::uint64_t{bitsOf(isUnit(n) & isUnit(t) & (tolerance > absolute(dot(n, t))))} << at;
    }
    return sound;
}

}  // namespace tspace::pack::TSPACE_LANES
