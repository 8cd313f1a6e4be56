// SPDX-License-Identifier: MIT
// Frames on lanes, shared by the kernels of this folder, and the kernel that finds valid frames. Included once per
// instruction set, after lanes_*.h and with TSPACE_LANES set to its namespace.
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

/// Returns words whose sign bit is bit kBit of the argument.
template <int kBit>
inline Bits signFrom(Bits bits) {
    return shiftLeft<31 - kBit>(bits) & broadcastBits(0x80000000u);
}
inline Floats flipped(Floats a, Bits signs) { return asFloats(asBits(a) ^ signs); }
/// Returns a mask of the lanes in which bit kBit is set.
template <int kBit>
inline Mask isSet(Bits bits) {
    return toFloats(shiftRight<kBit>(bits) & broadcastBits(1)) > zero();
}

/// Return the nearest integer, and the integer below, for |x| < 2^22: adding 1.5 * 2^23 rounds to an integer.
inline Floats nearestWhole(Floats x) { return (x + broadcast(12582912.0f)) - broadcast(12582912.0f); }
inline Floats wholeBelow(Floats x) {
    const Floats near = nearestWhole(x);
    return near - select(near > x, broadcast(1.0f), zero());
}
inline Doubles wholeBelow(Doubles x) {
    const Doubles magic = broadcastDouble(6755399441055744.0), near = (x + magic) - magic;  // 1.5 * 2^52
    return near - keepWhere(near > x, broadcastDouble(1.0));
}
/// Converts an integral value in [0, 2^23) to an integer: the lower bits of its sum with 2^23.
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

/// Number of lanes in each half of a vector, which is processed in double precision.
inline constexpr std::size_t kPart = kWidth / kDoubleParts;
struct DoubleVectors {
    Doubles x, y, z;
};
inline Doubles dot(DoubleVectors a, DoubleVectors b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline DoubleVectors loadAsDoubles(const float (&v)[3][kBlockFrames], std::size_t at) {
    return {loadAsDoubles(v[0] + at), loadAsDoubles(v[1] + at), loadAsDoubles(v[2] + at)};
}

/// Returns v normalized; v must not be zero, and its square must neither overflow nor underflow.
inline Vectors ofUnitLength(Vectors v) { return (broadcast(1.0f) / squareRoot(dot(v, v))) * v; }

/// Returns N and T of a quaternion of any nonzero length: the columns z and x of its matrix.
inline Frames framesOf(Floats x, Floats y, Floats z, Floats w) {
    const Floats one = broadcast(1.0f), k = broadcast(2.0f) / (x * x + y * y + z * z + w * w);
    return {{k * (z * x + w * y), k * (y * z - w * x), one - k * (x * x + y * y)},
            {one - k * (y * y + z * z), k * (x * y + w * z), k * (z * x - w * y)}};
}

/// Returns the squared distance by which a small rotation about the frame's own axes moves N or T, whichever is larger:
/// x and y move N, y and z move T.
inline Floats squaredReach(Vectors turn) { return turn.y * turn.y + larger(turn.x * turn.x, turn.z * turn.z); }

/// Stores frames as rows. `signs`: the sign bit is set if the frame is mirrored.
inline void storeFrames(const FrameRows& rows, std::size_t at, const Frames& f, Bits signs) {
    storeRows<3>(rows.normals + 3 * at, f.normal.x, f.normal.y, f.normal.z, zero());
    storeRows<4>(rows.tangents + 4 * at, f.tangent.x, f.tangent.y, f.tangent.z, flipped(broadcast(1.0f), signs));
}

/// Returns the valid frames as bits: N and T of frame i are unit and orthogonal, within float rounding; NaN is invalid.
std::uint64_t validFrames(const FrameBlock& frames, std::size_t count) {
    const Doubles one = broadcastDouble(1.0), tolerance = broadcastDouble(kValidTolerance);
    const auto isUnit = [&](DoubleVectors v) { return tolerance + tolerance > absolute(dot(v, v) - one); };
    std::uint64_t sound = 0;
    for (std::size_t at = 0; at < count; at += kPart) {
        const DoubleVectors n = loadAsDoubles(frames.normal, at), t = loadAsDoubles(frames.tangent, at);
        sound |= std::uint64_t{bitsOf(isUnit(n) & isUnit(t) & (tolerance > absolute(dot(n, t))))} << at;
    }
    return sound;
}

}  // namespace tspace::pack::TSPACE_LANES
