// SPDX-License-Identifier: MIT
// The kernels of oct32, frame48 and frame64. Included once per CPU, after lanes_*.h and with TSPACE_LANES set to its
// namespace. Each lane is one frame.
#pragma once

#include "pack/angle_lanes.h"
#include "pack/quotient_lanes.h"

namespace tspace::pack::TSPACE_LANES {

namespace {

/// i and j in [0, 2 * half], k in [0, 4 * quarter). The sign is the lowest bit of word 0 in all three.
struct AngleFields {
    Bits i, j, k;
};

struct Oct32 {
    static constexpr AngleGrid kGrid = kOct32Grid;
    static AngleFields read(const WordBlock& words, std::size_t at) {
        const Bits w = load(words.word[0] + at), ten = broadcastBits(0x3ff);
        return {shiftRight<22>(w), shiftRight<12>(w) & ten, shiftRight<1>(w) & broadcastBits(0x7ff)};
    }
};

struct Frame48 {
    static constexpr AngleGrid kGrid = kFrame48Grid;
    static constexpr std::uint32_t kColumns = 2 * kGrid.half + 1;
    /// Words beyond the last grid point read as that.
    static AngleFields read(const WordBlock& words, std::size_t at) {
        const Bits low = load(words.word[0] + at), high = load(words.word[1] + at);
        const Bits ij = smaller(shiftLeft<15>(high) | shiftRight<17>(low), broadcastBits(kColumns * kColumns - 1));
        const Bits i = quotient<kColumns>(ij);
        return {i, ij - product(i, kColumns), shiftRight<1>(low) & broadcastBits(0xffff)};
    }
};

struct Frame64 {
    static constexpr AngleGrid kGrid = kFrame64Grid;
    static AngleFields read(const WordBlock& words, std::size_t at) {
        const Bits low = load(words.word[0] + at), high = load(words.word[1] + at);
        return {shiftRight<11>(high), (shiftLeft<10>(high) & broadcastBits(0x1ffc00)) | shiftRight<22>(low),
                shiftRight<1>(low) & broadcastBits(0x1fffff)};
    }
};

/// The exponent of a power of two.
constexpr int exponentOf(std::int32_t power) { return power == 1 ? 0 : 1 + exponentOf(power / 2); }

template <class Format>
void decodeAngles(const WordBlock& words, std::size_t count, FrameRows& rows) {
    constexpr AngleGrid kGrid = Format::kGrid;
    const Floats last = broadcast(static_cast<float>(2 * kGrid.half));
    for (std::size_t at = 0; at < count; at += kWidth) {
        const AngleFields fields = Format::read(words, at);
        // The one value of i and j that the grid does not have reads as its neighbour.
        const GridNormals g = gridNormals(kGrid, smaller(toFloats(fields.i), last), smaller(toFloats(fields.j), last));
        const Floats step = toFloats(fields.k & broadcastBits(kGrid.quarter - 1));
        const Vectors tangent = tangentsAt(kGrid, basesOf(g), shiftRight<exponentOf(kGrid.quarter)>(fields.k), step);
        storeFrames(rows, at, {g.normal, tangent}, signFrom<0>(load(words.word[0] + at)));
    }
}

}  // namespace

FrameKernel oct32Kernel() { return {decodeAngles<Oct32>}; }
FrameKernel frame48Kernel() { return {decodeAngles<Frame48>}; }
FrameKernel frame64Kernel() { return {decodeAngles<Frame64>}; }

}  // namespace tspace::pack::TSPACE_LANES
