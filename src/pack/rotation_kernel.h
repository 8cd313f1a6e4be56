// SPDX-License-Identifier: MIT
// The kernel of frame32. Included once per CPU, after lanes_*.h and with TSPACE_LANES set to its namespace. Each lane is
// one frame.
#pragma once

#include "pack/quotient_lanes.h"
#include "pack/rotation_lanes.h"

namespace tspace::pack::TSPACE_LANES {

namespace {

/// Words that no chart needs read as the last one.
void decodeRotations(const WordBlock& words, std::size_t count, FrameRows& rows) {
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Bits word = load(words.word[0] + at), code = smaller(shiftRight<1>(word), broadcastBits(kCodes - 1));
        const Bits columns = quotient<kColumns>(code), z = code - product(columns, kColumns);
        const Bits rest = quotient<kRows>(columns), y = columns - product(rest, kRows);
        const Bits g = quotient<kColumns>(rest), x = rest - product(g, kColumns);
        const Bits twice_y = y + y + ((x + z) & broadcastBits(1));
        storeFrames(rows, at, rotationFrames(Charts(g), toFloats(x), toFloats(twice_y), toFloats(z)),
                    signFrom<0>(word));
    }
}

}  // namespace

FrameKernel frame32Kernel() { return {decodeRotations}; }

}  // namespace tspace::pack::TSPACE_LANES
