/* SPDX-License-Identifier: MIT */
/* C API, whole frames (N, T and the sign) in 4 to 16 bytes, with a bound on the error that is never exceeded. Part of
 * tspace/tspace.h, which includes it. See docs/pack.md.
 *
 * All functions are pure, allocate nothing, use one thread, and may be called from any thread at the same time. Their
 * bits are the same on every machine. */
#ifndef TSPACE_TSPACE_PACK_H
#define TSPACE_TSPACE_PACK_H

#include "tspace/tspace.h"

#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* How a frame is stored: tspace/pack.h says the bits. */
typedef uint32_t tspace_FrameFormat;
enum {
    TSPACE_FRAME_FORMAT_FRAME32 = 0,      /* 4 bytes: the whole rotation; N and T within 0.135 degrees */
    TSPACE_FRAME_FORMAT_FRAME48 = 1,      /* 6 bytes: N and an angle; 0.0037 and 0.0042 */
    TSPACE_FRAME_FORMAT_FRAME64 = 2,      /* 8 bytes: the same; 0.0001 and 0.00015 */
    TSPACE_FRAME_FORMAT_OCT32 = 3,        /* 4 bytes: the same, cheapest to decode; 0.15 and 0.165 */
    TSPACE_FRAME_FORMAT_QTANGENT64 = 4,   /* 8 bytes: a quaternion of snorm16, its w has the sign; 0.004 */
    TSPACE_FRAME_FORMAT_SNORM8_PAIR = 5,  /* 8 bytes: T, 1, N, sign as snorm8; 0.391 */
    TSPACE_FRAME_FORMAT_SNORM16_PAIR = 6, /* 16 bytes: the same as snorm16; 0.00152 */
    TSPACE_FRAME_FORMAT_GLTF_SNORM8 = 7,  /* 7 bytes: T, sign, N as snorm8; 0.391 */
    TSPACE_FRAME_FORMAT_GLTF_SNORM16 = 8  /* 14 bytes: the same as snorm16; 0.00152 */
};

/* Bytes of one frame; 0 when `format` is none of the above. */
size_t tspace_frameBytes(tspace_FrameFormat format) TSPACE_NOEXCEPT;

/* Frames mended on the way in, each counted once, by the first cause that applies, in this order. */
typedef struct tspace_PackReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t bad_normal_count;     /* N zero or not finite: (0, 0, 1) took its place */
    uint64_t not_finite_count;     /* NaN or infinity in the tangent: a basis from N took its place */
    uint64_t zero_count;           /* tangent of length 0: a basis from N */
    uint64_t parallel_count;       /* tangent within 1 degree of +N or -N: a basis from N */
    uint64_t not_unit_count;       /* length of N or T off by more than 5e-4: made unit */
    uint64_t not_orthogonal_count; /* cosine between N and T beyond 5e-4: T made orthogonal to N */
    uint64_t bad_sign_count;       /* sign not exactly +1 or -1: below 0 is taken as -1, all else as +1 */
    uint64_t mended_count;         /* the sum of them */
} tspace_PackReport;

/* Packs frames. Any input is packed: what is broken is mended and counted.
 * normals   3 floats per frame, unit
 * tangents  4 floats per frame, unit and orthogonal to N; the fourth is the sign, +1 or -1
 * out       exactly tspace_frameBytes(format) bytes per frame, any alignment; not null unless there are no frames
 * report    may be null
 * error     may be null
 * Errors: INVALID_OPTION (format), COUNT_MISMATCH (tangents, or out_bytes), NULL_DATA, STRIDE_TOO_SMALL, MISALIGNED.
 * Nothing is written then. O(frames). */
tspace_ErrorCode tspace_packFrames(tspace_FrameFormat format, tspace_ConstSpan normals, tspace_ConstSpan tangents,
                                   void* out, size_t out_bytes, tspace_PackReport* report,
                                   tspace_Error* error) TSPACE_NOEXCEPT;

/* Unpacks frames. Any bytes are frames: N and T are finite and unit, the sign is +1 or -1.
 * bytes     exactly tspace_frameBytes(format) bytes per frame
 * normals   3 floats per frame, written
 * tangents  4 floats per frame, written
 * error     may be null
 * Errors: as tspace_packFrames. O(frames). */
tspace_ErrorCode tspace_unpackFrames(tspace_FrameFormat format, const void* bytes, size_t byte_count,
                                     tspace_Span normals, tspace_Span tangents, tspace_Error* error) TSPACE_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
