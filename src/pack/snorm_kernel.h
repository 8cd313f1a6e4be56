// SPDX-License-Identifier: MIT
// The kernels of the formats in signed normalised integers. Included once per CPU, after lanes_*.h and with TSPACE_LANES
// set to its namespace. Each lane is one frame.
#pragma once

#include "pack/frame_lanes.h"

namespace tspace::pack::TSPACE_LANES {

namespace {

/// Number `which` of a frame, each of kBits with a sign; the least one reads as the next.
template <int kBits, int which>
inline Floats numberAt(const WordBlock& words, std::size_t at) {
    constexpr int kPerWord = 32 / kBits, kUnused = (kPerWord - 1 - which % kPerWord) * kBits;
    constexpr float kRange = 1 << kBits;
    const Bits word = load(words.word[which / kPerWord] + at);
    const Floats number = toFloats(shiftRight<32 - kBits>(shiftLeft<kUnused>(word)));
    const Floats with_sign = number - select(number < broadcast(kRange / 2), zero(), broadcast(kRange));
    return larger(with_sign, broadcast(1 - kRange / 2));
}

/// Where a number is negative, the sign bit.
inline Bits signOf(Floats number) { return orWhere(broadcastBits(0), number < zero(), 0x80000000u); }

/// A quaternion x, y, z, w. No rotation (all zero) reads as that of the axes.
void decodeQuaternions(const WordBlock& words, std::size_t count, FrameRows& rows) {
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Floats x = numberAt<16, 0>(words, at), y = numberAt<16, 1>(words, at), z = numberAt<16, 2>(words, at);
        const Floats w = numberAt<16, 3>(words, at);
        const Mask is_zero = x * x + y * y + z * z + w * w == zero();
        storeFrames(rows, at, framesOf(x, y, z, select(is_zero, broadcast(1.0f), w)), signOf(w));
    }
}

/// The first axis of planeAxes, in double as there.
inline Vectors firstAxes(Vectors n) {
    Doubles axis[3][kDoubleParts];
    for (std::size_t i = 0; i < kDoubleParts; ++i) {
        const Doubles x = part(n.x, i), y = part(n.y, i), z = part(n.z, i);
        const Doubles one = broadcastDouble(1.0), s = withSignOf(one, z), a = broadcastDouble(-1.0) / (s + z);
        axis[0][i] = one + s * x * x * a;
        axis[1][i] = s * (x * y * a);
        axis[2][i] = withSignOf(broadcastDouble(-1.0), z) * x;
    }
    return {join(axis[0]), join(axis[1]), join(axis[2])};
}

/// T, then N from number 4; which number holds the sign. A zero N reads as (0, 0, 1), a zero T as a basis from N.
template <int kBits, int kSignAt>
void decodeVectors(const WordBlock& words, std::size_t count, FrameRows& rows) {
    const auto selectVectors = [](Mask m, Vectors yes, Vectors no) {
        return Vectors{select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
    };
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Vectors t{numberAt<kBits, 0>(words, at), numberAt<kBits, 1>(words, at), numberAt<kBits, 2>(words, at)};
        const Vectors n{numberAt<kBits, 4>(words, at), numberAt<kBits, 5>(words, at), numberAt<kBits, 6>(words, at)};
        const Mask no_normal = dot(n, n) == zero(), no_tangent = dot(t, t) == zero();
        Frames f{selectVectors(no_normal, {zero(), zero(), broadcast(1.0f)}, ofUnitLength(n)), ofUnitLength(t)};
        if (bitsOf(no_tangent) != 0) f.tangent = selectVectors(no_tangent, firstAxes(f.normal), f.tangent);
        storeFrames(rows, at, f, signOf(numberAt<kBits, kSignAt>(words, at)));
    }
}

}  // namespace

FrameKernel qtangent64Kernel() { return {decodeQuaternions}; }
FrameKernel snorm8PairKernel() { return {decodeVectors<8, 7>}; }
FrameKernel snorm16PairKernel() { return {decodeVectors<16, 7>}; }
FrameKernel gltfSnorm8Kernel() { return {decodeVectors<8, 3>}; }
FrameKernel gltfSnorm16Kernel() { return {decodeVectors<16, 3>}; }

}  // namespace tspace::pack::TSPACE_LANES
