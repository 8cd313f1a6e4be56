// SPDX-License-Identifier: MIT
// Kernels of the formats in signed normalized integers. Included once per instruction set, after lanes_*.h and with
// TSPACE_LANES set to its namespace. Each lane is one frame.
#pragma once

#include "core/pack/frame_kernel.h"

namespace tspace::pack::TSPACE_LANES {
namespace {

/// Returns number `which` of a frame, a signed integer of kBits bits. The minimum value is clamped to its successor, as
/// for SNORM.
template <int kBits, int which>
inline Floats numberAt(const WordBlock& words, std::size_t at) {
    constexpr int kPerWord = 32 / kBits, kUnused = (kPerWord - 1 - which % kPerWord) * kBits;
    constexpr float kRange = 1 << kBits;
    const Bits word = load(words.word[which / kPerWord] + at);
    const Floats number = toFloats(shiftRight<32 - kBits>(shiftLeft<kUnused>(word)));
    const Floats with_sign = number - select(number < broadcast(kRange / 2), zero(), broadcast(kRange));
    return larger(with_sign, broadcast(1 - kRange / 2));
}

/// Packs integers, which must be in range, into words.
template <int kBits, std::size_t kCount>
inline void storeNumbers(const Floats (&numbers)[kCount], WordBlock& words, std::size_t at) {
    constexpr std::size_t kPerWord = 32 / kBits;
    constexpr float kRange = 1 << kBits;
    for (std::size_t first = 0; first < kCount; first += kPerWord) {
        Bits word = broadcastBits(0);
        for (std::size_t m = first + kPerWord; m-- > first;) {
            if (m >= kCount) continue;
            const Floats n = numbers[m];
            word = shiftLeft<kBits>(word) | wholeBits(select(n < zero(), n + broadcast(kRange), n));
        }
        store(words.word[first / kPerWord] + at, word);
    }
}

/// Returns the sign bit of negative numbers.
inline Bits signOf(Floats number) { return orWhere(broadcastBits(0), number < zero(), 0x80000000u); }

// ---- quaternions

struct Quaternions {
    Floats x, y, z, w;
};
inline Quaternions selectOf(Mask m, const Quaternions& yes, const Quaternions& no) {
    return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z), select(m, yes.w, no.w)};
}

/// Returns the quaternions of the rotations with columns T, N x T, N; w >= 0. The largest component comes from the
/// diagonal and divides the others, which avoids cancellation.
inline Quaternions quaternionsOf(Vectors t, Vectors n) {
    const Floats one = broadcast(1.0f);
    const Vectors b = cross(n, t);
    const Floats square[4] = {one + t.x - b.y - n.z, one - t.x + b.y - n.z, one - t.x - b.y + n.z,
                              one + t.x + b.y + n.z};
    const Floats xy = t.y + b.x, zx = n.x + t.z, yz = b.z + n.y, x = b.z - n.y, y = n.x - t.z, z = t.y - b.x;
    const Quaternions by[4] = {
        {square[0], xy, zx, x}, {xy, square[1], yz, y}, {zx, yz, square[2], z}, {x, y, z, square[3]}};
    Quaternions q = by[0];
    Floats largest = square[0];
    for (std::size_t m = 1; m < 4; ++m) {
        q = selectOf(square[m] > largest, by[m], q);
        largest = larger(square[m], largest);
    }
    const Floats scale =
        select(q.w < zero(), broadcast(-1.0f), one) / squareRoot(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {scale * q.x, scale * q.y, scale * q.z, scale * q.w};
}

/// Returns the squared distance of N or T, whichever is farther, from rotation q. The rotation between the two, in the
/// frame's axes, is about the vector of conj(q) * code. The unit is arbitrary, but equal for all codes.
inline Floats errorOf(const Quaternions& code, const Quaternions& q) {
    const Vectors v{q.x, q.y, q.z}, c{code.x, code.y, code.z};
    return squaredReach(q.w * c - code.w * v - cross(v, c));
}

struct BestQuaternions {
    Floats error;
    Quaternions code;

    void consider(const Quaternions& tried, const Quaternions& q) {
        const Floats tried_error = errorOf(tried, q);
        const Mask is_better = tried_error < error;
        error = select(is_better, tried_error, error);
        code = selectOf(is_better, tried, code);
    }
};

/// Returns the code around q with the smallest error, not the one with the nearest components. Sixteen candidates
/// suffice, with two exceptions: w must not be 0, and if it becomes 1, larger x, y and z compensate for it.
/// docs/concepts/pack.md has the bounds.
inline Quaternions bestCode(const Quaternions& q) {
    const Floats most = broadcast(32767.0f), one = broadcast(1.0f);
    const auto beside = [&](Floats below, unsigned up) {
        return clamped(below + broadcast(static_cast<float>(up)), -32767.0f, 32767.0f);
    };
    const Quaternions below{wholeBelow(q.x * most), wholeBelow(q.y * most), wholeBelow(q.z * most),
                            wholeBelow(q.w * most)};
    const BestQuaternions none{broadcast(__builtin_huge_valf()), {zero(), zero(), zero(), one}};
    BestQuaternions best = none;
    for (unsigned choice = 0; choice < 16; ++choice) {
        best.consider({beside(below.x, choice & 1), beside(below.y, choice >> 1 & 1), beside(below.z, choice >> 2 & 1),
                       beside(below.w, choice >> 3)},
                      q);
    }
    const Mask is_half_turn = below.w < one;
    if (bitsOf(is_half_turn) == 0) return best.code;
    BestQuaternions wide = none;
    const Quaternions before{below.x - one, below.y - one, below.z - one, one};
    for (unsigned choice = 0; choice < 64; ++choice) {
        wide.consider(
            {beside(before.x, choice & 3), beside(before.y, choice >> 2 & 3), beside(before.z, choice >> 4), one}, q);
    }
    return selectOf(is_half_turn, wide.code, best.code);
}

void encodeQuaternions(const FrameBlock& frames, std::size_t count, WordBlock& words) {
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Quaternions q = quaternionsOf(loadVectors(frames.tangent, at), loadVectors(frames.normal, at));
        const Quaternions code = bestCode(q);
        const Bits signs = signFrom<0>(load(frames.mirrored + at));
        storeNumbers<16>(
            {flipped(code.x, signs), flipped(code.y, signs), flipped(code.z, signs), flipped(code.w, signs)}, words,
            at);
    }
}

/// Decodes quaternions x, y, z, w. An all-zero quaternion is read as the identity.
void decodeQuaternions(const WordBlock& words, std::size_t count, const FrameRows& rows) {
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Floats x = numberAt<16, 0>(words, at), y = numberAt<16, 1>(words, at), z = numberAt<16, 2>(words, at);
        const Floats w = numberAt<16, 3>(words, at);
        const Mask is_zero = x * x + y * y + z * z + w * w == zero();
        storeFrames(rows, at, framesOf(x, y, z, select(is_zero, broadcast(1.0f), w)), signOf(w));
    }
}

// ---- vectors

/// Encodes T in numbers 0 to 2, and N from number 4 on; kSignAt is the number that contains the sign. Unused numbers
/// are set to the maximum; numbers beyond the bytes of a format are not written.
template <int kBits, int kSignAt>
void encodeVectors(const FrameBlock& frames, std::size_t count, WordBlock& words) {
    const Floats most = broadcast((1 << (kBits - 1)) - 1);
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Vectors t = most * loadVectors(frames.tangent, at), n = most * loadVectors(frames.normal, at);
        Floats numbers[8] = {nearestWhole(t.x), nearestWhole(t.y), nearestWhole(t.z), most,
                             nearestWhole(n.x), nearestWhole(n.y), nearestWhole(n.z), most};
        numbers[kSignAt] = flipped(most, signFrom<0>(load(frames.mirrored + at)));
        storeNumbers<kBits>(numbers, words, at);
    }
}

/// Computes the first axis of planeAxes, in double precision like the original.
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

/// Decodes T from numbers 0 to 2, and N from number 4 on; kSignAt is the number that contains the sign. A zero N is
/// read as (0, 0, 1), a zero T as a basis from N.
template <int kBits, int kSignAt>
void decodeVectors(const WordBlock& words, std::size_t count, const FrameRows& rows) {
    for (std::size_t at = 0; at < count; at += kWidth) {
        const Vectors t{numberAt<kBits, 0>(words, at), numberAt<kBits, 1>(words, at), numberAt<kBits, 2>(words, at)};
        const Vectors n{numberAt<kBits, 4>(words, at), numberAt<kBits, 5>(words, at), numberAt<kBits, 6>(words, at)};
        const Mask no_normal = dot(n, n) == zero(), no_tangent = dot(t, t) == zero();
        Frames f{select(no_normal, Vectors{zero(), zero(), broadcast(1.0f)}, ofUnitLength(n)), ofUnitLength(t)};
        if (bitsOf(no_tangent) != 0) f.tangent = select(no_tangent, firstAxes(f.normal), f.tangent);
        storeFrames(rows, at, f, signOf(numberAt<kBits, kSignAt>(words, at)));
    }
}

}  // namespace

FrameKernel qtangent64Kernel() { return {encodeQuaternions, decodeQuaternions}; }
FrameKernel snorm8PairKernel() { return {encodeVectors<8, 7>, decodeVectors<8, 7>}; }
FrameKernel snorm16PairKernel() { return {encodeVectors<16, 7>, decodeVectors<16, 7>}; }
FrameKernel gltfSnorm8Kernel() { return {encodeVectors<8, 3>, decodeVectors<8, 3>}; }
FrameKernel gltfSnorm16Kernel() { return {encodeVectors<16, 3>, decodeVectors<16, 3>}; }

}  // namespace tspace::pack::TSPACE_LANES
