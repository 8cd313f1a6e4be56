/* SPDX-License-Identifier: MIT */
/* Mends the winding of faces: those that are wound against their neighbours, and whole parts that are inside out.
 * In C: part of tspace/tspace.h, which includes it. */
#include "tspace/tspace_tangents.h"

#ifndef TSPACE_TSPACE_WINDING_H
#define TSPACE_TSPACE_WINDING_H

#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

typedef struct tspace_WindingOptions {
    uint32_t struct_size;
    /* Its handedness and winding say which order of corners is right as seen from outside; the default is glTF's. */
    tspace_Convention convention;
    /* 0 or 1. 1: the mesh's normals, where it has some, say which side of a component is out, if they agree among
     * themselves. Default: 1. */
    uint32_t use_normals;
    /* 0 or 1. 1: vertices at the same position are one point (so a mesh without indices is a surface); 0: only equal
     * indices are. Default: 1. */
    uint32_t weld_positions;
    /* With `weld_positions`: positions that differ by no more than this in each coordinate are one, as for normals.
     * 0, the default: only equal positions are. -1: by the spacing of floats, as there. */
    float weld_distance;
} tspace_WindingOptions;

/* In C: prepares options as TSPACE_INIT does, for languages that have no macros.
 * struct_size  bytes of the struct as the caller declares it. One that this version does not know is INVALID_OPTION, and
 *              nothing is written.
 * Zeros, the convention's too, are refused (INVALID_OPTION of whatever takes the options). For use_normals and
 * weld_positions both 0 set a convention, by tspace_findConvention.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initWindingOptions(tspace_WindingOptions* options, uint32_t struct_size,
                                           tspace_Error* error) TSPACE_NOEXCEPT;

/* What was found and done. A *component* is what hangs together over pairs of faces at edges. A pair is in
 * *conflict* where both faces run through their edge in the same direction. */
typedef struct tspace_WindingReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t face_count;   /* faces with at least 3 corners */
    uint64_t turned_count; /* faces to be turned */
    uint64_t conflict_count_before;
    uint64_t conflict_count_after; /* as if the faces had been turned */
    uint64_t component_count;
    uint64_t turned_component_count; /* of which more than half of the faces are turned */

    uint64_t by_normals_count; /* by normals of the mesh */
    uint64_t by_volume_count;  /* closed: the volume is positive */
    /* Closed, and lying in another one: as most of the area was wound, or, if that says nothing, a cavity. */
    uint64_t by_nesting_count;
    uint64_t by_winding_number_count; /* open, but with an inside: the winding number on its own faces */
    uint64_t by_majority_count;       /* open, and no side is inside: as most of the area was wound */
    /* Fewer than 4 faces, such as leaves and cards: nothing is turned, since nothing says what is right. */
    uint64_t small_count;
    /* Turning some faces would leave as many conflicts as there are, as on a Moebius band: none is turned, or all,
     * where the component is open and its winding number says that it is inside out. */
    uint64_t one_sided_count;
} tspace_WindingReport;

/* Says which faces to turn (to reverse the order of their corners) so that neighbours are wound alike and the
 * outside is where the convention wants it.
 *
 * Faces are paired at the edges that they share. Where more than two meet, those that share the edge by their
 * indices are paired if they are two; others are sorted as they turn about the edge, and neighbours in that order
 * are paired, of the two ways to do so the one with the smaller gaps; of an odd number only the two that lie
 * straightest. Pairs by turn that contradict the others are none. Faces that lie on one another keep the winding
 * that they have to each other: both sides of a sheet stay so.
 * Each component is wound alike in itself, and then decided as a whole, by the first of the rules in
 * tspace_WindingReport that applies. Nothing else about it is known: an open surface without an inside, such as a
 * terrain, that is wholly inside out and has no normals stays so.
 *
 * mesh       positions and indices, and normals where options.use_normals; UVs are not looked at
 * turned     one per face: 1 to turn it, else 0; must not overlap the inputs
 * execution  threads and memory; changes no bit
 * Errors: those of tspace_validate; COUNT_MISMATCH (turned), OUT_OF_MEMORY.
 * O(corners) but for sorting the edges of one point and, where closed components lie in one another, O(n log n).
 * Scratch memory: 16 bytes per corner, 32 per face and 28 per vertex, and where closed components lie in one another
 * 50 per face more. Thread-safe; same bits for any thread count.
 * In C: `turned` has face_count bytes. */
tspace_ErrorCode tspace_mendWinding(const tspace_Mesh* mesh, const tspace_WindingOptions* options, uint8_t* turned,
                                    size_t turned_count, const tspace_Execution* execution,
                                    tspace_WindingReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* For TSPACE_INIT: the defaults that are not zero. */
static inline void tspace_setWindingDefaults(tspace_WindingOptions* options) {
    options->use_normals = 1;
    options->weld_positions = 1;
}

#ifdef __cplusplus
}

inline void tspace_setDefaults(tspace_WindingOptions* options) noexcept { tspace_setWindingDefaults(options); }
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
