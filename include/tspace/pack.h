// SPDX-License-Identifier: MIT
// Whole frames (N, T and the sign) in 4 to 16 bytes, with a bound on the error that is never exceeded.
// All functions are pure, allocate nothing, use one thread, and may be called from any thread at the same time. Their
// bits are the same on every machine: arithmetic and square roots alone, in a fixed order. See docs/concepts/pack.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "tspace/result.h"
#include "tspace/span.h"

namespace tspace {

/// How a frame is stored, and how far N and T may be off (frameErrorBound), in degrees. Numbers are little-endian;
/// "word" is all bytes of one frame as one unsigned number. The enumerators' values are stable and never reused.
enum class FrameFormat : std::uint32_t {
    /// 4 bytes, 0.135: (rotation << 1) | mirrored. The rotation is a cell of a lattice in one of 24 charts.
    frame32 = 0,
    /// 6 bytes, N 0.0037 and T 0.0042: ((i * 46339 + j) << 17) | (angle << 1) | mirrored; i, j on a warped
    /// octahedron, 65,536 angles.
    frame48 = 1,
    /// 8 bytes, N 0.0001 and T 0.00015: i:21 | j:21 | angle:21 | mirrored:1 from the top; as frame48, finer.
    frame64 = 2,
    /// 4 bytes, N 0.15 and T 0.165: i:10 | j:10 | angle:11 | mirrored:1 from the top; the cheapest to decode of the
    /// codes of 4 bytes.
    oct32 = 3,
    /// 8 bytes, 0.004: the quaternion x, y, z, w of the rotation (T, N x T, N) as snorm16; w is never 0, its sign is
    /// the sign.
    qtangent64 = 4,
    /// 8 bytes, 0.391: T.xyz, 127, N.xyz, sign as snorm8: the order of Unreal's TangentX and TangentZ.
    snorm8Pair = 5,
    /// 16 bytes, 0.00152: the same as snorm16.
    snorm16Pair = 6,
    /// 7 bytes, 0.391: TANGENT (4 snorm8), then NORMAL (3 snorm8), as KHR_mesh_quantization stores them, without
    /// padding.
    gltfSnorm8 = 7,
    /// 14 bytes, 0.00152: the same as snorm16.
    gltfSnorm16 = 8,
};

/// Bytes of one frame; 0 when `format` is none of the enumerators.
std::size_t frameBytes(FrameFormat format);

/// How far a frame may be from the one that was packed, in degrees.
struct FrameErrorBound {
    double normal_deg = 0;
    double tangent_deg = 0;
};

/// The bounds that packFrames followed by unpackFrames never exceeds. They count against the frame that is packed: the
/// input when it is sound, else what it was mended to. The sign is always exact. Zeros when `format` is none of the
/// enumerators.
FrameErrorBound frameErrorBound(FrameFormat format);

/// Frames mended on the way in, each counted once, by the first cause that applies, in this order.
struct PackReport {
    std::uint64_t bad_normal_count = 0;      ///< N zero or not finite: (0, 0, 1) took its place
    std::uint64_t not_finite_count = 0;      ///< NaN or infinity in the tangent: a basis from N took its place
    std::uint64_t zero_count = 0;            ///< tangent of length 0 (or too small to be normalised): a basis from N
    std::uint64_t parallel_count = 0;        ///< tangent within 1 degree of +N or -N: a basis from N
    std::uint64_t not_unit_count = 0;        ///< length of N or T off by more than 5e-4: made unit
    std::uint64_t not_orthogonal_count = 0;  ///< cosine between N and T beyond 5e-4: T made orthogonal to N
    std::uint64_t bad_sign_count = 0;        ///< sign not exactly +1 or -1: below 0 is taken as -1, all else as +1

    /// All frames that were mended: the sum of the causes.
    [[nodiscard]] std::uint64_t mendedCount() const {
        return bad_normal_count + not_finite_count + zero_count + parallel_count + not_unit_count +
               not_orthogonal_count + bad_sign_count;
    }
};

/// Packs frames, each by itself, into the code next to it. Any input is packed: what is broken is mended and counted.
/// N and T that are off by less than what the report counts are made unit, and T orthogonal to N, without being counted.
///
/// normals   one per frame, unit
/// tangents  one per frame, unit and orthogonal to N; w is the sign, +1 or -1
/// out       exactly frameBytes(format) bytes per frame, without padding, any alignment; not over the inputs
/// Errors: invalidOption (format), countMismatch (tangents, or the size of `out`), nullData, strideTooSmall,
/// misaligned. Nothing is written then. O(frames).
Result<PackReport> packFrames(StridedSpan<const Vec3> normals, StridedSpan<const Vec4> tangents, FrameFormat format,
                              std::span<std::byte> out);

/// Unpacks frames. All bytes are frames: N and T are finite and unit within 5e-7, and w is +1 or -1. T is orthogonal to
/// N within 5e-7 too, but for the formats that store N and T apart (`snorm8Pair`, `snorm16Pair`,
/// `gltfSnorm8`, `gltfSnorm16`): there both are as stored, made unit, as a shader has them; a zero N reads as (0, 0, 1), a zero T as a
/// basis from N. Packing unpacked frames of frame32, frame48, frame64 or oct32 in the same format gives words that
/// unpack to the same frames.
///
/// bytes     exactly frameBytes(format) bytes per frame
/// normals   one per frame, written
/// tangents  one per frame, written; w is the sign
/// Errors: as packFrames. O(frames).
Result<Done> unpackFrames(std::span<const std::byte> bytes, FrameFormat format, StridedSpan<Vec3> normals,
                          StridedSpan<Vec4> tangents);

/// "frame32", "snorm8_pair": the name that options and reports have; "" when `format` is none of the enumerators.
const char* frameFormatName(FrameFormat format);

/// The numbers of written tangents and generated normals.
enum class VectorFormat : std::uint32_t {
    float32 = 0,  ///< the bits that the method gives
    snorm16 = 1,  ///< half the size; KHR_mesh_quantization is declared
    snorm8 = 2,   ///< a quarter; the same
};

}  // namespace tspace
