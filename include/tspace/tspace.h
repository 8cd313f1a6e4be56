/* SPDX-License-Identifier: MIT */
/* The C API of the core library: everything that the C++ headers offer, for C11 and for bindings. Comments are those of
 * the C++ headers, with names of C; what holds in C alone is said behind "In C:".
 *
 * Words: a *face* is a triangle, quad or n-gon; a *corner* is one (face, local vertex) pair, numbered face
 * after face; a *vertex* is one entry of the vertex arrays. A *sign* is +1 or -1: B = sign * cross(N, T).
 *
 * Rules that hold for every function:
 * - A function that can fail returns TSPACE_OK or an error code. Its last parameter `error` may be null;
 *   otherwise it is written in either case (code TSPACE_OK and an empty message after success).
 * - Structs that start with `struct_size` are prepared with TSPACE_INIT, which sets the size and every default; what
 *   has no other default is zero. Fields are only ever added at the end, and the size says which a program knows: one
 *   that was compiled with any older header works with a newer library, and gets the defaults of newer fields. A size
 *   that this version does not know is TSPACE_ERROR_INVALID_OPTION.
 * - Languages without the macro prepare options by tspace_init..., and fill all other sized structs with zeros and the
 *   size. Options of zeros are other ones than the defaults: they are refused where they look forgotten, which is said
 *   at each of these functions.
 * - Structs without `struct_size` that a program fills never change. tspace_Convention stands in the middle of others:
 *   what a later version adds to it is a field at the end of each struct that holds one.
 * - Arguments come in one order: inputs, options, outputs that the caller owns, execution, then what C++ returns (a
 *   result or a report), and the error. Execution may be null: the default, which is the calling thread.
 * - Options and reports may be null: default options, no report wanted. (Tangents need options: a convention has no
 *   default.) A report is written only on success. Other pointers are not null, where nothing else is said: a function
 *   that can fail then fails with TSPACE_ERROR_NULL_DATA.
 * - Arrays are the caller's. Inputs are read during the call only. Outputs must not overlap inputs or each
 *   other. An array is empty when its count is 0; it may then be null.
 * - Every function may be called from any thread at the same time as any other, as long as nobody writes what
 *   another one uses. There is no global state. Results have the same bits for any thread count.
 * - Nothing is printed, nothing aborts, and no C++ exception comes out.
 */
#ifndef TSPACE_TSPACE_H
#define TSPACE_TSPACE_H

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
    uint32_t concurrency; /* number of tasks that can run at the same time. In C: 0 means 1. */
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

/* Position of v = 0 in the texture. It decides every sign, so it has no default. */
typedef uint32_t tspace_VAxis;
enum {
    TSPACE_V_UNSET = 0, /* not set; functions that compute tangents fail with INVALID_OPTION */
    TSPACE_V_UP = 1,    /* v = 0 is the bottom row of the image (OpenGL, Blender, Unity) */
    TSPACE_V_DOWN = 2   /* v = 0 is the top row of the image (glTF, DirectX, Unreal, Godot) */
};

/* Meaning of a large green value in a normal map. */
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

/* == frame.h ==
 * The mathematics of one frame (T, B, N), after Lengyel, "Foundations of Game Engine Development 2", 2019, ch. 7.
 * All functions are pure, O(1), use no memory, cannot fail, and may be called from any thread. Results are finite
 * for finite sound input. Vectors need not be unit unless a function says so. */

typedef struct tspace_Vec2 {
    float x, y;
} tspace_Vec2;

typedef struct tspace_Vec3 {
    float x, y, z;
} tspace_Vec3;

/* A tangent with its sign: x, y, z is the tangent, w the sign (+1 or -1). */
typedef struct tspace_Vec4 {
    float x, y, z, w;
} tspace_Vec4;

/* T, B and N in object space. Columns of the matrix that takes tangent space to object space. */
typedef struct tspace_Frame {
    tspace_Vec3 tangent, bitangent, normal;
} tspace_Frame;

/* Row-major 3x3. */
typedef struct tspace_Mat3 {
    tspace_Vec3 rows[3];
} tspace_Mat3;

/* Unnormalised dP/du and dP/dv of a triangle and the UV determinant s1 t2 - s2 t1 (twice the signed UV area). */
typedef struct tspace_FaceFrame {
    tspace_Vec3 tangent;   /* (t2 E1 - t1 E2) / determinant; zero when the determinant is zero */
    tspace_Vec3 bitangent; /* (s1 E2 - s2 E1) / determinant; zero when the determinant is zero */
    float determinant;
} tspace_FaceFrame;

/* From the edges P1-P0 and P2-P0. Divides by nothing when the determinant is zero or not finite.
 * In C: positions and uvs are 3 each. */
tspace_FaceFrame tspace_faceFrame(const tspace_Vec3* positions, const tspace_Vec2* uvs) TSPACE_NOEXCEPT;
/* tspace_faceFrame from the edges P1-P0 and P2-P1: equal up to rounding.
 * In C: positions and uvs are 3 each. */
tspace_FaceFrame tspace_faceFrameFromPath(const tspace_Vec3* positions, const tspace_Vec2* uvs) TSPACE_NOEXCEPT;

/* Determinant of the matrix with columns T, B, N. */
float tspace_determinant(tspace_Frame frame) TSPACE_NOEXCEPT;
/* +1 or -1: the sign of tspace_determinant(frame); +1 when it is zero. */
float tspace_frameSign(tspace_Frame frame) TSPACE_NOEXCEPT;

/* B = sign * cross(N, T). `tangent.w` is the sign. */
tspace_Vec3 tspace_rebuildBitangent(tspace_Vec3 normal, tspace_Vec4 tangent) TSPACE_NOEXCEPT;

/* Orthonormal frame by Gram-Schmidt: N' = N/|N|; T' = T - N'(N'.T); B' = B - N'(N'.B) - T'(T'.B)/(T'.T'); each
 * normalised. Where T is (nearly) parallel to N, or zero, T' comes from tspace_basisFromNormal; where B' vanishes,
 * it is cross(N', T'). N zero or not finite is taken as (0, 0, 1). The result is always finite, unit and orthogonal. */
tspace_Frame tspace_orthonormalize(tspace_Frame frame) TSPACE_NOEXCEPT;

/* The packed form of an orthonormalised frame: T' and the sign of the original frame. */
tspace_Vec4 tspace_packTangent(tspace_Frame frame) TSPACE_NOEXCEPT;

/* Right-handed orthonormal frame with the given unit normal: Duff et al., "Building an Orthonormal Basis,
 * Revisited", JCGT 6(1), 2017. Continuous except where n.z changes sign. */
tspace_Frame tspace_basisFromNormal(tspace_Vec3 unit_normal) TSPACE_NOEXCEPT;

/* Columns T, B, N: takes tangent space to object space. */
tspace_Mat3 tspace_tangentToObject(tspace_Frame frame) TSPACE_NOEXCEPT;
/* Rows T, B, N: the inverse of tspace_tangentToObject for an orthonormal frame only. */
tspace_Mat3 tspace_objectToTangentOrthonormal(tspace_Frame frame) TSPACE_NOEXCEPT;
/* The inverse of tspace_tangentToObject for any frame. Returns 0, and writes nothing, when the determinant is zero
 * or not finite.
 * In C: else returns 1. */
int tspace_objectToTangent(tspace_Frame frame, tspace_Mat3* out) TSPACE_NOEXCEPT;

/* m * v. */
tspace_Vec3 tspace_transform(tspace_Mat3 m, tspace_Vec3 v) TSPACE_NOEXCEPT;

/* Direction to tangent space and back, for any frame (general inverse). Not normalised. tspace_toTangentSpace
 * returns (0, 0, 0) for a singular frame. */
tspace_Vec3 tspace_toTangentSpace(tspace_Frame frame, tspace_Vec3 direction) TSPACE_NOEXCEPT;
tspace_Vec3 tspace_toObjectSpace(tspace_Frame frame, tspace_Vec3 direction) TSPACE_NOEXCEPT;

/* A normal-map texel, each channel in [0, 1], decoded to a unit tangent-space normal: 2c - 1, x and y times `scale`
 * (usually 1; glTF normalTexture.scale), y negated for TSPACE_GREEN_DOWN, normalised. (0, 0, 1) when the result has
 * no length. */
tspace_Vec3 tspace_decodeNormal(tspace_Vec3 texel, float scale, tspace_Green green) TSPACE_NOEXCEPT;

/* uv * tiling + offset, then taken into [0, 1) per component: where a tiled texture is sampled. */
tspace_Vec2 tspace_tileUv(tspace_Vec2 uv, tspace_Vec2 tiling, tspace_Vec2 offset) TSPACE_NOEXCEPT;

/* Lambert's cosine in tangent space: max(0, n.l) with n the decoded texel and l the object-space direction towards
 * the light taken to tangent space by the orthonormalised frame. The CPU reference for shaders. */
float tspace_lambert(tspace_Frame frame, tspace_Vec3 light_direction, tspace_Vec3 tangent_space_normal) TSPACE_NOEXCEPT;

/* Object-space normal for a decoded texel: unit(T x + B y + N z) with the frame orthonormalised first. */
tspace_Vec3 tspace_objectNormal(tspace_Frame frame, tspace_Vec3 tangent_space_normal) TSPACE_NOEXCEPT;

/* tspace_objectNormal in MikkTSpace's convention, which bakers assume: T and N as interpolated, not normalised, B =
 * sign * cross(N, T) from them; only the result is normalised. */
tspace_Vec3 tspace_objectNormalMikktspace(tspace_Vec3 interpolated_normal, tspace_Vec4 interpolated_tangent,
                                          tspace_Vec3 tangent_space_normal) TSPACE_NOEXCEPT;

/* == normals.h ==
 * Normals of faces, averaged at vertices: one result per corner, so that hard edges can be split afterwards. */

/* How much a face counts in the mean at one of its corners. e1, e2 are the edges at the corner, a the interior angle
 * between them (above 180 degrees where a polygon is reflex). */
typedef uint32_t tspace_NormalWeighting;
enum {
    /* no averaging: each corner gets its face's unit normal, as glTF asks where normals are missing */
    TSPACE_NORMAL_WEIGHTING_FLAT = 0,
    TSPACE_NORMAL_WEIGHTING_UNIFORM = 1,    /* 1: mean of unit face normals (Gouraud 1971) */
    TSPACE_NORMAL_WEIGHTING_AREA = 2,       /* the face's area (|e1 x e2| / 2 for a triangle): large faces count more */
    TSPACE_NORMAL_WEIGHTING_ANGLE = 3,      /* a: independent of tessellation (Thuermer & Wuethrich 1998) */
    TSPACE_NORMAL_WEIGHTING_ANGLE_AREA = 4, /* a * area */
    TSPACE_NORMAL_WEIGHTING_MAX = 5,        /* sin(a) / (|e1| |e2|): exact on a sphere (Max 1999) */
    /* No mean: the normal of a quadratic surface through the edges at the point. Where these look like noise or a
     * bevel it is the mean of TSPACE_NORMAL_WEIGHTING_ANGLE_AREA, and in between a blend. The most accurate, and the
     * slowest. */
    TSPACE_NORMAL_WEIGHTING_BEST = 6
};

/* How normals are computed. First what all weightings have, then what some do not look at. */
typedef struct tspace_NormalOptions {
    uint32_t struct_size;
    /* the default does not depend on how faces were cut. Default: TSPACE_NORMAL_WEIGHTING_ANGLE. */
    tspace_NormalWeighting weighting;
    tspace_Convention convention; /* Its handedness and winding say which side is out; the default is glTF's. */
    /* Degrees, 0..180. Two faces that share an edge are smoothed over it only when their normals differ by no more
     * than this (and 1e-6 rad for rounding). 180, the default, because no angle fits all models: never hard (except
     * by smoothing groups); then all faces at a point are smoothed together, also those that share no edge. -1: by
     * the mesh. The angle is in the widest gap between those that most edges have and those that few have, and noise
     * of positions is filtered out before. tspace_NormalReport says which it is. Default: 180. */
    float crease_angle_deg;
    /* One number per face, or empty. Faces smooth together only when their numbers are equal and not 0 (OBJ `s`),
     * or, with `smoothing_groups_are_masks`, when they have a bit in common (3ds Max). Connections pass on: where A
     * is smooth with B and B with C around a point, all three share one normal. */
    const uint32_t* smoothing_groups;
    size_t smoothing_group_count;        /* entries of smoothing_groups */
    uint32_t smoothing_groups_are_masks; /* 0 or 1. */
    /* 0 or 1. 1: vertices at the same position are one point (so UV seams stay smooth); 0: only equal indices are.
     * Default: 1. */
    uint32_t weld_positions;
    /* 0, 1 or 2 steps after the fit. A step moves each normal so that, interpolated along the edges around it, it is
     * across them, as far as these agree. 1: a third less error at vertices and in what is shaded between them. 2:
     * another quarter less. 0: the fit alone. Default: 2. */
    uint32_t refine;
    uint32_t reserved;
    /* For meshes whose positions are noisy: scans, marching cubes of a noisy field. Vertices stay; at each the
     * normals of quadratic surfaces through two and three rings around it are blended with that of
     * TSPACE_NORMAL_WEIGHTING_BEST, by how far each is likely to err. 0, the default: off. -1: by the noise that is
     * measured. Where there is none, or what there is looks like shape (CAD, bevels, decimated meshes), results have
     * the bits of 0. Above 0, up to 4: so many times the noise that is measured, whatever it looks like. 3 is for
     * noise that is smooth from vertex to vertex, which no measure tells from detail. Hard edges hold: no surface
     * goes through points on both sides. */
    float denoise;
    /* With `weld_positions`: positions that differ by no more than this in each coordinate are one position, that of
     * the lowest vertex among them, in the unit of positions. For meshes that close by computed coordinates, as a
     * torus does whose last ring has sin(2 pi) = -2.4e-16 where the first has 0. 0, the default: only equal
     * positions are. -1: twice the spacing of floats at the largest coordinate, and only at positions with an edge
     * of 32 times that. Vertices are taken in their order: each joins the lowest earlier one within the distance
     * that has joined no other, so that positions in a row are not all one. */
    float weld_distance;
} tspace_NormalOptions;

/* In C: prepares options as TSPACE_INIT does, for languages that have no macros.
 * struct_size  bytes of the struct as the caller declares it. One that this version does not know is INVALID_OPTION, and
 *              nothing is written.
 * Zeros are refused (INVALID_OPTION of whatever takes the options): weighting, crease_angle_deg, weld_positions and refine
 * all 0. TSPACE_NORMAL_WEIGHTING_FLAT, which is 0, looks at none of the others.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initNormalOptions(tspace_NormalOptions* options, uint32_t struct_size,
                                          tspace_Error* error) TSPACE_NOEXCEPT;

/* Counts of faces and defects of the input. Broken input never makes the call fail. */
typedef struct tspace_NormalReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t face_count;            /* faces with at least 3 corners */
    uint64_t degenerate_face_count; /* faces without a normal (zero area or not finite) */
    uint64_t fallback_corner_count; /* corners whose mean vanished: they got a substitute, see below */
    /* What `denoise` removed: the standard deviation of positions along the normal, in mean edge lengths. 0: it was
     * not asked, or found no noise, and changed no bit. */
    float noise;
    /* The angle that edges were held against: as given, or as found by the mesh. That holds, where positions are
     * noisy, for faces that were smoothed. TSPACE_NORMAL_WEIGHTING_FLAT: 0. */
    float crease_angle_deg;
} tspace_NormalReport;

/* Computes one unit normal per corner of the mesh.
 *
 * Face normal: Newell's sum over the polygon (for a triangle: cross(P1-P0, P2-P0)), times
 * tspace_normalFactor(convention). Vertex normal: the weighted mean of the unit face normals of all faces that are
 * connected to the corner's face around the vertex over smooth edges; weights as in tspace_NormalWeighting, summed
 * in double precision and in face order. A corner whose mean vanishes (is below 1e-10 of the weights) takes its own
 * face normal; if that is degenerate, the mean of the other faces at the vertex; if there is none, (0, 0, 1). So
 * every result is finite and unit.
 * Corners of faces with fewer than 3 corners get (0, 0, 0).
 *
 * mesh       positions and indices; UVs and normals are not looked at
 * out        3 floats each: one per corner (count == tspace_cornerCount(mesh)); must not overlap the inputs
 * execution  threads and memory; changes no bit
 * Errors: those of tspace_validate; COUNT_MISMATCH (out, smoothing_groups), INVALID_OPTION, OUT_OF_MEMORY.
 * Angles in triangles are good to 2e-7, those of polygons (face_sizes, or a face_size other than 3) are exact.
 * O(corners). Scratch memory: about 36 bytes per vertex; with hard edges or polygons less for large meshes, up to 40
 * bytes per triangle for small ones; TSPACE_NORMAL_WEIGHTING_BEST 28 bytes per corner more. Thread-safe; same bits
 * for any thread count. */
tspace_ErrorCode tspace_generateNormals(const tspace_Mesh* mesh, const tspace_NormalOptions* options, tspace_Span out,
                                        const tspace_Execution* execution, tspace_NormalReport* report,
                                        tspace_Error* error) TSPACE_NOEXCEPT;

/* Lengths are parts of `mean_edge`. */
typedef struct tspace_PositionNoise {
    uint32_t struct_size;
    /* How far positions lie from a smooth surface through their neighbours: the standard deviation along the normal.
     * Detail as small as a triangle is in it too. 0: less than 200 vertices have enough neighbours to tell. */
    float sigma;
    /* Of how normals differ along an edge, the part that no smooth surface has: the median, 0..1. Noise gives .3 to
     * .8; CAD, bevels and what was decimated give less for their sigma. */
    float kink_share;
    /* What of `sigma` is noise: so much tspace_NormalOptions.denoise removes where it goes by the mesh. 0: positions
     * are not noisy. That is so, too, where most edges are flatter than noise would leave them. */
    float noise;
    double mean_edge; /* of a sample, in the unit of positions, less what noise of sigma adds to it */
} tspace_PositionNoise;

/* Measures the noise in the positions of a mesh, by samples: up to 4096 vertices and 16384 edges. sigma is within 15
 * % of random noise from .03 to .3 on smooth shapes; noise that is smooth from vertex to vertex cannot be told from
 * detail.
 *
 * mesh       positions and indices; UVs and normals are not looked at. Vertices at one position are one
 * execution  threads and memory; changes no bit
 * Errors: those of tspace_validate; OUT_OF_MEMORY.
 * O(corners): the time of TSPACE_NORMAL_WEIGHTING_BEST and half as much again. Scratch memory: that of
 * TSPACE_NORMAL_WEIGHTING_BEST, then 28 bytes per corner, 56 per vertex, and 4 per vertex and thread. Thread-safe;
 * same bits for any thread count. */
tspace_ErrorCode tspace_measurePositionNoise(const tspace_Mesh* mesh, const tspace_Execution* execution,
                                             tspace_PositionNoise* noise, tspace_Error* error) TSPACE_NOEXCEPT;

/* == indexed_frames.h ==
 * The usual case in one call: an indexed mesh in, an indexed mesh with normals and tangents out. */

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
    uint32_t orthogonalize_all; /* 0 or 1. Like tspace_SanitizeOptions.orthogonalize_all */
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

/* == plan_buffers.h ==
 * A tangent plan as one flat array of words, for compute shaders: shaders/tspace_evaluate.* read it. */

/* What tspace_planBuffers writes beside the plan itself. */
typedef struct tspace_PlanBufferOptions {
    uint32_t struct_size;
    uint32_t reserved;
    /* The vertex of each corner in the arrays of a pose, as tspace_IndexedFrames.indices; empty: the indices of the
     * plan's mesh. */
    const uint32_t* indices;
    size_t index_count;
    /* The corner that each result belongs to, as tspace_IndexedFrames.source_corners; TSPACE_NO_CORNER: none. Empty:
     * one result per output of tspace_evaluateTangents. */
    const uint32_t* source_corners;
    size_t source_corner_count;
    /* The mesh of the plan, whose normals the shader computes from positions. Positions decide which corners share
     * one. No vertices, the default: a pose brings its normals.
     * In C: null: none. */
    const tspace_Mesh* mesh;
    /* How the normals of `mesh` are computed: every weighting but TSPACE_NORMAL_WEIGHTING_BEST. `denoise` must be 0,
     * and only lengyel reads the convention: other plans have theirs.
     * In C: null: the defaults. */
    const tspace_NormalOptions* normals;
} tspace_PlanBufferOptions;

/* The words of a plan: a header of 12 words, then the three arrays that it names. All numbers are 32-bit words in
 * the byte order of the machine. docs/guides/gpu.md describes the header, and how a result is computed.
 *
 * Results, 3 words each: the first entry; the count of entries (bits 0..27) with flags; the own corner of the result
 * as an entry, or 0xffffffff. Corners that share a tangent and a normal have the same entries.
 * Entries, 1 word each, in the order of summation: a corner of a triangle, 4 * triangle + corner, with flags.
 * 0xffffffff separates parts of a result that is the normalized mean of several.
 * Triangles: three vertices, then UV coefficients as floats: (a, b) with dP/du along a * e1 - b * e2, where e1 = P1
 * - P0, e2 = P2 - P0; for TSPACE_METHOD_LENGYEL (a, b, c, d) with dP/du = a * e1 - b * e2 and dP/dv = c * e2 - d *
 * e1.
 * In C: made by the library; later versions may append fields. */
typedef struct tspace_PlanBuffers {
    const uint32_t* words;
    size_t word_count;
    size_t result_count; /* as in the header: the number of threads to dispatch */
} tspace_PlanBuffers;

/* Writes the plan as words. About 12 bytes per result and 32 per triangle of entries and triangles (40 for
 * TSPACE_METHOD_LENGYEL).
 *
 * Errors: INVALID_OPTION for the methods flat, basis and best, for TSPACE_FRAME_SYMMETRIC, for normals that are
 * `best` or denoised, and for a plan of several index lists without `indices`; COUNT_MISMATCH and INDEX_OUT_OF_RANGE
 * for arrays of `options` that do not fit the plan; TOO_LARGE above 268,435,455 triangles; those of
 * tspace_generateNormals; OUT_OF_MEMORY. O(n log n) in results, else linear, plus the size of groups that an angular
 * threshold splits. Thread-safe.
 * In C: options null: the defaults. *buffers is null after an error. Free it with tspace_destroyPlanBuffers. */
tspace_ErrorCode tspace_planBuffers(const tspace_TangentPlan* plan, const tspace_PlanBufferOptions* options,
                                    const tspace_Execution* execution, tspace_PlanBuffers** buffers,
                                    tspace_Error* error) TSPACE_NOEXCEPT;

/* Frees a result of tspace_planBuffers. Null is allowed. */
void tspace_destroyPlanBuffers(tspace_PlanBuffers* buffers) TSPACE_NOEXCEPT;

/* == pack.h ==
 * Whole frames (N, T and the sign) in 4 to 16 bytes, with a bound on the error that is never exceeded.
 * All functions are pure, allocate nothing, use one thread, and may be called from any thread at the same time.
 * Their bits are the same on every machine: arithmetic and square roots alone, in a fixed order. See
 * docs/concepts/pack.md. */

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

/* == winding.h ==
 * Mends the winding of faces: those that are wound against their neighbours, and whole parts that are inside out. */

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

/* == defaults == */
/* For TSPACE_INIT: the defaults that are not zero. */
static inline void tspace_setNoDefaults(void* object) { (void)object; }
static inline void tspace_setTangentDefaults(tspace_TangentOptions* options) {
    options->angular_threshold_deg = 180.0f;
    options->refine = 1;
}
static inline void tspace_setNormalDefaults(tspace_NormalOptions* options) {
    options->weighting = TSPACE_NORMAL_WEIGHTING_ANGLE;
    options->crease_angle_deg = 180.0f;
    options->weld_positions = 1;
    options->refine = 2;
}
static inline void tspace_setIndexedFramesDefaults(tspace_IndexedFramesOptions* options) { options->sanitize = 1; }
static inline void tspace_setWindingDefaults(tspace_WindingOptions* options) {
    options->use_normals = 1;
    options->weld_positions = 1;
}

#ifdef __cplusplus
}

inline void tspace_setDefaults(void*) noexcept {}
inline void tspace_setDefaults(tspace_TangentOptions* options) noexcept { tspace_setTangentDefaults(options); }
inline void tspace_setDefaults(tspace_NormalOptions* options) noexcept { tspace_setNormalDefaults(options); }
inline void tspace_setDefaults(tspace_IndexedFramesOptions* options) noexcept {
    tspace_setIndexedFramesDefaults(options);
}
inline void tspace_setDefaults(tspace_WindingOptions* options) noexcept { tspace_setWindingDefaults(options); }
#define TSPACE_SET_DEFAULTS(object) tspace_setDefaults(&(object))
#else
/* clang-format off */
#define TSPACE_SET_DEFAULTS(object) \
    _Generic((object), \
        tspace_TangentOptions: tspace_setTangentDefaults, \
        tspace_NormalOptions: tspace_setNormalDefaults, \
        tspace_IndexedFramesOptions: tspace_setIndexedFramesDefaults, \
        tspace_WindingOptions: tspace_setWindingDefaults, \
        default: tspace_setNoDefaults)((void*)&(object))
/* clang-format on */
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
