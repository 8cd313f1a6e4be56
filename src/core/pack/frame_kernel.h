// SPDX-License-Identifier: MIT
// Frames on lanes, shared by the kernels of this room, and the kernel that finds sound frames. Included once per CPU,
// after lanes_*.h and with TSPACE_LANES set to its namespace.
#pragma once

#include "core/pack/frame_block.h"
#include "core/simd/vectors_kernel.h"

namespace tspace::pack::TSPACE_LANES {

using namespace simd::TSPACE_LANES;
using simd::TSPACE_LANES::dot;
using simd::TSPACE_LANES::loadAsDoubles;
using simd::TSPACE_LANES::select;
using simd::TSPACE_LANES::store;

struct Frames {
    Vectors normal, tangent;
};

/// The sign bit of a float, set where bit kBit is.
template <int kBit>
inline Bits signFrom(Bits bits) {
    return shiftLeft<31 - kBit>(bits) & broadcastBits(0x80000000u);
}
inline Floats flipped(Floats a, Bits signs) { return asFloats(asBits(a) ^ signs); }
/// Whether that bit is set.
template <int kBit>
inline Mask isSet(Bits bits) {
    return toFloats(shiftRight<kBit>(bits) & broadcastBits(1)) > zero();
}

/// Whole numbers next to and below x, |x| < 2^22: sums with 1.5 2^23 are rounded to whole numbers.
inline Floats nearestWhole(Floats x) { return (x + broadcast(12582912.0f)) - broadcast(12582912.0f); }
inline Floats wholeBelow(Floats x) {
    const Floats near = nearestWhole(x);
    return near - select(near > x, broadcast(1.0f), zero());
}
inline Doubles wholeBelow(Doubles x) {
    const Doubles magic = broadcastDouble(6755399441055744.0), near = (x + magic) - magic;  // 1.5 2^52
    return near - keepWhere(near > x, broadcastDouble(1.0));
}
/// A whole number from 0 to before 2^23: those are the lower bits of its sum with 2^23.
inline Bits wholeBits(Floats x) { return asBits(x + broadcast(8388608.0f)) ^ asBits(broadcast(8388608.0f)); }
inline Floats clamped(Floats x, float low, float high) { return smaller(larger(x, broadcast(low)), broadcast(high)); }

inline Vectors loadVectors(const float (&v)[3][kBlockFrames], std::size_t at) {
    return {load(v[0] + at), load(v[1] + at), load(v[2] + at)};
}
inline void store(float (&to)[3][kBlockFrames], std::size_t at, Vectors v) {
    store(to[0] + at, v.x);
    store(to[1] + at, v.y);
    store(to[2] + at, v.z);
}
inline Vectors select(Mask m, Vectors yes, Vectors no) {
    return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}

/// Half of the lanes in double.
inline constexpr std::size_t kPart = kWidth / kDoubleParts;
struct DoubleVectors {
    Doubles x, y, z;
};
inline Doubles dot(DoubleVectors a, DoubleVectors b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline DoubleVectors loadAsDoubles(const float (&v)[3][kBlockFrames], std::size_t at) {
    return {loadAsDoubles(v[0] + at), loadAsDoubles(v[1] + at), loadAsDoubles(v[2] + at)};
}

/// Scaled to length 1; v must not be zero and its square must not overflow or vanish.
inline Vectors ofUnitLength(Vectors v) { return (broadcast(1.0f) / squareRoot(dot(v, v))) * v; }

/// N and T of a quaternion of any length but 0: the columns z and x of its matrix.
inline Frames framesOf(Floats x, Floats y, Floats z, Floats w) {
    const Floats one = broadcast(1.0f), k = broadcast(2.0f) / (x * x + y * y + z * z + w * w);
    return {{k * (z * x + w * y), k * (y * z - w * x), one - k * (x * x + y * y)},
            {one - k * (y * y + z * z), k * (x * y + w * z), k * (z * x - w * y)}};
}

/// Squared distance that a small rotation about the frame's own axes moves N or T, whichever moves farther: x and y move N, y
/// and z move T.
inline Floats squaredReach(Vectors turn) { return turn.y * turn.y + larger(turn.x * turn.x, turn.z * turn.z); }

/// `signs`: the sign bit set where the frame is mirrored.
inline void storeFrames(const FrameRows& rows, std::size_t at, const Frames& f, Bits signs) {
    storeRows<3>(rows.normals + 3 * at, f.normal.x, f.normal.y, f.normal.z, zero());
    storeRows<4>(rows.tangents + 4 * at, f.tangent.x, f.tangent.y, f.tangent.z, flipped(broadcast(1.0f), signs));
}

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
