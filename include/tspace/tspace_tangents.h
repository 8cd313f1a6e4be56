/* SPDX-License-Identifier: MIT */
/* Meshes, conventions, errors, execution, and tangents.
 * In C: part of tspace/tspace.h, which programs include: TSPACE_INIT needs all parts. */
#ifndef TSPACE_TSPACE_TANGENTS_H
#define TSPACE_TSPACE_TANGENTS_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "tspace/version.h"

/* Exported by shared libraries, whose other symbols are hidden. */
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
#define TSPACE_NOEXCEPT noexcept
extern "C" {
#else
#define TSPACE_NOEXCEPT
#endif

/* Prepares a sized struct, from its size and the defaults of this header: tspace_TangentOptions options;
 * TSPACE_INIT(options); */
#define TSPACE_INIT(object)                                                                               \
    ((void)memset(&(object), 0, sizeof(object)), (void)((object).struct_size = (uint32_t)sizeof(object)), \
     TSPACE_SET_DEFAULTS(object))

/* Version of the library that is linked: 10000 * major + 100 * minor + patch. TSPACE_VERSION_NUMBER is that
 * of the headers. */
uint32_t tspace_version(void) TSPACE_NOEXCEPT;

/* Why a call failed. The numbers are stable, the same in C and C++, and never reused. */
typedef uint32_t tspace_ErrorCode;
enum {
    TSPACE_OK = 0,                   /* not an error */
    TSPACE_ERROR_NULL_DATA = 1,      /* a pointer is null although it is needed, or its count is not zero */
    TSPACE_ERROR_COUNT_MISMATCH = 2, /* two arrays that must have the same length do not */
    /* an index is not smaller than the number of vertices; `element` is its position */
    TSPACE_ERROR_INDEX_OUT_OF_RANGE = 3,
    TSPACE_ERROR_STRIDE_TOO_SMALL = 4, /* elements of a span would overlap */
    TSPACE_ERROR_MISALIGNED = 5,       /* a pointer or stride is not a multiple of its element's alignment */
    TSPACE_ERROR_TOO_LARGE = 6, /* a size does not fit: the sum of face sizes, or a limit stated by the function */
    /* the method needs an attribute (normals, UVs) that the mesh does not have */
    TSPACE_ERROR_MISSING_ATTRIBUTE = 7,
    /* an option has a value outside its stated range.
     * In C: or a struct has an unknown size. */
    TSPACE_ERROR_INVALID_OPTION = 8,
    TSPACE_ERROR_OUT_OF_MEMORY = 9,  /* the allocator returned null */
    TSPACE_ERROR_PLAN_MISMATCH = 10, /* arrays do not fit the plan they are evaluated with */
    TSPACE_ERROR_INTERNAL = 11,      /* a defect of tspace; please report it */
    /* the caller ended the call from a function of its own; nothing was made or written */
    TSPACE_ERROR_CANCELLED = 12,
    TSPACE_ERROR_INVALID_FILE = 100, /* asset layer: the file breaks its format; the error says where */
    /* asset layer: valid, but needs a feature that this version does not have */
    TSPACE_ERROR_UNSUPPORTED_FILE = 101,
    TSPACE_ERROR_FORBIDDEN_PATH = 102, /* asset layer: a URI leads outside the model's folder */
    TSPACE_ERROR_CANNOT_READ = 103,    /* asset layer: a file cannot be opened or read */
    TSPACE_ERROR_CANNOT_WRITE = 104    /* asset layer: a file cannot be written; nothing was changed */
};

/* Element of an error that is about no element in particular. */
#define TSPACE_NO_ELEMENT UINT64_MAX

/* What went wrong, in words for the person who has to mend it, and where.
 * In C: the layout of this struct never changes. */
typedef struct tspace_Error {
    tspace_ErrorCode code;
    uint32_t reserved; /* 0 */
    uint64_t element;  /* index of the offending element, or TSPACE_NO_ELEMENT */
    char message[240]; /* one sentence, no line break. In C: UTF-8, ended by 0; cut when it is longer. */
} tspace_Error;

/* Stable identifier of a code in lowerCamelCase, for logs and JSON ("indexOutOfRange"); "unknown" for other numbers.
 * Static memory. */
const char* tspace_errorName(tspace_ErrorCode code) TSPACE_NOEXCEPT;

/* `count` elements of T, the first at `data`, each `stride_bytes` after the one before. Owns nothing.
 * `data` may be null only when `count` is 0. Functions that take a span check at their border that the stride is at
 * least sizeof(T) (when there are two or more elements) and a multiple of alignof(T).
 * In C: T is as many floats as is said where the span is used. stride_bytes 0: tightly packed. */
typedef struct tspace_ConstSpan {
    const float* data;
    size_t count;
    size_t stride_bytes;
} tspace_ConstSpan;

/* The same for results. */
typedef struct tspace_Span {
    float* data;
    size_t count;
    size_t stride_bytes;
} tspace_Span;

/* The same for results that are one byte each. stride_bytes 0: tightly packed. */
typedef struct tspace_ByteSpan {
    uint8_t* data;
    size_t count;
    size_t stride_bytes;
} tspace_ByteSpan;

/* Bytes of one index. */
typedef uint32_t tspace_IndexType;
enum {
    TSPACE_INDEX_NONE = 0,
    TSPACE_INDEX_U8 = 1,
    TSPACE_INDEX_U16 = 2,
    TSPACE_INDEX_U32 = 4,
    /* for tspace_Mesh.normal_indices and uv_indices: corner c uses entry c, without a list in memory */
    TSPACE_INDEX_CORNERS = 8
};

/* Tightly packed indices, one per corner. With TSPACE_INDEX_NONE, corner c uses vertex c.
 * In C: data is null and count is 0 for TSPACE_INDEX_NONE and TSPACE_INDEX_CORNERS. */
typedef struct tspace_Indices {
    const void* data;
    size_t count;
    tspace_IndexType type;
} tspace_Indices;

/* Most corners (and so vertices and indices) that one mesh may have: corner ids are 32 bit with room for marks. */
#define TSPACE_MAX_CORNERS 0x7fffffff

/* A mesh. Only positions are always needed; each function says what else it uses. Positions are floats: of doubles
 * far from the origin (metres of a map) subtract an offset in double first, such as the middle of the model, and put
 * it into the model's place; normals and tangents do not depend on it. */
typedef struct tspace_Mesh {
    uint32_t struct_size;
    uint32_t face_size;         /* corners of every face when face_sizes is empty; at least 1. In C: 0 means 3. */
    tspace_ConstSpan positions; /* 3 floats each: one per vertex */
    /* 3 floats each: one per vertex, used as given (see tspace_TangentOptions.normalize_normals), or empty */
    tspace_ConstSpan normals;
    tspace_ConstSpan uvs;   /* 2 floats each: one per vertex, or empty */
    tspace_Indices indices; /* one per corner, or TSPACE_INDEX_NONE: every corner has its own vertex */
    /* Corners of each face. Empty: all faces have `face_size` corners. Faces of 0, 1 or 2 corners are allowed and
     * ignored: nothing is computed for them. */
    const uint32_t* face_sizes;
    size_t face_count; /* entries of face_sizes */
    /* One per corner, into `normals` and `uvs`, which then have any number of entries: FBX, USD, OBJ and Houdini
     * keep them so. TSPACE_INDEX_NONE: these attributes have one entry per vertex, and follow `indices`.
     * TSPACE_INDEX_CORNERS: they have one entry per corner. Corners count as one vertex, as if the mesh had one
     * list, where their three indices are equal, and for TSPACE_INDEX_CORNERS where the entries have the same bits. */
    tspace_Indices normal_indices;
    tspace_Indices uv_indices;
} tspace_Mesh;

/* Corners of the mesh: the length of results. Not checked: call tspace_validate for that.
 * In C: 0 for null. */
size_t tspace_cornerCount(const tspace_Mesh* mesh) TSPACE_NOEXCEPT;
/* Faces of the mesh, not checked either.
 * In C: 0 for null. */
size_t tspace_faceCount(const tspace_Mesh* mesh) TSPACE_NOEXCEPT;

/* Checks everything that later code relies on: pointers against counts, equal lengths of vertex arrays, strides,
 * alignment, every index in range, face sizes that add up to the corners (or a corner count that is a multiple of
 * `face_size`), sizes within TSPACE_MAX_CORNERS. Does not look at the values of floats: those may be anything.
 *
 * Every function that takes a tspace_Mesh calls this first; call it yourself only to get the error early.
 * Reads every index once; no allocation but for an error's message. Thread-safe.
 * Errors: NULL_DATA, COUNT_MISMATCH, INDEX_OUT_OF_RANGE, STRIDE_TOO_SMALL, MISALIGNED, TOO_LARGE, INVALID_OPTION. */
tspace_ErrorCode tspace_validate(const tspace_Mesh* mesh, tspace_Error* error) TSPACE_NOEXCEPT;

/* The caller's job system. `run` must call task(context, i) exactly once for each i in [0, task_count), on any
 * threads and in any order, and return when all are done. Tasks never call back into `run`, never throw. */
typedef struct tspace_Executor {
    void (*run)(void* user, size_t task_count, void (*task)(void* context, size_t task_index), void* context);
    void* user;
    uint32_t concurrency; /* how many tasks can run at the same time; work is cut to fit. In C: 0 means 1. */
} tspace_Executor;

/* The caller's memory. `allocate` returns memory of that alignment (a power of two, at most 64) or null, which makes
 * the call fail with TSPACE_ERROR_OUT_OF_MEMORY. Called from the calling thread only. */
typedef struct tspace_Allocator {
    void* (*allocate)(void* user, size_t bytes, size_t alignment);
    void (*release)(void* user, void* memory, size_t bytes, size_t alignment);
    void* user;
} tspace_Allocator;

/* The instructions that the hot loops use. Results have the same bits with all of them. */
typedef uint32_t tspace_SimdTarget;
enum {
    TSPACE_SIMD_BEST = 0,   /* the best that this CPU has */
    TSPACE_SIMD_SCALAR = 1, /* no SIMD: for CPUs without any of these; elsewhere only tests of tspace have it */
    TSPACE_SIMD_SSE2 = 2,   /* x86-64 without anything else */
    TSPACE_SIMD_AVX2 = 3,
    TSPACE_SIMD_AVX512 = 4, /* AVX-512 F and DQ */
    TSPACE_SIMD_NEON = 5    /* 64-bit ARM, every CPU */
};

/* For tspace_Execution.thread_count: as many as there are cores. */
#define TSPACE_ALL_THREADS UINT32_MAX

/* Where work runs and where its memory comes from. A call has one, for all that it does: the last argument of
 * functions on arrays, a member of the options of functions on files. What it points to must outlive the call (and a
 * plan made with it).
 * In C: the structs that it points to are read during the call only; a plan needs the functions in them, and `user`. */
typedef struct tspace_Execution {
    uint32_t struct_size;
    uint32_t thread_count; /* 0 and 1: the calling thread only; TSPACE_ALL_THREADS */
    /* Runs all work, whatever thread_count says; null: threads that are started and joined within the call. */
    const tspace_Executor* executor;
    /* Only for scratch memory and plans. Null: operator new, and nothing is kept between calls. With a tspace_Arena
     * calls that follow each other take a tenth less time (tspace_generateTangents with more than 4096 corners). */
    const tspace_Allocator* allocator;
    tspace_SimdTarget simd; /* For tests and measurements. What this CPU lacks becomes the best of a lower number. */
    uint32_t reserved;
} tspace_Execution;

/* In C: prepares it as TSPACE_INIT does, for languages that have no macros. Zeros, but for the size, are the defaults.
 * struct_size  bytes of the struct as the caller declares it. One that this version does not know is INVALID_OPTION,
 *              and nothing is written.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initExecution(tspace_Execution* execution, uint32_t struct_size,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* Scratch memory for calls that follow each other. Pass tspace_arenaAllocator in tspace_Execution.allocator; the
 * memory of plans may come from it as well. A call on an arena that another one like it has used takes nothing from
 * the system.
 *
 * Memory: the most that was in use at one time, plus the holes between allocations of different sizes (a few percent
 * for calls of this library) and up to 2 MiB. It is kept until tspace_trimArena or the end of the arena. Large parts
 * use huge pages where the system has them.
 *
 * For one call at a time: not thread-safe, as no tspace_Allocator is. One arena per thread that makes calls. It must
 * outlive the plans whose memory it holds; it does not move. */
typedef struct tspace_Arena tspace_Arena;

/* Makes an arena, which holds nothing at first.
 * arena     *arena is null after an error. End it with tspace_destroyArena.
 * Errors: NULL_DATA, OUT_OF_MEMORY. */
tspace_ErrorCode tspace_createArena(tspace_Arena** arena, tspace_Error* error) TSPACE_NOEXCEPT;

/* For tspace_Execution.allocator. Valid as long as the arena. */
const tspace_Allocator* tspace_arenaAllocator(const tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Bytes of memory that the arena holds now, in use or not. Reserved address space without memory does not count. */
size_t tspace_arenaHeldBytes(const tspace_Arena* arena) TSPACE_NOEXCEPT;
/* Bytes in use now: 0 between calls, except for plans. */
size_t tspace_arenaUsedBytes(const tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Gives back what lies behind the last allocation in use; between calls without plans, that is everything. */
void tspace_trimArena(tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Frees an arena. Null is allowed. */
void tspace_destroyArena(tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Where v = 0 lies in the texture. It decides every sign, so it has no default. */
typedef uint32_t tspace_VAxis;
enum {
    TSPACE_V_UNSET = 0, /* not said; what computes tangents then fails with INVALID_OPTION */
    TSPACE_V_UP = 1,    /* v = 0 is the bottom row of the image (OpenGL, Blender, Unity) */
    TSPACE_V_DOWN = 2   /* v = 0 is the top row of the image (glTF, DirectX, Unreal, Godot) */
};

/* What a large green value in a normal map means. */
typedef uint32_t tspace_Green;
enum {
    TSPACE_GREEN_UP = 0,  /* towards the top row of the image ("OpenGL", +Y) */
    TSPACE_GREEN_DOWN = 1 /* towards the bottom row ("DirectX", -Y) */
};

/* Whether the stored sign is the one of `B = sign * cross(N, T)` or its negative. */
typedef uint32_t tspace_StoredSign;
enum { TSPACE_SIGN_AS_IS = 0, TSPACE_SIGN_NEGATED = 1 };

typedef uint32_t tspace_Handedness;
enum { TSPACE_HANDEDNESS_RIGHT = 0, TSPACE_HANDEDNESS_LEFT = 1 };

/* Order of a face's vertices as seen from outside. */
typedef uint32_t tspace_Winding;
enum { TSPACE_WINDING_COUNTER_CLOCKWISE = 0, TSPACE_WINDING_CLOCKWISE = 1 };

/* There is no default: take a preset, "gltf" for glTF. "opengl" is the plain mathematical reading: B points along
 * growing v, B = sign * cross(N, T), faces are counter-clockwise in a right-handed system; TSPACE_METHOD_MIKKTSPACE
 * under it gives the reference's sign.
 *
 * T always points along growing u. The image's green axis decides where B must point, and so the stored sign:
 *     sign = uv_orientation * (v_axis down ? -1 : 1) * (green down ? -1 : 1) * (stored_sign negated ? -1 : 1)
 * where uv_orientation is +1 when cross(dP/du, dP/dv) points along N. Handedness and winding say which side of a
 * face is out (see `tspace_normalFactor`), and so which way N points; B = sign * cross(N, T) holds numerically in
 * either. Normals look at handedness and winding only.
 * In C: the layout of this struct never changes. */
typedef struct tspace_Convention {
    tspace_VAxis v_axis;
    tspace_Green green;
    tspace_StoredSign stored_sign;
    tspace_Handedness handedness;
    tspace_Winding winding;
} tspace_Convention;

/* Finds a preset by its name in lower case ("gltf", "opengl", "directx", "unreal", "unity", "blender", "godot").
 * INVALID_OPTION for any other name.
 * In C: name ends in 0; out is written after success only. */
tspace_ErrorCode tspace_findConvention(const char* name, tspace_Convention* out, tspace_Error* error) TSPACE_NOEXCEPT;

/* +1 or -1: what the raw sign (the one of dP/dv over the UVs as given) is multiplied with before it is stored. */
float tspace_signFactor(tspace_Convention convention) TSPACE_NOEXCEPT;
/* +1 or -1: what cross(P1-P0, P2-P0) is multiplied with to point outside. */
float tspace_normalFactor(tspace_Convention convention) TSPACE_NOEXCEPT;

/* How tangents are computed. `docs/concepts/methods/` has a page for each. */
typedef uint32_t tspace_Method;
enum {
    /* Bit for bit the result of the MikkTSpace reference implementation (Mikkelsen 2008), for triangles and quads. */
    TSPACE_METHOD_MIKKTSPACE = 0,
    /* Sum of the unnormalised dP/du and dP/dv of the faces at a vertex index, Gram-Schmidt against N, sign from the
     * bitangent (Lengyel 2001). Never splits: all corners of one vertex index get one tangent. */
    TSPACE_METHOD_LENGYEL = 1,
    /* Weighted mean of unit face tangents in the groups of TSPACE_METHOD_MIKKTSPACE with corrected pairing. The
     * weight of a face at a corner is 1, the corner angle, or the face's area. */
    TSPACE_METHOD_UNIFORM = 2,
    TSPACE_METHOD_ANGLE = 3,
    TSPACE_METHOD_AREA = 4,
    TSPACE_METHOD_FLAT = 5, /* The face's own dP/du at each of its corners, made orthogonal to that corner's N. */
    /* No UVs: an orthonormal basis from N alone (Duff et al. 2017). No such basis is continuous over a closed
     * surface. */
    TSPACE_METHOD_BASIS = 6,
    /* Two weighted sums of dP/du in the groups of TSPACE_METHOD_ANGLE: one that is accurate on smooth surfaces (Max
     * 1999), one that is robust on bevels and noise, mixed by the angle between them. More accurate than all
     * weighted means, and hardly dearer than TSPACE_METHOD_UNIFORM. */
    TSPACE_METHOD_FAST = 7,
    /* A quadratic map from UVs to the tangent plane, fitted to the edges around each vertex (polynomial preserving
     * recovery, Zhang and Naga 2005), in the groups of TSPACE_METHOD_ANGLE; where the fit is doubtful it becomes a
     * robust mean. The error of its tangents falls with the square of the edge length, not with the length as that
     * of all others. */
    TSPACE_METHOD_BEST = 8
};

/* The name of a method as the tool and the docs spell it ("mikktspace"); "unknown" for other values. */
const char* tspace_methodName(tspace_Method method) TSPACE_NOEXCEPT;

/* How TSPACE_METHOD_MIKKTSPACE finds neighbouring faces. */
typedef uint32_t tspace_Pairing;
enum {
    TSPACE_PAIRING_REFERENCE = 0, /* with the reference's defect: the last bucket of its edge list is not sorted */
    TSPACE_PAIRING_CORRECTED = 1  /* without it: grouping no longer depends on the order of faces */
};

/* What happens to faces with more than 4 corners, which the MikkTSpace reference ignores. */
typedef uint32_t tspace_Ngons;
enum {
    TSPACE_NGONS_TRIANGULATE = 0, /* cut as by tspace_triangulate; results come back per corner of the n-gon */
    TSPACE_NGONS_SKIP = 1         /* as the reference: nothing is computed, outputs are 0 */
};

/* What one entry of the outputs belongs to. */
typedef uint32_t tspace_OutputDomain;
enum {
    TSPACE_DOMAIN_CORNER = 0,
    /* One entry per vertex of the mesh: TSPACE_METHOD_LENGYEL and TSPACE_METHOD_BASIS, whose results are the same at
     * all corners of a vertex. Every entry has the bits that the vertex's corners would get. Vertices that no used
     * face names get 0. */
    TSPACE_DOMAIN_VERTEX = 1
};

/* Which orthonormal frame stands for dP/du and dP/dv, where UVs are sheared and the two are not perpendicular. */
typedef uint32_t tspace_FrameShape;
enum {
    /* T is the direction of dP/du, and the shader's `sign * cross(N, T)` is off from dP/dv by the shear. */
    TSPACE_FRAME_GRAM_SCHMIDT = 0,
    /* T is the bisector of dP/du and of the direction perpendicular to dP/dv (Löwdin 1950): both are off by half of
     * the shear. Nearer to what the UVs say, but not what a baker or an engine with another tangent space expects. */
    TSPACE_FRAME_SYMMETRIC = 1
};

/* How tangents are computed. First what all methods have, then what one of them has alone and others do not look at. */
typedef struct tspace_TangentOptions {
    uint32_t struct_size;
    tspace_Method method; /* the default is what bakers and glTF expect */
    /* Decides the stored sign, and has no default: "gltf" for glTF; "opengl" stores the raw sign, as the reference
     * does. INVALID_OPTION where it is not set.
     * In C: by tspace_findConvention. */
    tspace_Convention convention;
    tspace_Ngons ngons; /* the default leaves no corner without a tangent */
    /* TSPACE_DOMAIN_VERTEX for TSPACE_METHOD_LENGYEL and TSPACE_METHOD_BASIS only: others have no one result per
     * vertex */
    tspace_OutputDomain domain;
    /* TSPACE_FRAME_SYMMETRIC is refused for TSPACE_METHOD_MIKKTSPACE, whose results are the reference's, and for
     * TSPACE_METHOD_BASIS, which has no UVs. The default is what bakers and engines expect. */
    tspace_FrameShape frame;
    /* Degrees, meant for 0..360. Faces of one group whose tangents (or bitangents) differ by this or more are not
     * averaged. 180 is the reference's default and what every baker uses. As in the reference, any float is taken:
     * only its cosine counts, and with NaN no two faces are averaged. Default: 180. */
    float angular_threshold_deg;
    tspace_Pairing pairing; /* the default has the bits of every other MikkTSpace */
    /* 0, 1 or 2 steps after the fit. A step changes each frame so that, interpolated along the edges around it, it
     * gives these edges, as far as they agree. 1: a fifth less error in what is shaded. 2: another twentieth less.
     * 0: the fit alone. Default: 1. */
    uint32_t refine;
    /* 0 or 1. 1: a normal whose length is further from 1 than rounding to 8 bits explains (0.00674) is scaled to
     * length 1 before anything is computed from it; all others, and those without a direction, keep their bits. 0,
     * the default, takes normals as they are: no method scales them, as the reference does not. A tangent is then
     * not perpendicular to a normal that is not unit: on a sphere it is off by up to 28 degrees at length 2. */
    uint32_t normalize_normals;
} tspace_TangentOptions;

/* In C: prepares options as TSPACE_INIT does, for languages that have no macros.
 * struct_size  bytes of the struct as the caller declares it. One that this version does not know is INVALID_OPTION, and
 *              nothing is written.
 * Zeros are refused: without a convention, and with one where angular_threshold_deg and refine are both 0 (INVALID_OPTION
 * of whatever takes the options). Either may be 0 alone, and no method looks at both.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initTangentOptions(tspace_TangentOptions* options, uint32_t struct_size,
                                           tspace_Error* error) TSPACE_NOEXCEPT;

/* Counts of triangles, groups and defects of the input. Broken input never makes a call fail. */
typedef struct tspace_TangentReport {
    uint32_t struct_size;
    /* 0 or 1. TSPACE_METHOD_MIKKTSPACE: the input drives the reference itself into quadratic time, so its last step
     * was left out. Either its sort (with TSPACE_PAIRING_REFERENCE): the corrected pairing was used for the last
     * bucket; only crafted inputs do this. Or its angular test: a group of more than 4096 faces whose tangents
     * spread too far was not split. */
    uint32_t reference_order_abandoned;
    uint64_t triangle_count;            /* triangles computed with, after cutting quads and n-gons */
    uint64_t degenerate_triangle_count; /* two corners at the same position */
    uint64_t degenerate_uv_count;       /* triangles without UV area: they take their neighbours' frame */
    uint64_t mirrored_count;            /* triangles that show the image mirrored, in the convention */
    uint64_t skipped_face_count;        /* faces for which nothing was computed */
    uint64_t group_count;               /* groups: sets of corners that share one tangent */
    uint64_t default_corner_count;      /* outputs that no face gives a tangent: the method's default */
    uint64_t not_finite_count;          /* outputs whose tangent has a NaN or infinity */
} tspace_TangentReport;

/* Where results go: one entry per corner (or vertex, see tspace_OutputDomain). Only `tangents` is required; empty
 * spans are not written. */
typedef struct tspace_TangentOutput {
    uint32_t struct_size;
    uint32_t reserved;
    /* 4 floats each: xyz: unit tangent; w: sign (+1 or -1), `B = w * cross(N, T)` in the chosen convention. */
    tspace_Span tangents;
    /* 3 floats each: unit direction of dP/dv (times tspace_signFactor(convention)), averaged like the tangent; in
     * general not cross(N, T). For methods that have none (TSPACE_METHOD_BASIS): sign * cross(N, T). */
    tspace_Span bitangents;
    tspace_Span magnitudes_s; /* 1 float each: mean length of dP/du; 1 for methods without */
    tspace_Span magnitudes_t; /* 1 float each: mean length of dP/dv; 1 for methods without */
    /* 1: at least one face gives the entry its tangent. 0: none does, and the method's default was written (counted
     * in tspace_TangentReport.default_corner_count), or the entry was cleared, as corners of skipped faces and
     * unused vertices are. */
    tspace_ByteSpan has_tangent;
} tspace_TangentOutput;

/* Tangents for a mesh in one call.
 *
 * mesh       positions; unit normals (all methods; see tspace_TangentOptions.normalize_normals); UVs (all but
 *            TSPACE_METHOD_BASIS)
 * options    the convention must be set
 * out        spans of tspace_cornerCount(mesh) entries (mesh->positions.count with TSPACE_DOMAIN_VERTEX); must not
 *            overlap the inputs or each other
 * execution  threads and memory; changes no bit
 * Corners of faces with fewer than 3 corners (and of n-gons with TSPACE_NGONS_SKIP) get 0 in every output. Results
 * are per corner: do not write them through the old index list, but split vertices whose corners disagree
 * (tspace_splitVertices, or tspace_makeIndexedFrames for all in one). Tangents that are not finite or not unit stay
 * as the method gives them: tspace_sanitizeTangents mends them.
 * The bits are those of tspace_planTangents and then tspace_evaluateTangents on the mesh's own pose, but most meshes
 * take a shorter way. A mesh with several index lists (tspace_Mesh.normal_indices, uv_indices) has the results of
 * the mesh that its caller would have unrolled.
 * Errors: those of tspace_validate; MISSING_ATTRIBUTE, COUNT_MISMATCH (outputs), NULL_DATA, INVALID_OPTION,
 * OUT_OF_MEMORY; TOO_LARGE also for more than 715,827,882 triangles (the methods that group: mikktspace, uniform,
 * angle, area, fast, best). Until the call returns, and when it fails, the outputs hold anything.
 * Linear in the number of corners whatever the input (fans, books, collapsed faces). Thread-safe. Same bits for any
 * thread count and SIMD target.
 *
 * Scratch memory on a mesh of triangles: TSPACE_METHOD_LENGYEL 16 bytes per vertex, or 8 with TSPACE_DOMAIN_VERTEX
 * (24 where the tangents' stride is not 16). TSPACE_METHOD_MIKKTSPACE, TSPACE_METHOD_UNIFORM, TSPACE_METHOD_ANGLE
 * and TSPACE_METHOD_AREA about 36 bytes per vertex without equal vertices, 46 with some, 80 when more than tangents
 * is asked for, and 32 per triangle for unindexed corners (where the tangents' stride is not 16 some more: see
 * docs/reference/memory.md); up to about 130 bytes per triangle for meshes that need the long way (thresholds,
 * values that are not finite), and about 150 beside the first for each triangle around a vertex that needs a second
 * look (several groups, doubtful splits, degenerate triangles). TSPACE_METHOD_FAST and TSPACE_METHOD_BEST take about
 * as much, and up to 2 MB per thread; TSPACE_METHOD_BEST 32 bytes per group more for each of its steps.
 * TSPACE_FRAME_SYMMETRIC adds 12 bytes per output unless bitangents are asked for, and a mesh with several index
 * lists about 40 bytes per corner of operator new. */
tspace_ErrorCode tspace_generateTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                         const tspace_TangentOutput* out, const tspace_Execution* execution,
                                         tspace_TangentReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* One mesh of a tspace_generateTangents call for many meshes.
 * In C: the layout of this struct never changes. */
typedef struct tspace_MeshJob {
    const tspace_Mesh* mesh;
    const tspace_TangentOptions* options; /* the convention must be set, as in a call for one mesh */
    const tspace_TangentOutput* out;      /* spans of the size that a call for this mesh alone needs */
    tspace_TangentReport* report;         /* null, or a prepared report, which is written when the job succeeds */
    tspace_Error* error;                  /* null, or written in either case: what this job alone would return */
} tspace_MeshJob;

/* Tangents for many meshes in one call. It starts threads once, not once per mesh, and each thread reuses its
 * scratch memory. Use it for models with hundreds or thousands of small primitives.
 *
 * jobs       any number of meshes, which may share inputs; outputs must not overlap inputs or each other, across all
 *            jobs
 * execution  each thread takes whole meshes, except that all threads together work on a mesh with more corners than
 *            a thread's share of all corners
 * Returns one result per job, in the order of the jobs: the report or the error that tspace_generateTangents(mesh,
 * options, out) returns for this job alone. A job that fails does not affect the others. The outputs have the bits
 * of single calls. Errors of the call itself: OUT_OF_MEMORY (for the results and the scratch memory of the threads);
 * the outputs of all jobs hold anything then.
 * Linear in the number of all corners and jobs. Thread-safe. Same bits for any thread count and SIMD target.
 *
 * Scratch memory: 128 KB per thread; where a job needs more, what a call for this mesh alone takes. An allocator of
 * `execution` is called from all threads, but never by two of them at the same time.
 * In C: a job reports through its members `report` and `error`. The call returns TSPACE_OK when all jobs succeeded,
 * and otherwise the code of the first job that failed; `error` then has its message, and as `element` the number of the
 * job. Jobs that did not fail have their results in either case. `jobs` may be null when job_count is 0. */
tspace_ErrorCode tspace_generateTangentsOfMeshes(const tspace_MeshJob* jobs, size_t job_count,
                                                 const tspace_Execution* execution,
                                                 tspace_Error* error) TSPACE_NOEXCEPT;

/* Everything about a mesh that does not change while it deforms: welding, neighbours, groups, splits, UVs.
 * Owns its memory and keeps no pointer into the mesh it was made from. Immutable, so many threads may evaluate one
 * plan at the same time. If it was made with a tspace_Allocator, that must outlive it. A plan that was moved from is
 * that of a mesh without vertices. */
typedef struct tspace_TangentPlan tspace_TangentPlan;

/* Makes the plan: welds equal vertices (position, normal and UV all equal), finds neighbours, groups and splits.
 * Inputs, errors and complexity as tspace_generateTangents. An allocator of `execution` must outlive the plan.
 * In C: *plan is null after an error. End it with tspace_destroyTangentPlan. */
tspace_ErrorCode tspace_planTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                     const tspace_Execution* execution, tspace_TangentPlan** plan,
                                     tspace_Error* error) TSPACE_NOEXCEPT;

/* The shape of a mesh at one moment: what changes while a mesh deforms. Counts and meaning as in the tspace_Mesh
 * that the plan was made from, index lists included. */
typedef struct tspace_Pose {
    uint32_t struct_size;
    uint32_t reserved;
    tspace_ConstSpan positions; /* 3 floats each */
    tspace_ConstSpan normals;   /* 3 floats each */
} tspace_Pose;

/* Computes frames for a pose with the plan's groups and splits. Each corner has the pose's position and normal of
 * its own vertex, also where vertices that were equal on the mesh come apart. On the pose the plan was made from the
 * result is bit for bit that of tspace_generateTangents. `execution` replaces the plan's. Scratch memory of the
 * grouping methods: 12 bytes per group when only tangents are asked for, else 44; with several threads also up to 12
 * bytes per triangle where triangles are in no order, and next to nothing where they are. Errors: PLAN_MISMATCH when
 * counts differ from the plan's, and those of span checks. O(corners).
 * In C: execution null: the default. */
tspace_ErrorCode tspace_evaluateTangents(const tspace_TangentPlan* plan, const tspace_Pose* pose,
                                         const tspace_TangentOutput* out, const tspace_Execution* execution,
                                         tspace_TangentReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* What a plan is for. */
typedef struct tspace_TangentPlanInfo {
    uint32_t struct_size;
    tspace_Method method;
    size_t vertex_count;
    size_t corner_count;
    size_t output_count; /* Entries of every output: corner_count, or vertex_count with TSPACE_DOMAIN_VERTEX. */
    size_t memory_bytes; /* Bytes held by the plan. */
} tspace_TangentPlanInfo;

/* Describes a plan. info is written after success only.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_describeTangentPlan(const tspace_TangentPlan* plan, tspace_TangentPlanInfo* info,
                                            tspace_Error* error) TSPACE_NOEXCEPT;

/* Frees a plan. Null is allowed. */
void tspace_destroyTangentPlan(tspace_TangentPlan* plan) TSPACE_NOEXCEPT;

/* Triangles of a polygon mesh, as corners of the original mesh (not vertices), so that results per corner carry
 * over.
 * In C: made by the library; later versions may append fields. */
typedef struct tspace_Triangulation {
    const uint32_t* corners; /* three per triangle, winding kept */
    const uint32_t* faces;   /* one per triangle: the face it was cut from */
    size_t triangle_count;
} tspace_Triangulation;

/* Cuts every face with 4 or more corners.
 *
 * Quads: the diagonal that MikkTSpace takes: the shorter one in UV space; if equal (or without UVs) 1-3 only when it
 * is strictly shorter in space, else 0-2.
 * n-gons: ears are clipped, the ear with the shortest diagonal first (squared length in space; ties by the diagonal
 * in UV space, then by the coordinates of its end points), ears seen in the plane of Newell's normal. The cut
 * depends on the polygon's geometry, not on the vertex it starts with. Where no ear is left (polygon not simple),
 * the shortest diagonal is cut anyway. Above 1024 corners the test that an ear is empty is left out.
 * Faces with fewer than 3 corners give nothing. Triangles come in face order.
 * Errors: those of tspace_validate; OUT_OF_MEMORY. O(corners) for triangles and quads, O(n^2) at most for an n-gon.
 * In C: *result is null after an error. Free it with tspace_destroyTriangulation. */
tspace_ErrorCode tspace_triangulate(const tspace_Mesh* mesh, tspace_Triangulation** result,
                                    tspace_Error* error) TSPACE_NOEXCEPT;

/* Frees a result of tspace_triangulate. Null is allowed. */
void tspace_destroyTriangulation(tspace_Triangulation* result) TSPACE_NOEXCEPT;

/* For TSPACE_INIT: the defaults that are not zero. Those of other headers stand there. */
static inline void tspace_setNoDefaults(void* object) { (void)object; }
static inline void tspace_setTangentDefaults(tspace_TangentOptions* options) {
    options->angular_threshold_deg = 180.0f;
    options->refine = 1;
}

#ifdef __cplusplus
}

inline void tspace_setDefaults(void*) noexcept {}
inline void tspace_setDefaults(tspace_TangentOptions* options) noexcept { tspace_setTangentDefaults(options); }
#define TSPACE_SET_DEFAULTS(object) tspace_setDefaults(&(object))
#else
/* clang-format off */
#define TSPACE_SET_DEFAULTS(object)                             \
    _Generic((object),                                          \
        tspace_NormalOptions: tspace_setNormalDefaults,         \
        tspace_IndexedFramesOptions: tspace_setIndexedFramesDefaults, \
        tspace_WindingOptions: tspace_setWindingDefaults,       \
        tspace_TangentOptions: tspace_setTangentDefaults,       \
        default: tspace_setNoDefaults)((void*)&(object))
/* clang-format on */
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
