/* SPDX-License-Identifier: MIT */
/* Whole frames (N, T and the sign) in 4 to 16 bytes, with a bound on the error that is never exceeded.
 * All functions are pure, allocate nothing, use one thread, and may be called from any thread at the same time.
 * Their bits are the same on every machine: arithmetic and square roots alone, in a fixed order. See
 * docs/concepts/pack.md.
 * In C: part of tspace/tspace.h, which includes it. */
#ifndef TSPACE_TSPACE_PACK_H
#define TSPACE_TSPACE_PACK_H

#include "tspace/tspace_tangents.h"

#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* How a frame is stored, and how far N and T may be off (tspace_frameErrorBound), in degrees. Numbers are
 * little-endian; "word" is all bytes of one frame as one unsigned number. The enumerators' values are stable and
 * never reused. */
typedef uint32_t tspace_FrameFormat;
enum {
    /* 4 bytes, 0.135: (rotation << 1) | mirrored. The rotation is a cell of a lattice in one of 24 charts. */
    TSPACE_FRAME_FORMAT_FRAME32 = 0,
    /* 6 bytes, N 0.0037 and T 0.0042: ((i * 46339 + j) << 17) | (angle << 1) | mirrored; i, j on a warped
     * octahedron, 65,536 angles. */
    TSPACE_FRAME_FORMAT_FRAME48 = 1,
    /* 8 bytes, N 0.0001 and T 0.00015: i:21 | j:21 | angle:21 | mirrored:1 from the top; as frame48, finer. */
    TSPACE_FRAME_FORMAT_FRAME64 = 2,
    /* 4 bytes, N 0.15 and T 0.165: i:10 | j:10 | angle:11 | mirrored:1 from the top; the cheapest to decode of the
     * codes of 4 bytes. */
    TSPACE_FRAME_FORMAT_OCT32 = 3,
    /* 8 bytes, 0.004: the quaternion x, y, z, w of the rotation (T, N x T, N) as snorm16; w is never 0, its sign is
     * the sign. */
    TSPACE_FRAME_FORMAT_QTANGENT64 = 4,
    /* 8 bytes, 0.391: T.xyz, 127, N.xyz, sign as snorm8: the order of Unreal's TangentX and TangentZ. */
    TSPACE_FRAME_FORMAT_SNORM8_PAIR = 5,
    TSPACE_FRAME_FORMAT_SNORM16_PAIR = 6, /* 16 bytes, 0.00152: the same as snorm16. */
    /* 7 bytes, 0.391: TANGENT (4 snorm8), then NORMAL (3 snorm8), as KHR_mesh_quantization stores them, without
     * padding. */
    TSPACE_FRAME_FORMAT_GLTF_SNORM8 = 7,
    TSPACE_FRAME_FORMAT_GLTF_SNORM16 = 8 /* 14 bytes, 0.00152: the same as snorm16. */
};

/* Bytes of one frame; 0 when `format` is none of the enumerators. */
size_t tspace_frameBytes(tspace_FrameFormat format) TSPACE_NOEXCEPT;

/* How far a frame may be from the one that was packed, in degrees. */
typedef struct tspace_FrameErrorBound {
    double normal_deg;
    double tangent_deg;
} tspace_FrameErrorBound;

/* The bounds that tspace_packFrames followed by tspace_unpackFrames never exceeds. They count against the frame that
 * is packed: the input when it is sound, else what it was mended to. The sign is always exact. Zeros when `format`
 * is none of the enumerators. */
tspace_FrameErrorBound tspace_frameErrorBound(tspace_FrameFormat format) TSPACE_NOEXCEPT;

/* Frames mended on the way in, each counted once, by the first cause that applies, in this order. */
typedef struct tspace_PackReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t bad_normal_count;     /* N zero or not finite: (0, 0, 1) took its place */
    uint64_t not_finite_count;     /* NaN or infinity in the tangent: a basis from N took its place */
    uint64_t zero_count;           /* tangent of length 0 (or too small to be normalised): a basis from N */
    uint64_t parallel_count;       /* tangent within 1 degree of +N or -N: a basis from N */
    uint64_t not_unit_count;       /* length of N or T off by more than 5e-4: made unit */
    uint64_t not_orthogonal_count; /* cosine between N and T beyond 5e-4: T made orthogonal to N */
    uint64_t bad_sign_count;       /* sign not exactly +1 or -1: below 0 is taken as -1, all else as +1 */
    uint64_t mended_count;         /* All frames that were mended: the sum of the causes. */
} tspace_PackReport;

/* Packs frames, each by itself, into the code next to it. Any input is packed: what is broken is mended and counted.
 * N and T that are off by less than what the report counts are made unit, and T orthogonal to N, without being
 * counted.
 *
 * normals   3 floats each: one per frame, unit
 * tangents  4 floats each: one per frame, unit and orthogonal to N; w is the sign, +1 or -1
 * out       exactly tspace_frameBytes(format) bytes per frame, without padding, any alignment; not over the inputs
 * Errors: INVALID_OPTION (format), COUNT_MISMATCH (tangents, or the size of `out`), NULL_DATA, STRIDE_TOO_SMALL,
 * MISALIGNED. Nothing is written then. O(frames).
 * In C: out may be null when there are no frames. */
tspace_ErrorCode tspace_packFrames(tspace_ConstSpan normals, tspace_ConstSpan tangents, tspace_FrameFormat format,
                                   void* out, size_t out_bytes, tspace_PackReport* report,
                                   tspace_Error* error) TSPACE_NOEXCEPT;

/* Unpacks frames. All bytes are frames: N and T are finite and unit within 5e-7, and w is +1 or -1. T is orthogonal
 * to N within 5e-7 too, but for the formats that store N and T apart (TSPACE_FRAME_FORMAT_SNORM8_PAIR,
 * TSPACE_FRAME_FORMAT_SNORM16_PAIR, TSPACE_FRAME_FORMAT_GLTF_SNORM8, TSPACE_FRAME_FORMAT_GLTF_SNORM16): there both
 * are as stored, made unit, as a shader has them; a zero N reads as (0, 0, 1), a zero T as a basis from N. Packing
 * unpacked frames of frame32, frame48, frame64 or oct32 in the same format gives words that unpack to the same
 * frames.
 *
 * bytes     exactly tspace_frameBytes(format) bytes per frame
 * normals   3 floats each: one per frame, written
 * tangents  4 floats each: one per frame, written; w is the sign
 * Errors: as tspace_packFrames. O(frames). */
tspace_ErrorCode tspace_unpackFrames(const void* bytes, size_t byte_count, tspace_FrameFormat format,
                                     tspace_Span normals, tspace_Span tangents, tspace_Error* error) TSPACE_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
