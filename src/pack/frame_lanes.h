// SPDX-License-Identifier: MIT
// Frames on lanes: what the kernels of this room share. Included after lanes_*.h, with TSPACE_LANES set to its
// namespace.
#pragma once

#include "pack/frame_block.h"
#include "simd/vectors_kernel.h"

namespace tspace::pack::TSPACE_LANES {

using namespace simd::TSPACE_LANES;

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

/// Scaled to length 1; v must not be zero and its square must not overflow or vanish.
inline Vectors ofUnitLength(Vectors v) { return (broadcast(1.0f) / squareRoot(dot(v, v))) * v; }

/// N and T of a quaternion of any length but 0: the columns z and x of its matrix.
inline Frames framesOf(Floats x, Floats y, Floats z, Floats w) {
    const Floats one = broadcast(1.0f), k = broadcast(2.0f) / (x * x + y * y + z * z + w * w);
    return {{k * (z * x + w * y), k * (y * z - w * x), one - k * (x * x + y * y)},
            {one - k * (y * y + z * z), k * (x * y + w * z), k * (z * x - w * y)}};
}

/// `signs`: the sign bit set where the frame is mirrored.
inline void storeFrames(FrameRows& rows, std::size_t at, const Frames& f, Bits signs) {
    storeRows<4>(rows.normal[at], f.normal.x, f.normal.y, f.normal.z, zero());
    storeRows<4>(rows.tangent[at], f.tangent.x, f.tangent.y, f.tangent.z, flipped(broadcast(1.0f), signs));
}

}  // namespace tspace::pack::TSPACE_LANES
