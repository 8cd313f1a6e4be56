/* SPDX-License-Identifier: MIT */
/* The usual case in one call: an indexed mesh in, an indexed mesh with normals and tangents out.
 * In C: and its parts, which mend tangents and split vertices. Part of tspace/tspace.h, which includes it. */
#ifndef TSPACE_TSPACE_INDEXED_FRAMES_H
#define TSPACE_TSPACE_INDEXED_FRAMES_H

#include "tspace/tspace_normals.h"
#include "tspace/tspace_tangents.h"

#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

typedef struct tspace_SanitizeOptions {
    uint32_t struct_size;
    /* 0 or 1. Also make every sound tangent unit and orthogonal to N. Off by default: the result then no longer
     * matches a bake made with the method's own tangents (quantised normals are not unit, so the reference's
     * tangents can be off by up to a degree there). */
    uint32_t orthogonalize_all;
} tspace_SanitizeOptions;

/* In C: prepares options as TSPACE_INIT does, for languages that have no macros.
 * struct_size  bytes of the struct as the caller declares it. One that this version does not know is INVALID_OPTION, and
 *              nothing is written.
 * Zeros, but for the size, are the defaults.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initSanitizeOptions(tspace_SanitizeOptions* options, uint32_t struct_size,
                                            tspace_Error* error) TSPACE_NOEXCEPT;

/* Corners mended, by cause (the first that applies, in this order) and by cure. */
typedef struct tspace_SanitizeReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t not_finite_count;     /* NaN or infinity in the tangent */
    uint64_t zero_count;           /* length 0 (or too small to be normalised) */
    uint64_t not_unit_count;       /* length off by more than 5e-4 (the glTF validator's tolerance) */
    uint64_t parallel_count;       /* within 1 degree of +N or -N: no frame can be built */
    uint64_t bad_sign_count;       /* sign not exactly +1 or -1 */
    uint64_t mixed_sign_count;     /* sign changed because the face's corners disagreed */
    uint64_t orthogonalized_count; /* sound ones changed by orthogonalize_all */
    uint64_t normalized_count;     /* cure: own direction, made unit and orthogonal to N */
    uint64_t from_neighbor_count;  /* cure: direction taken from a sound corner of the same face or position */
    uint64_t from_basis_count;     /* cure: basis from N alone (Duff et al. 2017) */
    uint64_t bad_normal_count;     /* corners whose N is zero or not finite: only a unit tangent is promised */
    uint64_t mended_count;         /* All corners that were written: the sum of the causes. */
    /* exactly (1, 0, 0), and not in the plane across N.
     * In C: comes after parallel_count. */
    uint64_t placeholder_count;
} tspace_SanitizeReport;

/* Mends tangents in place. A tangent is broken when it is not finite, zero, not unit (beyond 5e-4), within 1 degree
 * of +-N, a placeholder that leans out of the surface, when its sign is not +-1, or when the signs inside its face
 * differ. What is written is unit and orthogonal to the corner's N (normalised) within 1e-6, with sign +1 or -1.
 * Sound tangents keep every bit.
 *
 * Placeholder: the reference gives exactly (1, 0, 0) to corners around which no triangle has UV area, wherever N
 * points. What UVs give has been projected along N, so that with these bits it lies in the plane.
 *
 * Cures, in this order: the tangent's own direction, when it has one that is not parallel to N; the tangent of the
 * first sound corner of the same face; of the first sound corner at the same position (in corner order); a basis
 * from N. Signs inside a face: the majority of the sound corners decides, of those whose N has a direction where
 * there are any; on a tie, the first of them. Where N has none, corners at one position that get a tangent from
 * elsewhere get that of the first of them with their sign.
 * The result does not depend on how vertices are indexed, so mending a split mesh again changes nothing.
 *
 * mesh       positions and normals; UVs are not looked at
 * tangents   4 floats each: one per corner, read and written; corners of faces with fewer than 3 corners are left
 *            alone
 * execution  threads and memory; changes no bit
 * Errors: those of tspace_validate; MISSING_ATTRIBUTE (normals), COUNT_MISMATCH, NULL_DATA, OUT_OF_MEMORY.
 * O(corners). Thread-safe; same bits for any thread count. */
tspace_ErrorCode tspace_sanitizeTangents(const tspace_Mesh* mesh, const tspace_SanitizeOptions* options,
                                         tspace_Span tangents, const tspace_Execution* execution,
                                         tspace_SanitizeReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* One attribute given per corner, as `component_count` floats. */
typedef struct tspace_CornerAttribute {
    const float* data;        /* In C: not null unless there are no corners. */
    size_t stride_bytes;      /* from corner to corner; at least 4 * component_count. In C: 0 means tightly packed. */
    uint32_t component_count; /* 1..16 */
    /* 0: corners are equal only when all bits are. Above 0: equal when every component differs by at most this from
     * the first corner that got the vertex (so float noise does not split); NaN equals nothing but its own bits. */
    float tolerance;
} tspace_CornerAttribute;

/* Marks a vertex that no corner uses. */
#define TSPACE_NO_CORNER UINT32_MAX

/* The new index buffer and where each new vertex comes from.
 * In C: made by the library; later versions may append fields. */
typedef struct tspace_SplitResult {
    const uint32_t* indices; /* one per corner: the new vertex */
    size_t corner_count;
    /* One per new vertex: the old vertex that it copies. The first `old vertex count` entries are 0, 1, 2, ...: old
     * vertices keep their place, copies are appended. Gather every vertex attribute, skin weight and morph target
     * through it. */
    const uint32_t* source_vertices;
    /* One per new vertex: the corner whose attribute values belong to it, or TSPACE_NO_CORNER when no corner uses
     * it. */
    const uint32_t* source_corners;
    size_t vertex_count;
} tspace_SplitResult;

/* Splits vertices whose corners disagree in any of the attributes.
 *
 * The first corner (in corner order) of an old vertex keeps the vertex; each corner that equals none of the vertex's
 * earlier variants gets a copy, appended in corner order. Deterministic.
 *
 * indices       the old vertex of each corner (TSPACE_INDEX_NONE: corner c uses vertex c)
 * vertex_count  number of old vertices
 * corner_count  length of every attribute; equals the count of `indices` unless there are none
 * execution     threads; scratch memory is only needed where a vertex becomes more than 8
 * Errors: NULL_DATA, COUNT_MISMATCH, INDEX_OUT_OF_RANGE, STRIDE_TOO_SMALL, TOO_LARGE, INVALID_OPTION, OUT_OF_MEMORY.
 * O(corners) expected, exact or tolerant. Thread-safe; same result for any thread count.
 * In C: indices and execution may be null: none, and the default. So may attributes, when attribute_count is 0. *result
 * is null after an error. Free it with tspace_destroySplitResult. It holds 4 bytes per corner and 8 per new vertex. */
tspace_ErrorCode tspace_splitVertices(const tspace_Indices* indices, size_t vertex_count, size_t corner_count,
                                      const tspace_CornerAttribute* attributes, size_t attribute_count,
                                      const tspace_Execution* execution, tspace_SplitResult** result,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* Frees a result of tspace_splitVertices. Null is allowed. */
void tspace_destroySplitResult(tspace_SplitResult* result) TSPACE_NOEXCEPT;

/* How tspace_makeIndexedFrames works. */
typedef struct tspace_IndexedFramesOptions {
    uint32_t struct_size;
    uint32_t make_normals; /* 0 or 1. Also where the mesh has normals; they are made anyway where it has none */
    /* 0 or 1. Mend tangents that are not finite, zero, not unit, parallel to N, or of mixed sign inside a face.
     * Default: 1. */
    uint32_t sanitize;
    uint32_t orthogonalize_all; /* 0 or 1. As tspace_SanitizeOptions.orthogonalize_all */
    /* Its convention must be set; it also says which side of a face is out.
     * Results are per corner (`domain`): the split makes vertices of them.
     * In C: not null. */
    const tspace_TangentOptions* tangents;
    /* Where normals are made. Its convention is not looked at: that of `tangents` counts.
     * In C: null: the defaults. */
    const tspace_NormalOptions* normals;
    /* Further attributes, one entry per corner, that must not be shared: corners that disagree get a vertex each.
     * Only a mesh without indices needs it, for what hangs on its vertices beside position, normal and UV. */
    const tspace_CornerAttribute* keep_apart;
    size_t keep_apart_count;
} tspace_IndexedFramesOptions;

/* In C: prepares options as TSPACE_INIT does, for languages that have no macros.
 * struct_size  bytes of the struct as the caller declares it. One that this version does not know is INVALID_OPTION, and
 *              nothing is written.
 * Zeros are refused, since `tangents` has no convention then; with options there, they mean that nothing is mended.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initIndexedFramesOptions(tspace_IndexedFramesOptions* options, uint32_t struct_size,
                                                 tspace_Error* error) TSPACE_NOEXCEPT;

/* A mesh with the faces of the given one. Gather every other vertex attribute, skin weight and morph target through
 * source_vertices, and attributes that have an index list of their own through the corner:
 * their_indices[source_corners[v]].
 * In C: made by the library; later versions may append fields. */
typedef struct tspace_IndexedFrames {
    const uint32_t* indices; /* one per corner: the new vertex */
    size_t corner_count;
    const uint32_t* source_vertices; /* one per new vertex: the entry of `positions` that it copies */
    /* One per new vertex: the first corner that uses it, or TSPACE_NO_CORNER where none does. */
    const uint32_t* source_corners;
    /* 3 floats each: one per new vertex: those of the mesh (see tspace_TangentOptions.normalize_normals), or the
     * ones made */
    const float* normals;
    const float* tangents; /* 4 floats each: one per new vertex: unit tangent and sign */
    size_t vertex_count;
    const tspace_NormalReport* normal_report; /* null where normals were not made */
    const tspace_TangentReport* tangent_report;
    const tspace_SanitizeReport* sanitize_report;
} tspace_IndexedFrames;

/* Makes normals where they are missing or asked for (tspace_generateNormals), tangents (tspace_generateTangents),
 * mends those that are broken (tspace_sanitizeTangents), and splits vertices whose corners disagree in either
 * (tspace_splitVertices). Each corner has the tangent that these calls give it, bit for bit.
 *
 * A mesh with one index list keeps its vertices in their places, also those that no corner uses (which get a frame
 * from their normal), and copies come behind them. A mesh without indices, or with an index list per attribute, gets
 * new vertices in the order in which corners first use them, one for all corners with the same bits of position,
 * normal, UV, tangent and `keep_apart` (the zeros of a position are equal, as they are for normals).
 *
 * mesh       positions; normals or none; UVs (all methods but TSPACE_METHOD_BASIS)
 * execution  threads and memory of all steps; changes no bit
 * Errors: those of the four calls. O(corners) expected. Thread-safe; same bits for any thread count.
 * In C: *frames is null after an error. Free it with tspace_destroyIndexedFrames. */
tspace_ErrorCode tspace_makeIndexedFrames(const tspace_Mesh* mesh, const tspace_IndexedFramesOptions* options,
                                          const tspace_Execution* execution, tspace_IndexedFrames** frames,
                                          tspace_Error* error) TSPACE_NOEXCEPT;

/* Frees a result of tspace_makeIndexedFrames. Null is allowed. */
void tspace_destroyIndexedFrames(tspace_IndexedFrames* frames) TSPACE_NOEXCEPT;

/* For TSPACE_INIT: the default that is not zero. */
static inline void tspace_setIndexedFramesDefaults(tspace_IndexedFramesOptions* options) { options->sanitize = 1; }

#ifdef __cplusplus
}

inline void tspace_setDefaults(tspace_IndexedFramesOptions* options) noexcept {
    tspace_setIndexedFramesDefaults(options);
}
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
