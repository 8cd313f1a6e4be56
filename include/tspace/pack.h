// SPDX-License-Identifier: MIT
// Packing of whole frames (N, T and the sign) into 4 to 16 bytes, with a guaranteed error bound. All functions are
// pure, allocate nothing, use one thread, and may be called from any thread at the same time. Their bits are equal on
// every machine: only arithmetic and square roots, in a fixed order. See docs/concepts/pack.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "tspace/result.h"
#include "tspace/span.h"

namespace tspace {

/// Storage format of a frame, with the maximum error of N and T (frameErrorBound) in degrees. Numbers are
/// little-endian; "word" means all bytes of one frame as one unsigned number. The enumerators' values are stable and
/// never reused.
enum class FrameFormat : std::uint32_t {
    /// 4 bytes, 0.135: (rotation << 1) | mirrored. The rotation is a cell of a lattice in one of 24 charts.
    frame32 = 0,
    /// 6 bytes, N 0.0037 and T 0.0042: ((i * 46339 + j) << 17) | (angle << 1) | mirrored; i, j on a warped
    /// octahedron, 65,536 angles.
    frame48 = 1,
    /// 8 bytes, N 0.0001 and T 0.00015: i:21 | j:21 | angle:21 | mirrored:1 from the top; like frame48, but finer.
    frame64 = 2,
    /// 4 bytes, N 0.15 and T 0.165: i:10 | j:10 | angle:11 | mirrored:1 from the top; the 4-byte format that is
    /// cheapest to decode.
    oct32 = 3,
    /// 8 bytes, 0.004: the quaternion x, y, z, w of the rotation (T, N x T, N) as snorm16; w is never 0, and its sign
    /// is the sign of the frame.
    qtangent64 = 4,
    /// 8 bytes, 0.391: T.xyz, 127, N.xyz, sign as snorm8: the order of Unreal's TangentX and TangentZ.
    snorm8Pair = 5,
    /// 16 bytes, 0.00152: like `snorm8Pair`, but as snorm16.
    snorm16Pair = 6,
    /// 7 bytes, 0.391: TANGENT (4 snorm8), then NORMAL (3 snorm8), as KHR_mesh_quantization stores them, without
    /// padding.
    gltfSnorm8 = 7,
    /// 14 bytes, 0.00152: like `gltfSnorm8`, but as snorm16.
    gltfSnorm16 = 8,
};

/// Returns the number of bytes of one frame; 0 if `format` is not an enumerator.
std::size_t frameBytes(FrameFormat format);

/// Maximum angle between an unpacked frame and the frame that was packed, in degrees.
struct FrameErrorBound {
    double normal_deg = 0;
    double tangent_deg = 0;
};

/// Returns bounds that packFrames followed by unpackFrames never exceeds. They refer to the packed frame: the input if
/// it is valid, otherwise its repaired value. The sign is always exact. Returns zeros if `format` is not an enumerator.
FrameErrorBound frameErrorBound(FrameFormat format);

/// Frames repaired before packing. Each is counted once, by the first cause that applies, in this order.
struct PackReport {
    std::uint64_t bad_normal_count = 0;  ///< N zero or not finite: replaced by (0, 0, 1)
    std::uint64_t not_finite_count = 0;  ///< NaN or infinity in the tangent: replaced by a basis from N
    std::uint64_t zero_count = 0;      ///< tangent of length 0 (or too small to normalize): replaced by a basis from N
    std::uint64_t parallel_count = 0;  ///< tangent within 1 degree of +N or -N: replaced by a basis from N
    std::uint64_t not_unit_count = 0;  ///< length of N or T off by more than 5e-4: normalized
    std::uint64_t not_orthogonal_count = 0;  ///< cosine between N and T beyond 5e-4: T made orthogonal to N
    std::uint64_t bad_sign_count = 0;        ///< sign not exactly +1 or -1: below 0 becomes -1, other values +1

    /// Returns the number of repaired frames: the sum of the causes.
    [[nodiscard]] std::uint64_t mendedCount() const {
        return bad_normal_count + not_finite_count + zero_count + parallel_count + not_unit_count +
               not_orthogonal_count + bad_sign_count;
    }
};

/// Packs frames independently of each other, each to the nearest code. Accepts any input: invalid frames are repaired
/// and counted. Smaller deviations than those that the report counts are normalized and orthogonalized without being
/// counted.
///
/// normals   one per frame, unit
/// tangents  one per frame, unit and orthogonal to N; w is the sign, +1 or -1
/// out       exactly frameBytes(format) bytes per frame, without padding, any alignment; must not overlap the inputs
/// Errors: invalidOption (format), countMismatch (tangents, or the size of `out`), nullData, strideTooSmall,
/// misaligned. On error nothing is written. O(frames).
Result<PackReport> packFrames(StridedSpan<const Vec3> normals, StridedSpan<const Vec4> tangents, FrameFormat format,
                              std::span<std::byte> out);

/// Unpacks frames. All byte values are valid: N and T are finite and unit within 5e-7, and w is +1 or -1. T is also
/// orthogonal to N within 5e-7, except for formats that store N and T separately (`snorm8Pair`, `snorm16Pair`,
/// `gltfSnorm8`, `gltfSnorm16`): these return the stored vectors, normalized, as a shader does. A zero N becomes (0, 0,
/// 1), a zero T a basis from N. Packing unpacked frames of frame32, frame48, frame64 or oct32 again in the same format
/// gives words that unpack to the same frames.
///
/// bytes     exactly frameBytes(format) bytes per frame
/// normals   one per frame, written
/// tangents  one per frame, written; w is the sign
/// Errors: as packFrames. O(frames).
Result<Done> unpackFrames(std::span<const std::byte> bytes, FrameFormat format, StridedSpan<Vec3> normals,
                          StridedSpan<Vec4> tangents);

/// Returns the name used in options and reports ("frame32", "snorm8_pair"); "" if `format` is not an enumerator.
const char* frameFormatName(FrameFormat format);

/// Component type of written tangents and generated normals.
enum class VectorFormat : std::uint32_t {
    float32 = 0,  ///< exact result of the method
    snorm16 = 1,  ///< half the size; declares KHR_mesh_quantization
    snorm8 = 2,   ///< a quarter of the size; declares KHR_mesh_quantization
};

}  // namespace tspace
