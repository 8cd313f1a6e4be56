/* SPDX-License-Identifier: MIT */
/* The C API of the core library: everything in the C++ headers, for C11 and for bindings. Comments are copied from the
 * C++ headers, with C names; text after "In C:" applies to C only.
 *
 * Terms: a *face* is a triangle, quad or n-gon; a *corner* is one (face, local vertex) pair, numbered face
 * after face; a *vertex* is one entry of the vertex arrays. A *sign* is +1 or -1: B = sign * cross(N, T).
 *
 * Rules that hold for every function:
 * - A function that can fail returns TSPACE_OK or an error code. Its last parameter `error` may be null;
 *   otherwise it is written in either case (code TSPACE_OK and an empty message after success).
 * - Structs that start with `struct_size` are initialized with TSPACE_INIT, which sets the size and every default;
 *   other fields are set to zero. Fields are only added at the end, and the size tells the library which fields a
 *   program has: a program compiled with an older header works with a newer library, and gets the defaults of newer
 *   fields. A size that this version does not support causes TSPACE_ERROR_INVALID_OPTION.
 * - Languages without the macro initialize options with tspace_init..., and all other sized structs with zeros and the
 *   size. Zero-filled options differ from the defaults: they are rejected if they appear uninitialized, as documented
 *   at each of these functions.
 * - Structs without `struct_size` that a program fills never change. tspace_Convention is embedded in other structs:
 *   additions of a later version are appended to each struct that contains one.
 * - Arguments have a fixed order: inputs, options, outputs owned by the caller, execution, the results that C++ returns
 *   (a result or a report), and the error. Execution may be null: the default, which is the calling thread.
 * - Options and reports may be null: default options, no report. (Tangents require options: a convention has no
 *   default.) A report is written only on success. Other pointers must not be null unless documented otherwise: a
 *   function that can fail then fails with TSPACE_ERROR_NULL_DATA.
 * - The caller owns all arrays. Inputs are read during the call only. Outputs must not overlap inputs or each
 *   other. An array is empty if its count is 0; it may then be null.
 * - Every function may be called from any thread at the same time as any other, as long as no thread writes data that
 *   another one uses. There is no global state. Results have the same bits for any thread count.
 * - The library never prints, never aborts, and never lets a C++ exception escape.
 */
#ifndef TSPACE_TSPACE_H
#define TSPACE_TSPACE_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "tspace/version.h"

/* Exports the symbols of this header from shared libraries; all other symbols are hidden. */
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
#define TSPACE_NOEXCEPT noexcept
extern "C" {
#else
#define TSPACE_NOEXCEPT
#endif

/* Initializes a sized struct with its size and the defaults of this header: tspace_TangentOptions options;
 * TSPACE_INIT(options); */
#define TSPACE_INIT(object)                                                                               \
    ((void)memset(&(object), 0, sizeof(object)), (void)((object).struct_size = (uint32_t)sizeof(object)), \
     TSPACE_SET_DEFAULTS(object))

/* In C: returns the version of the linked library: 10000 * major + 100 * minor + patch. TSPACE_VERSION_NUMBER is
 * the version of the headers. */
uint32_t tspace_version(void) TSPACE_NOEXCEPT;

/* Reason why a call failed. The numbers are stable, equal in C and C++, and never reused. */
typedef uint32_t tspace_ErrorCode;
enum {
    TSPACE_OK = 0,                   /* not an error */
    TSPACE_ERROR_NULL_DATA = 1,      /* a required pointer is null, or a null array has a nonzero count */
    TSPACE_ERROR_COUNT_MISMATCH = 2, /* two arrays that must have equal lengths differ in length */
    /* an index is not less than the number of vertices; `element` is its position */
    TSPACE_ERROR_INDEX_OUT_OF_RANGE = 3,
    TSPACE_ERROR_STRIDE_TOO_SMALL = 4, /* elements of a span would overlap */
    TSPACE_ERROR_MISALIGNED = 5,       /* a pointer or stride is not a multiple of its element's alignment */
    /* a size exceeds a limit: the sum of face sizes, or a limit stated by the function */
    TSPACE_ERROR_TOO_LARGE = 6,
    /* the method needs an attribute (normals, UVs) that the mesh does not have */
    TSPACE_ERROR_MISSING_ATTRIBUTE = 7,
    /* an option has a value outside its stated range.
     * In C: or a struct has an unknown size. */
    TSPACE_ERROR_INVALID_OPTION = 8,
    TSPACE_ERROR_OUT_OF_MEMORY = 9,  /* the allocator returned null */
    TSPACE_ERROR_PLAN_MISMATCH = 10, /* arrays do not fit the plan they are evaluated with */
    TSPACE_ERROR_INTERNAL = 11,      /* a bug in tspace; please report it */
    TSPACE_ERROR_CANCELLED = 12,     /* a callback of the caller canceled the call; no result was returned or written */
    TSPACE_ERROR_INVALID_FILE = 100, /* asset layer: the file violates its format; the error states where */
    /* asset layer: the file is valid, but needs a feature that this version does not support */
    TSPACE_ERROR_UNSUPPORTED_FILE = 101,
    TSPACE_ERROR_FORBIDDEN_PATH = 102, /* asset layer: a URI leads outside the folder of the model */
    TSPACE_ERROR_CANNOT_READ = 103,    /* asset layer: a file cannot be opened or read */
    TSPACE_ERROR_CANNOT_WRITE = 104    /* asset layer: a file cannot be written; nothing was changed */
};

/* Value of `element` for an error that concerns no particular element. */
#define TSPACE_NO_ELEMENT UINT64_MAX

/* Description and location of an error, for the person who has to fix it.
 * In C: the layout of this struct never changes. */
typedef struct tspace_Error {
    tspace_ErrorCode code;
    uint32_t reserved; /* 0 */
    uint64_t element;  /* index of the offending element, or TSPACE_NO_ELEMENT */
    char message[240]; /* one sentence, no line break. In C: UTF-8, zero-terminated; truncated if longer. */
} tspace_Error;

/* Returns the stable lowerCamelCase identifier of a code, for logs and JSON ("indexOutOfRange"); "unknown" for other
 * numbers. Static memory. */
const char* tspace_errorName(tspace_ErrorCode code) TSPACE_NOEXCEPT;

/* View of `count` elements of T. The first is at `data`; each next one follows at a distance of `stride_bytes`.
 * `data` may be null only if `count` is 0. Functions that take a span check that the stride is at least sizeof(T)
 * (if there are two or more elements) and a multiple of alignof(T).
 * In C: T is the number of floats documented where the span is used. stride_bytes 0: tightly packed. */
typedef struct tspace_ConstSpan {
    const float* data;
    size_t count;
    size_t stride_bytes;
} tspace_ConstSpan;

/* In C: like tspace_ConstSpan, for results. */
typedef struct tspace_Span {
    float* data;
    size_t count;
    size_t stride_bytes;
} tspace_Span;

/* In C: like tspace_ConstSpan, for results of one byte each. stride_bytes 0: tightly packed. */
typedef struct tspace_ByteSpan {
    uint8_t* data;
    size_t count;
    size_t stride_bytes;
} tspace_ByteSpan;

/* Type of an index; the value is its size in bytes. */
typedef uint32_t tspace_IndexType;
enum {
    TSPACE_INDEX_NONE = 0,
    TSPACE_INDEX_U8 = 1,
    TSPACE_INDEX_U16 = 2,
    TSPACE_INDEX_U32 = 4,
    /* for tspace_Mesh.normal_indices and uv_indices: corner c uses entry c, without an index list in memory */
    TSPACE_INDEX_CORNERS = 8
};

/* Tightly packed indices, one per corner. With TSPACE_INDEX_NONE, corner c uses vertex c.
 * In C: data is null and count is 0 for TSPACE_INDEX_NONE and TSPACE_INDEX_CORNERS. */
typedef struct tspace_Indices {
    const void* data;
    size_t count;
    tspace_IndexType type;
} tspace_Indices;

/* Maximum number of corners (and so of vertices and indices) of a mesh: corner IDs are 32-bit with room for flags. */
#define TSPACE_MAX_CORNERS 0x7fffffff

/* A mesh. Positions are always required; each function lists the other attributes that it uses. Positions are
 * floats: for doubles far from the origin (meters of a map), first subtract an offset in double precision, such as
 * the center of the model, and move it to the model's transform; normals and tangents do not depend on it. */
typedef struct tspace_Mesh {
    uint32_t struct_size;
    uint32_t face_size; /* number of corners of every face if face_sizes is empty; at least 1. In C: 0 means 3. */
    tspace_ConstSpan positions; /* 3 floats each: one per vertex */
    /* 3 floats each: one per vertex, used as given (see tspace_TangentOptions.normalize_normals), or empty */
    tspace_ConstSpan normals;
    tspace_ConstSpan uvs;   /* 2 floats each: one per vertex, or empty */
    tspace_Indices indices; /* one per corner, or TSPACE_INDEX_NONE: every corner has its own vertex */
    /* Number of corners of each face. Empty: all faces have `face_size` corners. Faces with 0, 1 or 2 corners are
     * allowed and ignored. */
    const uint32_t* face_sizes;
    size_t face_count; /* entries of face_sizes */
    /* Indices per corner into `normals` and `uvs`, which then may have any number of entries, as in FBX, USD, OBJ
     * and Houdini. TSPACE_INDEX_NONE: these attributes have one entry per vertex and use `indices`.
     * TSPACE_INDEX_CORNERS: they have one entry per corner. Corners are welded, as with a single index list, if
     * their three indices are equal, and for TSPACE_INDEX_CORNERS if the bits of the entries are equal. */
    tspace_Indices normal_indices;
    tspace_Indices uv_indices;
} tspace_Mesh;

/* Returns the number of corners: the length of results. Not checked: call tspace_validate for that.
 * In C: 0 for null. */
size_t tspace_cornerCount(const tspace_Mesh* mesh) TSPACE_NOEXCEPT;
/* Returns the number of faces. Not checked.
 * In C: 0 for null. */
size_t tspace_faceCount(const tspace_Mesh* mesh) TSPACE_NOEXCEPT;

/* Checks all preconditions of other functions: pointers against counts, equal lengths of vertex arrays, strides,
 * alignment, index ranges, face sizes that add up to the corners (or a corner count that is a multiple of
 * `face_size`), sizes within TSPACE_MAX_CORNERS. Does not check the values of floats: any value is allowed.
 *
 * Every function that takes a tspace_Mesh calls this first; call it directly only to get the error early.
 * Reads every index once; allocates only for an error's message. Thread-safe.
 * Errors: NULL_DATA, COUNT_MISMATCH, INDEX_OUT_OF_RANGE, STRIDE_TOO_SMALL, MISALIGNED, TOO_LARGE, INVALID_OPTION. */
tspace_ErrorCode tspace_validate(const tspace_Mesh* mesh, tspace_Error* error) TSPACE_NOEXCEPT;

/* Job system of the caller. `run` must call task(context, i) exactly once for each i in [0, task_count), on any
 * threads and in any order, and return when all calls have returned. Tasks never call `run`, and never throw. */
typedef struct tspace_Executor {
    void (*run)(void* user, size_t task_count, void (*task)(void* context, size_t task_index), void* context);
    void* user;
    uint32_t concurrency; /* number of tasks that can run at the same time. In C: 0 means 1. */
} tspace_Executor;

/* Allocator of the caller. `allocate` returns memory of the given alignment (a power of two, at most 64) or null,
 * which makes the call fail with TSPACE_ERROR_OUT_OF_MEMORY. Called from the calling thread only. */
typedef struct tspace_Allocator {
    void* (*allocate)(void* user, size_t bytes, size_t alignment);
    void (*release)(void* user, void* memory, size_t bytes, size_t alignment);
    void* user;
} tspace_Allocator;

/* SIMD instruction set of the inner loops. Results have the same bits for every target. */
typedef uint32_t tspace_SimdTarget;
enum {
    TSPACE_SIMD_BEST = 0, /* the best target that this CPU supports */
    /* no SIMD: for CPUs that support no other target; elsewhere available only in tests of tspace */
    TSPACE_SIMD_SCALAR = 1,
    TSPACE_SIMD_SSE2 = 2, /* baseline of x86-64 */
    TSPACE_SIMD_AVX2 = 3,
    TSPACE_SIMD_AVX512 = 4, /* AVX-512 F and DQ */
    TSPACE_SIMD_NEON = 5    /* 64-bit ARM, supported by every CPU */
};

/* Value of tspace_Execution.thread_count for one thread per core. */
#define TSPACE_ALL_THREADS UINT32_MAX

/* Threads and memory of a call: the last argument of functions on arrays, a member of the options of functions on
 * files. The objects it points to must outlive the call, and any plan made with it.
 * In C: the structs it points to are read during the call only; a plan requires their functions and `user`. */
typedef struct tspace_Execution {
    uint32_t struct_size;
    uint32_t thread_count; /* 0 and 1: only the calling thread; TSPACE_ALL_THREADS: one thread per core */
    /* Runs all tasks, whatever thread_count is. Null: threads are started and joined within the call. */
    const tspace_Executor* executor;
    /* Allocates scratch memory and plans. Null: operator new, and no memory is kept between calls. With a
     * tspace_Arena, consecutive calls take a tenth less time (tspace_generateTangents with more than 4096 corners). */
    const tspace_Allocator* allocator;
    /* SIMD target, for tests and measurements. A target that this CPU does not support is replaced by the best one
     * with a lower number. */
    tspace_SimdTarget simd;
    uint32_t reserved;
} tspace_Execution;

/* In C: initializes an execution like TSPACE_INIT, for languages without macros. The defaults are zeros.
 * struct_size  size of the struct as declared by the caller, in bytes. If this version does not support the size:
 *              INVALID_OPTION, and nothing is written.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initExecution(tspace_Execution* execution, uint32_t struct_size,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* Scratch memory for consecutive calls. Pass tspace_arenaAllocator in tspace_Execution.allocator; plans may use it
 * too. A call that follows a similar call on the same arena requests no memory from the system.
 *
 * Memory: the largest amount in use at one time, plus gaps between allocations of different sizes (a few percent for
 * calls of this library) and up to 2 MiB. It is kept until tspace_trimArena or the destructor. Large blocks use huge
 * pages where the system supports them.
 *
 * For one call at a time: not thread-safe, like every tspace_Allocator. Use one arena per calling thread. It must
 * outlive the plans whose memory it holds. It cannot be moved. */
typedef struct tspace_Arena tspace_Arena;

/* In C: creates an empty arena.
 * arena     *arena is null after an error. Free it with tspace_destroyArena.
 * Errors: NULL_DATA, OUT_OF_MEMORY. */
tspace_ErrorCode tspace_createArena(tspace_Arena** arena, tspace_Error* error) TSPACE_NOEXCEPT;

/* Returns the allocator for tspace_Execution.allocator. Valid as long as the arena exists. */
const tspace_Allocator* tspace_arenaAllocator(const tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Returns the number of bytes that the arena holds, in use or not. Excludes address space that is only reserved. */
size_t tspace_arenaHeldBytes(const tspace_Arena* arena) TSPACE_NOEXCEPT;
/* Returns the number of bytes in use: 0 between calls, except for plans. */
size_t tspace_arenaUsedBytes(const tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Releases the memory behind the last allocation in use; between calls without plans, that is all memory. */
void tspace_trimArena(tspace_Arena* arena) TSPACE_NOEXCEPT;

/* In C: frees an arena. Null is allowed. */
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

/* Whether the stored sign is the sign in `B = sign * cross(N, T)` or its negative. */
typedef uint32_t tspace_StoredSign;
enum { TSPACE_SIGN_AS_IS = 0, TSPACE_SIGN_NEGATED = 1 };

typedef uint32_t tspace_Handedness;
enum { TSPACE_HANDEDNESS_RIGHT = 0, TSPACE_HANDEDNESS_LEFT = 1 };

/* Order of a face's vertices as seen from outside. */
typedef uint32_t tspace_Winding;
enum { TSPACE_WINDING_COUNTER_CLOCKWISE = 0, TSPACE_WINDING_CLOCKWISE = 1 };

/* There is no default: choose a preset, such as "gltf". "opengl" is the mathematical convention: B points along
 * increasing v, B = sign * cross(N, T), and faces are counter-clockwise in a right-handed system; with it
 * TSPACE_METHOD_MIKKTSPACE returns the sign of the reference.
 *
 * T always points along increasing u. The green axis of the image determines the direction of B, and so the stored
 * sign:
 *     sign = uv_orientation * (v_axis down ? -1 : 1) * (green down ? -1 : 1) * (stored_sign negated ? -1 : 1)
 * where uv_orientation is +1 when cross(dP/du, dP/dv) points along N. Handedness and winding define which side of a
 * face is outside (see `tspace_normalFactor`), and so the direction of N; B = sign * cross(N, T) holds numerically
 * in both cases. Normals depend on handedness and winding only.
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
 * In C: name is zero-terminated; out is written on success only. */
tspace_ErrorCode tspace_findConvention(const char* name, tspace_Convention* out, tspace_Error* error) TSPACE_NOEXCEPT;

/* Returns the factor (+1 or -1) that converts the raw sign (of dP/dv for the UVs as given) to the stored sign. */
float tspace_signFactor(tspace_Convention convention) TSPACE_NOEXCEPT;
/* Returns the factor (+1 or -1) that makes cross(P1-P0, P2-P0) point outside. */
float tspace_normalFactor(tspace_Convention convention) TSPACE_NOEXCEPT;

/* Method of computing tangents. `docs/concepts/methods/` has a page for each. */
typedef uint32_t tspace_Method;
enum {
    /* Bit-identical to the MikkTSpace reference implementation (Mikkelsen 2008), for triangles and quads. */
    TSPACE_METHOD_MIKKTSPACE = 0,
    /* Sum of the unnormalized dP/du and dP/dv of the faces at a vertex index, Gram-Schmidt against N, sign from the
     * bitangent (Lengyel 2001). Never splits: all corners of a vertex index get the same tangent. */
    TSPACE_METHOD_LENGYEL = 1,
    /* Weighted mean of unit face tangents in the groups of TSPACE_METHOD_MIKKTSPACE with corrected pairing. The
     * weight of a face at a corner is 1 (TSPACE_METHOD_UNIFORM), the corner angle (TSPACE_METHOD_ANGLE), or the
     * face's area (TSPACE_METHOD_AREA). */
    TSPACE_METHOD_UNIFORM = 2,
    TSPACE_METHOD_ANGLE = 3,
    TSPACE_METHOD_AREA = 4,
    /* The face's own dP/du at each of its corners, orthogonalized against that corner's N. */
    TSPACE_METHOD_FLAT = 5,
    /* Orthonormal basis from N, without UVs (Duff et al. 2017). No such basis is continuous over a closed surface. */
    TSPACE_METHOD_BASIS = 6,
    /* Two weighted sums of dP/du in the groups of TSPACE_METHOD_ANGLE: one that is accurate on smooth surfaces (Max
     * 1999), and one that is robust on bevels and noise, blended by the angle between them. More accurate than all
     * weighted means, at little more cost than TSPACE_METHOD_UNIFORM. */
    TSPACE_METHOD_FAST = 7,
    /* Quadratic map from UVs to the tangent plane, fitted to the edges around each vertex (polynomial preserving
     * recovery, Zhang and Naga 2005), in the groups of TSPACE_METHOD_ANGLE; if the fit is unreliable, a robust mean.
     * The error of its tangents decreases with the square of the edge length; the error of all other methods
     * decreases linearly. */
    TSPACE_METHOD_BEST = 8
};

/* Returns the name of a method as in the tool and the docs ("mikktspace"); "unknown" for other values. */
const char* tspace_methodName(tspace_Method method) TSPACE_NOEXCEPT;

/* Rule by which TSPACE_METHOD_MIKKTSPACE pairs neighboring faces. */
typedef uint32_t tspace_Pairing;
enum {
    TSPACE_PAIRING_REFERENCE = 0, /* with the reference's bug: the last bucket of its edge list is not sorted */
    TSPACE_PAIRING_CORRECTED = 1  /* without the bug: grouping does not depend on the order of faces */
};

/* Treatment of faces with more than 4 corners, which the MikkTSpace reference ignores. */
typedef uint32_t tspace_Ngons;
enum {
    TSPACE_NGONS_TRIANGULATE = 0, /* triangulated by tspace_triangulate; results are per corner of the n-gon */
    TSPACE_NGONS_SKIP = 1         /* skipped, as in the reference: all outputs are 0 */
};

/* Element type of the outputs. */
typedef uint32_t tspace_OutputDomain;
enum {
    TSPACE_DOMAIN_CORNER = 0,
    /* One entry per vertex of the mesh: for TSPACE_METHOD_LENGYEL and TSPACE_METHOD_BASIS, whose results are equal
     * at all corners of a vertex. Each entry is bit-identical to the result at every corner of the vertex. Vertices
     * that no used face refers to get 0. */
    TSPACE_DOMAIN_VERTEX = 1
};

/* Orthonormal frame that replaces dP/du and dP/dv where sheared UVs make them non-perpendicular. */
typedef uint32_t tspace_FrameShape;
enum {
    /* T is the direction of dP/du; the shader's `sign * cross(N, T)` deviates from dP/dv by the shear. */
    TSPACE_FRAME_GRAM_SCHMIDT = 0,
    /* T is the bisector of dP/du and the direction perpendicular to dP/dv (Löwdin 1950): both deviate by half of the
     * shear. Closer to the UVs, but not what bakers and engines with another tangent space expect. */
    TSPACE_FRAME_SYMMETRIC = 1
};

/* Options of tspace_generateTangents: first those for all methods, then those of a single method, which others
 * ignore. */
typedef struct tspace_TangentOptions {
    uint32_t struct_size;
    tspace_Method method; /* the default is what bakers and glTF expect */
    /* Determines the stored sign; there is no default: "gltf" for glTF; "opengl" stores the raw sign, as the
     * reference does. If unset: INVALID_OPTION.
     * In C: set by tspace_findConvention. */
    tspace_Convention convention;
    tspace_Ngons ngons; /* by default every corner gets a tangent */
    /* TSPACE_DOMAIN_VERTEX for TSPACE_METHOD_LENGYEL and TSPACE_METHOD_BASIS only: other methods have several
     * results per vertex */
    tspace_OutputDomain domain;
    /* TSPACE_FRAME_SYMMETRIC is rejected for TSPACE_METHOD_MIKKTSPACE, whose results are those of the reference, and
     * for TSPACE_METHOD_BASIS, which uses no UVs. The default is what bakers and engines expect. */
    tspace_FrameShape frame;
    /* Angular threshold in degrees, 0 to 180: faces of a group whose tangents (or bitangents) differ by this or more
     * are not averaged. 180 is the default of the reference and of every baker. As in the reference, any float is
     * accepted, but only its cosine is used: 270 has the effect of 90. With NaN no two faces are averaged. Default:
     * 180. */
    float angular_threshold_deg;
    tspace_Pairing pairing; /* the default is bit-identical to every other MikkTSpace */
    /* Number of refinement steps after the fit: 0, 1 or 2. A step changes each frame so that, interpolated along the
     * edges around it, it reproduces these edges, as far as they agree. 1: a fifth less shading error. 2: another
     * twentieth less. Default: 1. */
    uint32_t refine;
    /* 0 or 1. 1: normalize normals whose length deviates from 1 by more than 8-bit rounding does (0.00674) before
     * they are used; all others, and those without a direction, keep their bits. 0, the default: use normals as
     * given, as the reference does. A tangent is then not perpendicular to a normal that is not unit: on a sphere it
     * deviates by up to 28 degrees at length 2. */
    uint32_t normalize_normals;
} tspace_TangentOptions;

/* In C: initializes options like TSPACE_INIT, for languages without macros.
 * struct_size  size of the struct as declared by the caller, in bytes. If this version does not support the size:
 *              INVALID_OPTION, and nothing is written.
 * Functions reject zero-filled options (INVALID_OPTION): options without a convention, and options in which
 * angular_threshold_deg and refine are both 0. Either may be 0 alone, because no method uses both.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initTangentOptions(tspace_TangentOptions* options, uint32_t struct_size,
                                           tspace_Error* error) TSPACE_NOEXCEPT;

/* Counts of triangles, groups and defects of the input. Invalid geometry never makes a call fail. */
typedef struct tspace_TangentReport {
    uint32_t struct_size;
    /* 0 or 1. TSPACE_METHOD_MIKKTSPACE: the input would drive the reference into quadratic time, so one of its steps
     * was skipped. This is either the sort (with TSPACE_PAIRING_REFERENCE; the corrected pairing was used for the
     * last bucket; only crafted inputs cause this), or the angular test (a group of more than 4096 faces whose
     * tangents spread too far was not split). */
    uint32_t reference_order_abandoned;
    uint64_t triangle_count;            /* processed triangles, after triangulation of quads and n-gons */
    uint64_t degenerate_triangle_count; /* triangles with two corners at the same position */
    uint64_t degenerate_uv_count;       /* triangles without UV area: they use the frames of their neighbors */
    uint64_t mirrored_count;            /* triangles that show the image mirrored, in the chosen convention */
    uint64_t skipped_face_count;        /* faces for which nothing was computed */
    uint64_t group_count;               /* groups: sets of corners that share one tangent */
    uint64_t default_corner_count;      /* outputs without a tangent from any face: default of the method */
    uint64_t not_finite_count;          /* outputs whose tangent has a NaN or infinity */
} tspace_TangentReport;

/* Output arrays: one entry per corner (or vertex, see tspace_OutputDomain). Only `tangents` is required; empty spans
 * are not written. */
typedef struct tspace_TangentOutput {
    uint32_t struct_size;
    uint32_t reserved;
    /* 4 floats each: xyz: unit tangent; w: sign (+1 or -1), `B = w * cross(N, T)` in the chosen convention. */
    tspace_Span tangents;
    /* 3 floats each: unit direction of dP/dv (times tspace_signFactor(convention)), averaged like the tangent; in
     * general not cross(N, T). For methods without a bitangent (TSPACE_METHOD_BASIS): sign * cross(N, T). */
    tspace_Span bitangents;
    tspace_Span magnitudes_s; /* 1 float each: mean length of dP/du; 1 for methods that compute none */
    tspace_Span magnitudes_t; /* 1 float each: mean length of dP/dv; 1 for methods that compute none */
    /* 1: at least one face contributes to the tangent. 0: none does, and the method's default was written (counted
     * in tspace_TangentReport.default_corner_count), or the entry was cleared, as for corners of skipped faces and
     * unused vertices. */
    tspace_ByteSpan has_tangent;
} tspace_TangentOutput;

/* Computes the tangents of a mesh in one call.
 *
 * mesh       positions; unit normals (all methods; see tspace_TangentOptions.normalize_normals); UVs (all but
 *            TSPACE_METHOD_BASIS)
 * options    the convention must be set
 * out        spans of tspace_cornerCount(mesh) entries (mesh->positions.count with TSPACE_DOMAIN_VERTEX); must not
 *            overlap the inputs or each other
 * execution  threads and memory; does not affect the result
 * Corners of faces with fewer than 3 corners (and of n-gons with TSPACE_NGONS_SKIP) get 0 in every output. Results
 * are per corner: do not write them through the old index list, but split vertices whose corners differ
 * (tspace_splitVertices, or tspace_makeIndexedFrames for all steps). Tangents that are not finite or not unit are
 * left as the method computed them: tspace_sanitizeTangents repairs them.
 * The result has the same bits as tspace_planTangents followed by tspace_evaluateTangents on the mesh's own pose,
 * but most meshes take a faster path. A mesh with several index lists (tspace_Mesh.normal_indices, uv_indices) has
 * the results of the equivalent mesh with one list.
 * Errors: those of tspace_validate; MISSING_ATTRIBUTE, COUNT_MISMATCH (outputs), NULL_DATA, INVALID_OPTION,
 * OUT_OF_MEMORY; TOO_LARGE also for more than 715,827,882 triangles (methods with groups: mikktspace, uniform,
 * angle, area, fast, best). The contents of the outputs are undefined until the call returns, and after an error.
 * Linear in the number of corners for any input (fans, books, collapsed faces). Thread-safe. Same bits for any
 * thread count and SIMD target.
 *
 * Scratch memory on a triangle mesh: TSPACE_METHOD_LENGYEL 16 bytes per vertex, or 8 with TSPACE_DOMAIN_VERTEX (24
 * if the tangents' stride is not 16). TSPACE_METHOD_MIKKTSPACE, TSPACE_METHOD_UNIFORM, TSPACE_METHOD_ANGLE and
 * TSPACE_METHOD_AREA about 36 bytes per vertex if no two vertices are equal, 46 otherwise, 80 if outputs other than
 * tangents are requested, and 32 per triangle for unindexed corners (more if the tangents' stride is not 16: see
 * docs/reference/memory.md); up to about 130 bytes per triangle for meshes that need the general path (thresholds,
 * values that are not finite), and about 150 more for each triangle around a vertex with special cases (several
 * groups, uncertain splits, degenerate triangles). TSPACE_METHOD_FAST and TSPACE_METHOD_BEST need about as much, and
 * up to 2 MB per thread; TSPACE_METHOD_BEST 32 bytes more per group for each refinement step. TSPACE_FRAME_SYMMETRIC
 * adds 12 bytes per output unless bitangents are requested, and a mesh with several index lists adds about 40 bytes
 * per corner, from operator new. */
tspace_ErrorCode tspace_generateTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                         const tspace_TangentOutput* out, const tspace_Execution* execution,
                                         tspace_TangentReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* One mesh of a tspace_generateTangents call for many meshes.
 * In C: the layout of this struct never changes. */
typedef struct tspace_MeshJob {
    const tspace_Mesh* mesh;
    const tspace_TangentOptions* options; /* the convention must be set */
    const tspace_TangentOutput* out;      /* spans of the sizes that a single call for this mesh requires */
    tspace_TangentReport* report;         /* null, or an initialized report, which is written if the job succeeds */
    tspace_Error* error;                  /* null, or always written: the error of this job */
} tspace_MeshJob;

/* Computes the tangents of many meshes in one call. It starts threads once, not once per mesh, and each thread
 * reuses its scratch memory. Use it for models with hundreds or thousands of small primitives.
 *
 * jobs       any number of meshes, which may share inputs; outputs must not overlap inputs or each other, across all
 *            jobs
 * execution  each thread takes whole meshes, except that all threads cooperate on a mesh with more corners than a
 *            thread's share of all corners
 * Returns one result per job, in the order of the jobs: the report or the error that tspace_generateTangents(mesh,
 * options, out) returns for this job alone. A job that fails does not affect the others. The outputs have the bits
 * of single calls.
 * Errors of the call itself: OUT_OF_MEMORY (for the results and the scratch memory of the threads); the contents of
 * all outputs are then undefined.
 * Linear in the number of all corners and jobs. Thread-safe. Same bits for any thread count and SIMD target.
 *
 * Scratch memory: 128 KB per thread; if a job needs more, as much as a single call for this mesh. An allocator of
 * `execution` is called from all threads, but never by two of them at the same time.
 * In C: the results of a job are in its members `report` and `error`. The call returns TSPACE_OK if all jobs succeeded,
 * otherwise the code of the first job that failed; `error` then has its message, and the job's index as `element`. Jobs
 * that did not fail have their results in either case. `jobs` may be null if job_count is 0. */
tspace_ErrorCode tspace_generateTangentsOfMeshes(const tspace_MeshJob* jobs, size_t job_count,
                                                 const tspace_Execution* execution,
                                                 tspace_Error* error) TSPACE_NOEXCEPT;

/* Precomputed data that do not change while a mesh deforms: welding, neighbors, groups, splits, UVs. Owns its memory
 * and keeps no pointer to the mesh. Immutable, so many threads may evaluate one plan at the same time. If it was
 * created with a tspace_Allocator, that must outlive it. A moved-from plan is equivalent to the plan of a mesh
 * without vertices. */
typedef struct tspace_TangentPlan tspace_TangentPlan;

/* Creates a plan: welds equal vertices (position, normal and UV all equal), finds neighbors, groups and splits.
 * Inputs, errors and complexity as tspace_generateTangents. An allocator of `execution` must outlive the plan.
 * In C: *plan is null after an error. Free it with tspace_destroyTangentPlan. */
tspace_ErrorCode tspace_planTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                     const tspace_Execution* execution, tspace_TangentPlan** plan,
                                     tspace_Error* error) TSPACE_NOEXCEPT;

/* Shape of a mesh at one moment: the data that change while it deforms. Counts, order and index lists are those of
 * the tspace_Mesh that the plan was created from. */
typedef struct tspace_Pose {
    uint32_t struct_size;
    uint32_t reserved;
    tspace_ConstSpan positions; /* 3 floats each */
    tspace_ConstSpan normals;   /* 3 floats each */
} tspace_Pose;

/* Computes frames for a pose with the plan's groups and splits. Each corner uses the pose's position and normal of
 * its own vertex, also if vertices that were equal on the mesh differ in the pose. For the pose that the plan was
 * created from, the result is bit-identical to tspace_generateTangents. `execution` replaces the plan's. Scratch
 * memory of methods with groups: 12 bytes per group if only tangents are requested, otherwise 44; with several
 * threads also up to 12 bytes per triangle for triangles in random order, and almost none for ordered ones. Errors:
 * PLAN_MISMATCH if counts differ from the plan's, and those of span checks. O(corners).
 * In C: execution may be null: the default. */
tspace_ErrorCode tspace_evaluateTangents(const tspace_TangentPlan* plan, const tspace_Pose* pose,
                                         const tspace_TangentOutput* out, const tspace_Execution* execution,
                                         tspace_TangentReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Properties of a plan. */
typedef struct tspace_TangentPlanInfo {
    uint32_t struct_size;
    tspace_Method method;
    size_t vertex_count;
    size_t corner_count;
    /* Returns the number of entries of every output: corner_count, or vertex_count with TSPACE_DOMAIN_VERTEX. */
    size_t output_count;
    size_t memory_bytes; /* Returns the memory that the plan uses, in bytes. */
} tspace_TangentPlanInfo;

/* In C: returns the properties of a plan. info is written on success only.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_describeTangentPlan(const tspace_TangentPlan* plan, tspace_TangentPlanInfo* info,
                                            tspace_Error* error) TSPACE_NOEXCEPT;

/* In C: frees a plan. Null is allowed. */
void tspace_destroyTangentPlan(tspace_TangentPlan* plan) TSPACE_NOEXCEPT;

/* Triangles of a polygon mesh, as corners of the original mesh (not vertices), so that per-corner results still
 * apply.
 * In C: allocated by the library; later versions may append fields. */
typedef struct tspace_Triangulation {
    const uint32_t* corners; /* three per triangle; winding is preserved */
    const uint32_t* faces;   /* one per triangle: its original face */
    size_t triangle_count;
} tspace_Triangulation;

/* Triangulates every face with 4 or more corners.
 *
 * Quads: the diagonal that MikkTSpace chooses: the shorter one in UV space; if equal (or without UVs), 1-3 only if
 * it is strictly shorter in space, otherwise 0-2.
 * n-gons: ear clipping in the plane of Newell's normal. The ear with the shortest diagonal is clipped first (squared
 * length in space; ties by the diagonal in UV space, then by the coordinates of its end points). The result depends
 * on the polygon's geometry, not on its first vertex. If no ear is left (polygon not simple), the shortest diagonal
 * is cut. Above 1024 corners ears are not tested for emptiness.
 * Faces with fewer than 3 corners produce no triangles. Triangles are in face order.
 * Errors: those of tspace_validate; OUT_OF_MEMORY. O(corners) for triangles and quads, at most O(n^2) for an n-gon.
 * In C: *result is null after an error. Free it with tspace_destroyTriangulation. */
tspace_ErrorCode tspace_triangulate(const tspace_Mesh* mesh, tspace_Triangulation** result,
                                    tspace_Error* error) TSPACE_NOEXCEPT;

/* In C: frees a result of tspace_triangulate. Null is allowed. */
void tspace_destroyTriangulation(tspace_Triangulation* result) TSPACE_NOEXCEPT;

/* == frame.h ==
 * Operations on a single frame (T, B, N), after Lengyel, "Foundations of Game Engine Development 2", 2019, ch. 7.
 * All functions are pure and O(1), use no memory, cannot fail, and may be called from any thread. Results are finite
 * for finite valid input. Vectors need not have unit length unless a function says so. */

typedef struct tspace_Vec2 {
    float x, y;
} tspace_Vec2;

typedef struct tspace_Vec3 {
    float x, y, z;
} tspace_Vec3;

/* Tangent with its sign: x, y, z is the tangent, w is the sign (+1 or -1). */
typedef struct tspace_Vec4 {
    float x, y, z, w;
} tspace_Vec4;

/* T, B and N in object space: the columns of the matrix from tangent space to object space. */
typedef struct tspace_Frame {
    tspace_Vec3 tangent;
    tspace_Vec3 bitangent;
    tspace_Vec3 normal;
} tspace_Frame;

/* Row-major 3x3 matrix. */
typedef struct tspace_Mat3 {
    tspace_Vec3 rows[3];
} tspace_Mat3;

/* Unnormalized dP/du and dP/dv of a triangle, and the UV determinant s1 t2 - s2 t1 (twice the signed UV area). */
typedef struct tspace_FaceFrame {
    tspace_Vec3 tangent;   /* (t2 E1 - t1 E2) / determinant; zero when the determinant is zero */
    tspace_Vec3 bitangent; /* (s1 E2 - s2 E1) / determinant; zero when the determinant is zero */
    float determinant;
} tspace_FaceFrame;

/* Computes the frame from the edges P1-P0 and P2-P0. Does not divide if the determinant is zero or not finite.
 * In C: positions and uvs have 3 elements each. */
tspace_FaceFrame tspace_faceFrame(const tspace_Vec3* positions, const tspace_Vec2* uvs) TSPACE_NOEXCEPT;
/* Computes tspace_faceFrame from the edges P1-P0 and P2-P1; the results are equal except for rounding.
 * In C: positions and uvs have 3 elements each. */
tspace_FaceFrame tspace_faceFrameFromPath(const tspace_Vec3* positions, const tspace_Vec2* uvs) TSPACE_NOEXCEPT;

/* Returns the determinant of the matrix with columns T, B, N. */
float tspace_determinant(tspace_Frame frame) TSPACE_NOEXCEPT;
/* Returns the sign of tspace_determinant(frame): +1 or -1; +1 if the determinant is zero. */
float tspace_frameSign(tspace_Frame frame) TSPACE_NOEXCEPT;

/* Returns B = sign * cross(N, T). `tangent.w` is the sign. */
tspace_Vec3 tspace_rebuildBitangent(tspace_Vec3 normal, tspace_Vec4 tangent) TSPACE_NOEXCEPT;

/* Orthonormalizes a frame by Gram-Schmidt: N' = N/|N|; T' = T - N'(N'.T); B' = B - N'(N'.B) - T'(T'.B)/(T'.T'); each
 * vector is normalized. If T is zero or (nearly) parallel to N, T' is taken from tspace_basisFromNormal; if B'
 * vanishes, it is cross(N', T'). If N is zero or not finite, (0, 0, 1) replaces it. The result is always finite,
 * unit and orthogonal. */
tspace_Frame tspace_orthonormalize(tspace_Frame frame) TSPACE_NOEXCEPT;

/* Returns the packed form of an orthonormalized frame: T' and the sign of the original frame. */
tspace_Vec4 tspace_packTangent(tspace_Frame frame) TSPACE_NOEXCEPT;

/* Returns a right-handed orthonormal frame with the given unit normal: Duff et al., "Building an Orthonormal Basis,
 * Revisited", JCGT 6(1), 2017. Continuous except where n.z changes sign. */
tspace_Frame tspace_basisFromNormal(tspace_Vec3 unit_normal) TSPACE_NOEXCEPT;

/* Returns the matrix from tangent space to object space, with columns T, B, N. */
tspace_Mat3 tspace_tangentToObject(tspace_Frame frame) TSPACE_NOEXCEPT;
/* Returns the matrix with rows T, B, N: the inverse of tspace_tangentToObject, for an orthonormal frame only. */
tspace_Mat3 tspace_objectToTangentOrthonormal(tspace_Frame frame) TSPACE_NOEXCEPT;
/* Computes the inverse of tspace_tangentToObject for any frame. Returns 0, and writes nothing, if the determinant is
 * zero or not finite.
 * In C: otherwise returns 1. */
int tspace_objectToTangent(tspace_Frame frame, tspace_Mat3* out) TSPACE_NOEXCEPT;

/* Returns m * v. */
tspace_Vec3 tspace_transform(tspace_Mat3 m, tspace_Vec3 v) TSPACE_NOEXCEPT;

/* Transforms a direction to tangent space or back, for any frame (general inverse), without normalization.
 * tspace_toTangentSpace returns (0, 0, 0) for a singular frame. */
tspace_Vec3 tspace_toTangentSpace(tspace_Frame frame, tspace_Vec3 direction) TSPACE_NOEXCEPT;
tspace_Vec3 tspace_toObjectSpace(tspace_Frame frame, tspace_Vec3 direction) TSPACE_NOEXCEPT;

/* Decodes a normal-map texel, each channel in [0, 1], to a unit tangent-space normal: 2c - 1, x and y times `scale`
 * (usually 1; glTF normalTexture.scale), y negated for TSPACE_GREEN_DOWN, normalized. Returns (0, 0, 1) if the
 * result has no length. */
tspace_Vec3 tspace_decodeNormal(tspace_Vec3 texel, float scale, tspace_Green green) TSPACE_NOEXCEPT;

/* Returns uv * tiling + offset, wrapped to [0, 1) per component: the coordinates at which a tiled texture is
 * sampled. */
tspace_Vec2 tspace_tileUv(tspace_Vec2 uv, tspace_Vec2 tiling, tspace_Vec2 offset) TSPACE_NOEXCEPT;

/* Returns Lambert's cosine in tangent space: max(0, n.l), where n is the decoded texel and l the object-space
 * direction towards the light, transformed to tangent space by the orthonormalized frame. This is the CPU reference
 * for shaders. */
float tspace_lambert(tspace_Frame frame, tspace_Vec3 light_direction, tspace_Vec3 tangent_space_normal) TSPACE_NOEXCEPT;

/* Returns the object-space normal for a decoded texel: unit(T x + B y + N z) with the orthonormalized frame. */
tspace_Vec3 tspace_objectNormal(tspace_Frame frame, tspace_Vec3 tangent_space_normal) TSPACE_NOEXCEPT;

/* Returns tspace_objectNormal in MikkTSpace's convention, which bakers assume: T and N as interpolated, not
 * normalized, and B = sign * cross(N, T) from them; only the result is normalized. */
tspace_Vec3 tspace_objectNormalMikktspace(tspace_Vec3 interpolated_normal, tspace_Vec4 interpolated_tangent,
                                          tspace_Vec3 tangent_space_normal) TSPACE_NOEXCEPT;

/* == normals.h ==
 * Face normals averaged at vertices. Results are per corner, so that hard edges can be split afterwards. */

/* Weight of a face in the mean at one of its corners. e1 and e2 are the edges at the corner, a is the interior angle
 * between them (above 180 degrees at reflex corners of a polygon). */
typedef uint32_t tspace_NormalWeighting;
enum {
    /* no averaging: each corner gets its face's unit normal, as glTF requires for missing normals */
    TSPACE_NORMAL_WEIGHTING_FLAT = 0,
    TSPACE_NORMAL_WEIGHTING_UNIFORM = 1,    /* 1: mean of unit face normals (Gouraud 1971) */
    TSPACE_NORMAL_WEIGHTING_AREA = 2,       /* area of the face (|e1 x e2| / 2 for a triangle) */
    TSPACE_NORMAL_WEIGHTING_ANGLE = 3,      /* a: independent of the tessellation (Thuermer & Wuethrich 1998) */
    TSPACE_NORMAL_WEIGHTING_ANGLE_AREA = 4, /* a * area */
    TSPACE_NORMAL_WEIGHTING_MAX = 5,        /* sin(a) / (|e1| |e2|): exact on a sphere (Max 1999) */
    /* Normal of a quadratic surface fitted to the edges at the point. If the edges look like noise or a bevel, the
     * mean of TSPACE_NORMAL_WEIGHTING_ANGLE_AREA; in between, a blend of both. The most accurate and the slowest. */
    TSPACE_NORMAL_WEIGHTING_BEST = 6
};

/* Options of tspace_generateNormals: first those that apply to all weightings, then those that apply to some. */
typedef struct tspace_NormalOptions {
    uint32_t struct_size;
    /* the default does not depend on how faces were triangulated. Default: TSPACE_NORMAL_WEIGHTING_ANGLE. */
    tspace_NormalWeighting weighting;
    tspace_Convention convention; /* Handedness and winding define the outside of faces. Default: glTF. */
    /* Maximum angle between the normals of two faces whose shared edge is smooth, in degrees, 0..180 (plus 1e-6 rad
     * for rounding). Default: 180, because no angle suits all models: no hard edges (except from smoothing groups),
     * and all faces at a point are smoothed together, including faces that share only this point. -1: chosen for
     * each mesh, as the middle of the widest gap in the histogram of edge angles, after noise of positions is
     * filtered out. tspace_NormalReport contains the angle that was used. Default: 180. */
    float crease_angle_deg;
    /* One number per face, or empty. Faces are smoothed together only if their numbers are equal and not 0 (OBJ
     * `s`), or, with `smoothing_groups_are_masks`, if they have a bit in common (3ds Max). Smoothing is transitive:
     * if A is smooth with B and B with C around a point, all three share one normal. */
    const uint32_t* smoothing_groups;
    size_t smoothing_group_count;        /* entries of smoothing_groups */
    uint32_t smoothing_groups_are_masks; /* 0 or 1. */
    /* 0 or 1. 1: weld vertices with equal positions (so UV seams stay smooth); 0: weld by index only. Default: 1. */
    uint32_t weld_positions;
    /* Number of refinement steps after the fit: 0, 1 or 2. A step moves each normal so that, interpolated along the
     * edges around it, it is perpendicular to these edges, as far as they agree. 1: a third less error at vertices
     * and in the shading between them. 2: another quarter less. Default: 2. */
    uint32_t refine;
    uint32_t reserved;
    /* Denoising for meshes with noisy positions: scans, marching cubes of a noisy field. Vertices are not moved; at
     * each vertex the normals of quadratic surfaces through two and three rings are blended with the normal of
     * TSPACE_NORMAL_WEIGHTING_BEST, weighted by their expected errors. 0, the default: off. -1: by the measured
     * noise; if there is none, or it looks like shape (CAD, bevels, decimated meshes), results are bit-identical to
     * those with 0. Above 0, up to 4: factor of the measured noise, without that check; 3 suits noise that is smooth
     * from vertex to vertex, which cannot be distinguished from detail. Hard edges are preserved: no surface is
     * fitted across them. */
    float denoise;
    /* With `weld_positions`: weld distance, in mesh units. Vertices whose positions differ by at most this in each
     * coordinate are welded to the one with the lowest index. Useful for meshes that are closed only up to rounding,
     * such as a torus whose last ring has sin(2 pi) = -2.4e-16 instead of 0. 0, the default: only equal positions.
     * -1: twice the spacing of floats at the largest coordinate, and only at positions with an edge of at least 32
     * times that length. Vertices are processed in order: each is welded to the first earlier vertex within the
     * distance that was not welded itself, so chains of close positions are not all welded together. */
    float weld_distance;
} tspace_NormalOptions;

/* In C: initializes options like TSPACE_INIT, for languages without macros.
 * struct_size  size of the struct as declared by the caller, in bytes. If this version does not support the size:
 *              INVALID_OPTION, and nothing is written.
 * Functions reject zero-filled options (INVALID_OPTION): options in which weighting, crease_angle_deg, weld_positions
 * and refine are all 0. TSPACE_NORMAL_WEIGHTING_FLAT, which is 0, uses none of the other three, so keep their defaults.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initNormalOptions(tspace_NormalOptions* options, uint32_t struct_size,
                                          tspace_Error* error) TSPACE_NOEXCEPT;

/* Counts of faces and defects of the input. Invalid geometry never makes the call fail. */
typedef struct tspace_NormalReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t face_count;            /* faces with at least 3 corners */
    uint64_t degenerate_face_count; /* faces without a normal (zero area or not finite) */
    uint64_t fallback_corner_count; /* corners whose mean vanished and was replaced (see tspace_generateNormals) */
    /* Noise that `denoise` removed: standard deviation of positions along the normal, in mean edge lengths. 0:
     * denoising was off or found no noise, and changed no bit. */
    float noise;
    /* Crease angle that was used: as given, or as derived from the mesh (for noisy positions, an angle between
     * smoothed faces). TSPACE_NORMAL_WEIGHTING_FLAT: 0. */
    float crease_angle_deg;
} tspace_NormalReport;

/* Computes one unit normal per corner of the mesh.
 *
 * Face normal: Newell's sum over the polygon (for a triangle: cross(P1-P0, P2-P0)), times
 * tspace_normalFactor(convention). Vertex normal: the weighted mean of the unit face normals of all faces that are
 * connected to the corner's face around the vertex over smooth edges; weights as in tspace_NormalWeighting, summed
 * in double precision and in face order. A corner whose mean vanishes (is below 1e-10 of the weights) gets its own
 * face normal; if that is degenerate, the mean of the other faces at the vertex; if there is none, (0, 0, 1). Every
 * result is therefore finite and unit. Corners of faces with fewer than 3 corners get (0, 0, 0).
 *
 * mesh       positions and indices; UVs and normals are ignored
 * out        3 floats each: one per corner (count == tspace_cornerCount(mesh)); must not overlap the inputs
 * execution  threads and memory; does not affect the result
 * Errors: those of tspace_validate; COUNT_MISMATCH (out, smoothing_groups), INVALID_OPTION, OUT_OF_MEMORY.
 * Angles in triangles are accurate to 2e-7; angles in polygons (face_sizes, or a face_size other than 3) are exact.
 * O(corners). Scratch memory: about 36 bytes per vertex; with hard edges or polygons less for large meshes, up to 40
 * bytes per triangle for small ones; 28 bytes more per corner for TSPACE_NORMAL_WEIGHTING_BEST. Thread-safe; same
 * bits for any thread count. */
tspace_ErrorCode tspace_generateNormals(const tspace_Mesh* mesh, const tspace_NormalOptions* options, tspace_Span out,
                                        const tspace_Execution* execution, tspace_NormalReport* report,
                                        tspace_Error* error) TSPACE_NOEXCEPT;

/* Result of tspace_measurePositionNoise. Lengths are relative to `mean_edge`. */
typedef struct tspace_PositionNoise {
    uint32_t struct_size;
    /* Standard deviation of positions from a smooth surface through their neighbors, along the normal. Includes
     * detail of the size of a triangle. 0: fewer than 200 vertices have enough neighbors for a measurement. */
    float sigma;
    /* How abruptly normals change along edges, from 0 to 1: the median over the sampled edges of x^2 / (x^2 + y^2),
     * where x is the part of the change that uniform bending cannot explain (0 on a circle), and y the part that it
     * explains. Noise: 0.3 to 0.8. CAD models, bevels and decimated meshes: less, for the same sigma. */
    float kink_share;
    /* Part of `sigma` that is noise, which tspace_NormalOptions.denoise removes automatically. 0: positions are not
     * noisy, or most edges are flatter than noise would leave them. */
    float noise;
    /* Mean length of the sampled edges, in mesh units, without the length that noise of `sigma` adds to them. */
    double mean_edge;
} tspace_PositionNoise;

/* Measures the noise in the positions of a mesh from samples: up to 4096 vertices and 16384 edges. sigma is within
 * 15 % of random noise from 0.03 to 0.3 on smooth shapes; noise that is smooth from vertex to vertex cannot be
 * distinguished from detail.
 *
 * mesh       positions and indices; UVs and normals are ignored. Vertices with equal positions are welded
 * execution  threads and memory; does not affect the result
 * Errors: those of tspace_validate; OUT_OF_MEMORY.
 * O(corners): 1.5 times the time of TSPACE_NORMAL_WEIGHTING_BEST. Scratch memory: that of
 * TSPACE_NORMAL_WEIGHTING_BEST, then 28 bytes per corner, 56 per vertex, and 4 per vertex and thread. Thread-safe;
 * same bits for any thread count. */
tspace_ErrorCode tspace_measurePositionNoise(const tspace_Mesh* mesh, const tspace_Execution* execution,
                                             tspace_PositionNoise* noise, tspace_Error* error) TSPACE_NOEXCEPT;

/* == indexed_frames.h ==
 * Computes the normals and tangents of an indexed mesh in one call, and splits its vertices where needed. */

typedef struct tspace_SanitizeOptions {
    uint32_t struct_size;
    /* 0 or 1. Also normalize valid tangents and make them orthogonal to N. Off by default: the result would no
     * longer match a bake made with the method's own tangents (quantized normals are not unit, so the reference's
     * tangents can deviate by up to a degree). */
    uint32_t orthogonalize_all;
} tspace_SanitizeOptions;

/* In C: initializes options like TSPACE_INIT, for languages without macros.
 * struct_size  size of the struct as declared by the caller, in bytes. If this version does not support the size:
 *              INVALID_OPTION, and nothing is written.
 * The defaults are zeros.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initSanitizeOptions(tspace_SanitizeOptions* options, uint32_t struct_size,
                                            tspace_Error* error) TSPACE_NOEXCEPT;

/* Corners repaired, by cause (the first that applies, in this order) and by fix. */
typedef struct tspace_SanitizeReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t not_finite_count;     /* NaN or infinity in the tangent */
    uint64_t zero_count;           /* length 0 (or too small to normalize) */
    uint64_t not_unit_count;       /* length off by more than 5e-4 (the glTF validator's tolerance) */
    uint64_t parallel_count;       /* within 1 degree of +N or -N: no frame can be built */
    uint64_t bad_sign_count;       /* sign not exactly +1 or -1 */
    uint64_t mixed_sign_count;     /* sign changed because the signs of the face's corners differed */
    uint64_t orthogonalized_count; /* valid tangents changed by orthogonalize_all */
    uint64_t normalized_count;     /* fix: its own direction, made unit and orthogonal to N */
    uint64_t from_neighbor_count;  /* fix: direction of a valid corner of the same face or position */
    uint64_t from_basis_count;     /* fix: basis from N (Duff et al. 2017) */
    uint64_t bad_normal_count;     /* corners whose N is zero or not finite: only a unit tangent is guaranteed */
    uint64_t mended_count;         /* Returns the number of corners that were written: the sum of the causes. */
    /* exactly (1, 0, 0), and not perpendicular to N.
     * In C: this cause is tested after that of parallel_count. */
    uint64_t placeholder_count;
} tspace_SanitizeReport;

/* Repairs tangents in place. A tangent is invalid if it contains NaN or infinity, is zero, has a length that differs
 * from 1 by more than 5e-4, is within 1 degree of +-N, is a placeholder that is not perpendicular to N, has a sign
 * that is not +-1, or if the signs within its face differ. Repaired tangents are unit and orthogonal to the corner's
 * N (normalized) within 1e-6, with sign +1 or -1. Valid tangents keep every bit.
 *
 * Placeholder: the reference writes exactly (1, 0, 0) to corners around which no triangle has UV area, for any N. A
 * tangent from UVs with these bits has been projected along N, so it is perpendicular to N.
 *
 * Fixes, in this order: the tangent's own direction, if it has one that is not parallel to N; the tangent of the
 * first valid corner of the same face; that of the first valid corner at the same position (in corner order); a
 * basis from N. Signs inside a face: the majority of the valid corners decides (of those whose N has a direction, if
 * there are any); on a tie, the first of them. If N has no direction, corners at one position that do not use their
 * own direction, and have the same sign, share the tangent of the first of them. The result does not depend on the
 * indexing of vertices, so repairing a split mesh again changes nothing.
 *
 * mesh       positions and normals; UVs are ignored
 * tangents   4 floats each: one per corner, read and written; corners of faces with fewer than 3 corners are not
 *            changed
 * execution  threads and memory; does not affect the result
 * Errors: those of tspace_validate; MISSING_ATTRIBUTE (normals), COUNT_MISMATCH, NULL_DATA, OUT_OF_MEMORY.
 * O(corners). Thread-safe; same bits for any thread count. */
tspace_ErrorCode tspace_sanitizeTangents(const tspace_Mesh* mesh, const tspace_SanitizeOptions* options,
                                         tspace_Span tangents, const tspace_Execution* execution,
                                         tspace_SanitizeReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* Attribute given per corner, as `component_count` floats. */
typedef struct tspace_CornerAttribute {
    const float* data;   /* In C: may be null only if there are no corners. */
    size_t stride_bytes; /* distance between corners; at least 4 * component_count. In C: 0 means tightly packed. */
    uint32_t component_count; /* number of floats, 1 to 16 */
    /* 0: corners are equal only if all bits are. Above 0: equal if every component differs by at most this from the
     * first corner of the vertex (so rounding noise does not split); NaN equals only its own bits. */
    float tolerance;
} tspace_CornerAttribute;

/* Value for a vertex that no corner uses. */
#define TSPACE_NO_CORNER UINT32_MAX

/* New index buffer, and the source of each new vertex.
 * In C: allocated by the library; later versions may append fields. */
typedef struct tspace_SplitResult {
    const uint32_t* indices; /* one per corner: the new vertex */
    size_t corner_count;
    /* One per new vertex: the old vertex that it copies. The first `old vertex count` entries are 0, 1, 2, ...: old
     * vertices keep their indices, copies are appended. Gather every vertex attribute, skin weight and morph target
     * through it. */
    const uint32_t* source_vertices;
    /* One per new vertex: the corner whose attribute values belong to it, or TSPACE_NO_CORNER when no corner uses
     * it. */
    const uint32_t* source_corners;
    size_t vertex_count;
} tspace_SplitResult;

/* Splits vertices whose corners differ in any of the attributes.
 *
 * The first corner (in corner order) of an old vertex keeps the vertex; each corner that equals none of the vertex's
 * earlier variants gets a copy, appended in corner order. Deterministic.
 *
 * indices       the old vertex of each corner (TSPACE_INDEX_NONE: corner c uses vertex c)
 * vertex_count  number of old vertices
 * corner_count  length of every attribute; equals the count of `indices`, if there are any
 * execution     threads; scratch memory is only needed for vertices with more than 8 variants
 * Errors: NULL_DATA, COUNT_MISMATCH, INDEX_OUT_OF_RANGE, STRIDE_TOO_SMALL, TOO_LARGE, INVALID_OPTION, OUT_OF_MEMORY.
 * O(corners) expected, with or without tolerance. Thread-safe; same result for any thread count.
 * In C: indices and execution may be null: no indices, and the default. attributes may be null if attribute_count is
 * 0. *result is null after an error. Free it with tspace_destroySplitResult. It uses 4 bytes per corner and 8 per new
 * vertex. */
tspace_ErrorCode tspace_splitVertices(const tspace_Indices* indices, size_t vertex_count, size_t corner_count,
                                      const tspace_CornerAttribute* attributes, size_t attribute_count,
                                      const tspace_Execution* execution, tspace_SplitResult** result,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* In C: frees a result of tspace_splitVertices. Null is allowed. */
void tspace_destroySplitResult(tspace_SplitResult* result) TSPACE_NOEXCEPT;

/* Options of tspace_makeIndexedFrames. */
typedef struct tspace_IndexedFramesOptions {
    uint32_t struct_size;
    uint32_t make_normals; /* 0 or 1. Recompute existing normals; missing normals are always computed */
    /* 0 or 1. Repair tangents that contain NaN or infinity, are zero, do not have unit length, are parallel to N, or
     * have different signs within a face. Default: 1. */
    uint32_t sanitize;
    uint32_t orthogonalize_all; /* 0 or 1. Same meaning as tspace_SanitizeOptions.orthogonalize_all */
    /* Tangent options. The convention must be set; it also defines the outside of a face. Results are per corner
     * (`domain`): the split turns them into vertices.
     * In C: not null. */
    const tspace_TangentOptions* tangents;
    /* Options for computed normals. Their convention is ignored; the convention of `tangents` is used.
     * In C: may be null: the defaults. */
    const tspace_NormalOptions* normals;
    /* Further attributes, one entry per corner, that must not be shared: corners with different values get separate
     * vertices. Only a mesh without indices needs them, for vertex attributes other than position, normal and UV. */
    const tspace_CornerAttribute* keep_apart;
    size_t keep_apart_count;
} tspace_IndexedFramesOptions;

/* In C: initializes options like TSPACE_INIT, for languages without macros.
 * struct_size  size of the struct as declared by the caller, in bytes. If this version does not support the size:
 *              INVALID_OPTION, and nothing is written.
 * Functions reject zero-filled options, because `tangents` is required; with `tangents` set, they disable the repair.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initIndexedFramesOptions(tspace_IndexedFramesOptions* options, uint32_t struct_size,
                                                 tspace_Error* error) TSPACE_NOEXCEPT;

/* Indexed mesh with the same faces as the input. Gather every other vertex attribute, skin weight and morph target
 * through source_vertices, and attributes with their own index list through the corner:
 * their_indices[source_corners[v]].
 * In C: allocated by the library; later versions may append fields. */
typedef struct tspace_IndexedFrames {
    const uint32_t* indices; /* one per corner: the new vertex */
    size_t corner_count;
    const uint32_t* source_vertices; /* one per new vertex: the entry of `positions` that it copies */
    /* One per new vertex: the first corner that uses it, or TSPACE_NO_CORNER if there is none. */
    const uint32_t* source_corners;
    /* 3 floats each: one per new vertex: normals of the mesh (see tspace_TangentOptions.normalize_normals), or
     * computed ones. */
    const float* normals;
    const float* tangents; /* 4 floats each: one per new vertex: unit tangent and sign */
    size_t vertex_count;
    const tspace_NormalReport* normal_report; /* null if no normals were computed */
    const tspace_TangentReport* tangent_report;
    const tspace_SanitizeReport* sanitize_report;
} tspace_IndexedFrames;

/* Computes normals if they are missing or requested (tspace_generateNormals) and tangents (tspace_generateTangents),
 * repairs invalid tangents (tspace_sanitizeTangents), and splits vertices whose corners differ in either
 * (tspace_splitVertices). The tangent of each corner equals the result of these calls, bit for bit.
 *
 * A mesh with one index list keeps its vertices and their order, including unused ones (which get a frame from their
 * normal); copies are appended. A mesh without indices, or with an index list per attribute, gets new vertices in
 * the order in which corners first use them: one for all corners with the same bits of position, normal, UV, tangent
 * and `keep_apart` (+0 and -0 of a position are equal, as for normals).
 *
 * mesh       positions; normals or none; UVs (all methods but TSPACE_METHOD_BASIS)
 * execution  threads and memory of all steps; does not affect the result
 * Errors: those of the four calls. O(corners) expected. Thread-safe; same bits for any thread count.
 * In C: *frames is null after an error. Free it with tspace_destroyIndexedFrames. */
tspace_ErrorCode tspace_makeIndexedFrames(const tspace_Mesh* mesh, const tspace_IndexedFramesOptions* options,
                                          const tspace_Execution* execution, tspace_IndexedFrames** frames,
                                          tspace_Error* error) TSPACE_NOEXCEPT;

/* In C: frees a result of tspace_makeIndexedFrames. Null is allowed. */
void tspace_destroyIndexedFrames(tspace_IndexedFrames* frames) TSPACE_NOEXCEPT;

/* == plan_buffers.h ==
 * Tangent plan as one flat array of 32-bit words, for the compute shaders shaders/tspace_evaluate.*. */

/* Optional additions to the plan that tspace_planBuffers writes. */
typedef struct tspace_PlanBufferOptions {
    uint32_t struct_size;
    uint32_t reserved;
    /* For each corner, the index of its vertex in the arrays of a pose; tspace_IndexedFrames.indices can be passed
     * here. Empty: the indices of the plan's mesh are used. */
    const uint32_t* indices;
    size_t index_count;
    /* For each result, the corner that it belongs to; tspace_IndexedFrames.source_corners can be passed here.
     * TSPACE_NO_CORNER: none. Empty: one result per output of tspace_evaluateTangents. */
    const uint32_t* source_corners;
    size_t source_corner_count;
    /* Mesh of the plan, for computing normals from positions in the shader. Corners with equal positions share
     * normals. Without vertices, the default, a pose provides its normals.
     * In C: may be null: no mesh. */
    const tspace_Mesh* mesh;
    /* Options for the normals of `mesh`. Not supported: TSPACE_NORMAL_WEIGHTING_BEST, and `denoise` other than 0.
     * `normals.convention` is used only for a plan of lengyel; plans of other methods store their convention.
     * In C: may be null: the defaults. */
    const tspace_NormalOptions* normals;
} tspace_PlanBufferOptions;

/* Words of a plan: a header of 12 words, and the three arrays that it refers to. All values are 32-bit words in
 * native byte order. docs/guides/gpu.md describes the header, and how to compute a result.
 *
 * Results, 3 words each: index of its first entry; number of its entries (bits 0..27) with flags; its own corner as
 * an entry, or 0xffffffff. Corners that share a tangent and a normal have equal entries.
 * Entries, 1 word each, in the order of summation: a corner of a triangle, 4 * triangle + corner, with flags.
 * 0xffffffff separates parts of a result that is the normalized mean of several.
 * Triangles: three vertices, then UV coefficients as floats: (a, b) with dP/du along a * e1 - b * e2, where e1 = P1
 * - P0, e2 = P2 - P0; for TSPACE_METHOD_LENGYEL (a, b, c, d) with dP/du = a * e1 - b * e2 and dP/dv = c * e2 - d *
 * e1. If a triangle's UV area is nearly lost in rounding, a is 0xffffffff, and b is the index of the first of ten
 * words after the triangles: five doubles, each with its high word first, r, t2, t1, s1, s2, with dP/du = r * (t2 *
 * e1 - t1 * e2) and dP/dv = r * (s1 * e2 - s2 * e1).
 * In C: allocated by the library; later versions may append fields. */
typedef struct tspace_PlanBuffers {
    const uint32_t* words;
    size_t word_count;
    size_t result_count; /* as in the header: number of threads to dispatch */
} tspace_PlanBuffers;

/* Writes the plan as words: about 12 bytes per result, and 32 per triangle for entries and triangles (40 for
 * TSPACE_METHOD_LENGYEL).
 *
 * Errors: INVALID_OPTION for the methods flat, basis and best, for TSPACE_FRAME_SYMMETRIC, for normals that are
 * `best` or denoised, and for a plan with several index lists without `indices`; COUNT_MISMATCH and
 * INDEX_OUT_OF_RANGE for arrays of `options` that do not match the plan; TOO_LARGE above 268,435,455 triangles;
 * those of tspace_generateNormals; OUT_OF_MEMORY.
 * O(n log n) in results, otherwise linear, plus the size of groups that an angular threshold splits. Thread-safe.
 * In C: options may be null: the defaults. *buffers is null after an error. Free it with tspace_destroyPlanBuffers. */
tspace_ErrorCode tspace_planBuffers(const tspace_TangentPlan* plan, const tspace_PlanBufferOptions* options,
                                    const tspace_Execution* execution, tspace_PlanBuffers** buffers,
                                    tspace_Error* error) TSPACE_NOEXCEPT;

/* In C: frees a result of tspace_planBuffers. Null is allowed. */
void tspace_destroyPlanBuffers(tspace_PlanBuffers* buffers) TSPACE_NOEXCEPT;

/* == pack.h ==
 * Packing of whole frames (N, T and the sign) into 4 to 16 bytes, with a guaranteed error bound. All functions are
 * pure, allocate nothing, use one thread, and may be called from any thread at the same time. Their bits are equal
 * on every machine: only arithmetic and square roots, in a fixed order. See docs/concepts/pack.md. */

/* Storage format of a frame, with the maximum error of N and T (tspace_frameErrorBound) in degrees. Numbers are
 * little-endian; "word" means all bytes of one frame as one unsigned number. The enumerators' values are stable and
 * never reused. */
typedef uint32_t tspace_FrameFormat;
enum {
    /* 4 bytes, 0.135: (rotation << 1) | mirrored. The rotation is a cell of a lattice in one of 24 charts. */
    TSPACE_FRAME_FORMAT_FRAME32 = 0,
    /* 6 bytes, N 0.0037 and T 0.0042: ((i * 46339 + j) << 17) | (angle << 1) | mirrored; i, j on a warped
     * octahedron, 65,536 angles. */
    TSPACE_FRAME_FORMAT_FRAME48 = 1,
    /* 8 bytes, N 0.0001 and T 0.00015: i:21 | j:21 | angle:21 | mirrored:1 from the top; like frame48, but finer. */
    TSPACE_FRAME_FORMAT_FRAME64 = 2,
    /* 4 bytes, N 0.15 and T 0.165: i:10 | j:10 | angle:11 | mirrored:1 from the top; the 4-byte format that is
     * cheapest to decode. */
    TSPACE_FRAME_FORMAT_OCT32 = 3,
    /* 8 bytes, 0.004: the quaternion x, y, z, w of the rotation (T, N x T, N) as snorm16; w is never 0, and its sign
     * is the sign of the frame. */
    TSPACE_FRAME_FORMAT_QTANGENT64 = 4,
    /* 8 bytes, 0.391: T.xyz, 127, N.xyz, sign as snorm8: the order of Unreal's TangentX and TangentZ. */
    TSPACE_FRAME_FORMAT_SNORM8_PAIR = 5,
    /* 16 bytes, 0.00152: like TSPACE_FRAME_FORMAT_SNORM8_PAIR, but as snorm16. */
    TSPACE_FRAME_FORMAT_SNORM16_PAIR = 6,
    /* 7 bytes, 0.391: TANGENT (4 snorm8), then NORMAL (3 snorm8), as KHR_mesh_quantization stores them, without
     * padding. */
    TSPACE_FRAME_FORMAT_GLTF_SNORM8 = 7,
    /* 14 bytes, 0.00152: like TSPACE_FRAME_FORMAT_GLTF_SNORM8, but as snorm16. */
    TSPACE_FRAME_FORMAT_GLTF_SNORM16 = 8
};

/* Returns the number of bytes of one frame; 0 if `format` is not an enumerator. */
size_t tspace_frameBytes(tspace_FrameFormat format) TSPACE_NOEXCEPT;

/* Maximum angle between an unpacked frame and the frame that was packed, in degrees. */
typedef struct tspace_FrameErrorBound {
    double normal_deg;
    double tangent_deg;
} tspace_FrameErrorBound;

/* Returns bounds that tspace_packFrames followed by tspace_unpackFrames never exceeds. They refer to the packed
 * frame: the input if it is valid, otherwise its repaired value. The sign is always exact. Returns zeros if `format`
 * is not an enumerator. */
tspace_FrameErrorBound tspace_frameErrorBound(tspace_FrameFormat format) TSPACE_NOEXCEPT;

/* Frames repaired before packing. Each is counted once, by the first cause that applies, in this order. */
typedef struct tspace_PackReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t bad_normal_count;     /* N zero or not finite: replaced by (0, 0, 1) */
    uint64_t not_finite_count;     /* NaN or infinity in the tangent: replaced by a basis from N */
    uint64_t zero_count;           /* tangent of length 0 (or too small to normalize): replaced by a basis from N */
    uint64_t parallel_count;       /* tangent within 1 degree of +N or -N: replaced by a basis from N */
    uint64_t not_unit_count;       /* length of N or T off by more than 5e-4: normalized */
    uint64_t not_orthogonal_count; /* cosine between N and T beyond 5e-4: T made orthogonal to N */
    uint64_t bad_sign_count;       /* sign not exactly +1 or -1: below 0 becomes -1, other values +1 */
    uint64_t mended_count;         /* Returns the number of repaired frames: the sum of the causes. */
} tspace_PackReport;

/* Packs frames independently of each other, each to the nearest code. Accepts any input: invalid frames are repaired
 * and counted. Smaller deviations than those that the report counts are normalized and orthogonalized without being
 * counted.
 *
 * normals   3 floats each: one per frame, unit
 * tangents  4 floats each: one per frame, unit and orthogonal to N; w is the sign, +1 or -1
 * out       exactly tspace_frameBytes(format) bytes per frame, without padding, any alignment; must not overlap the
 *           inputs
 * Errors: INVALID_OPTION (format), COUNT_MISMATCH (tangents, or the size of `out`), NULL_DATA, STRIDE_TOO_SMALL,
 * MISALIGNED. On error nothing is written. O(frames).
 * In C: out may be null if there are no frames. */
tspace_ErrorCode tspace_packFrames(tspace_ConstSpan normals, tspace_ConstSpan tangents, tspace_FrameFormat format,
                                   void* out, size_t out_bytes, tspace_PackReport* report,
                                   tspace_Error* error) TSPACE_NOEXCEPT;

/* Unpacks frames. All byte values are valid: N and T are finite and unit within 5e-7, and w is +1 or -1. T is also
 * orthogonal to N within 5e-7, except for formats that store N and T separately (TSPACE_FRAME_FORMAT_SNORM8_PAIR,
 * TSPACE_FRAME_FORMAT_SNORM16_PAIR, TSPACE_FRAME_FORMAT_GLTF_SNORM8, TSPACE_FRAME_FORMAT_GLTF_SNORM16): these return
 * the stored vectors, normalized, as a shader does. A zero N becomes (0, 0, 1), a zero T a basis from N. Packing
 * unpacked frames of frame32, frame48, frame64 or oct32 again in the same format gives words that unpack to the same
 * frames.
 *
 * bytes     exactly tspace_frameBytes(format) bytes per frame
 * normals   3 floats each: one per frame, written
 * tangents  4 floats each: one per frame, written; w is the sign
 * Errors: as tspace_packFrames. O(frames). */
tspace_ErrorCode tspace_unpackFrames(const void* bytes, size_t byte_count, tspace_FrameFormat format,
                                     tspace_Span normals, tspace_Span tangents, tspace_Error* error) TSPACE_NOEXCEPT;

/* == winding.h ==
 * Fixes the winding of faces: faces wound against their neighbors, and components that are inside out. */

typedef struct tspace_WindingOptions {
    uint32_t struct_size;
    /* Handedness and winding define the corner order of a face seen from outside. Default: glTF. */
    tspace_Convention convention;
    /* 0 or 1. 1: the mesh's normals, if present and consistent within a component, decide which side of it is
     * outside. Default: 1. */
    uint32_t use_normals;
    /* 0 or 1. 1: weld vertices with equal positions (so a non-indexed mesh is a connected surface); 0: weld by index
     * only. Default: 1. */
    uint32_t weld_positions;
    /* With `weld_positions`: maximum difference per coordinate of welded positions. Same meaning as
     * tspace_NormalOptions.weld_distance. 0, the default: only equal positions. -1: derived from the spacing of
     * floats. */
    float weld_distance;
} tspace_WindingOptions;

/* In C: initializes options like TSPACE_INIT, for languages without macros.
 * struct_size  size of the struct as declared by the caller, in bytes. If this version does not support the size:
 *              INVALID_OPTION, and nothing is written.
 * Functions reject zero-filled options, including a zero convention (INVALID_OPTION). To set both use_normals and
 * weld_positions to 0, set a convention with tspace_findConvention.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_initWindingOptions(tspace_WindingOptions* options, uint32_t struct_size,
                                           tspace_Error* error) TSPACE_NOEXCEPT;

/* Results of tspace_mendWinding. A *component* is a set of faces connected by pairs of faces at edges. A pair is in
 * *conflict* if both faces traverse their shared edge in the same direction. */
typedef struct tspace_WindingReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t face_count;   /* faces with at least 3 corners */
    uint64_t turned_count; /* faces to flip */
    uint64_t conflict_count_before;
    uint64_t conflict_count_after; /* conflicts left after flipping */
    uint64_t component_count;
    uint64_t turned_component_count; /* components in which more than half of the faces are flipped */

    uint64_t by_normals_count; /* normals of the mesh */
    uint64_t by_volume_count;  /* closed: the volume must be positive */
    /* Closed, inside another component: keeps the winding of most of its area; if that is undecided, it is a cavity. */
    uint64_t by_nesting_count;
    /* Open, but with an inside: decided by the generalized winding number at its own faces. */
    uint64_t by_winding_number_count;
    uint64_t by_majority_count; /* open, without an inside: keeps the winding of most of its area */
    /* Fewer than 4 faces, such as leaves and cards: never flipped, because nothing shows their outside. */
    uint64_t small_count;
    /* Flipping single faces would not reduce the number of conflicts, as on a Moebius band. No face is flipped, or
     * all faces if the component is open and its winding number shows that it is inside out. */
    uint64_t one_sided_count;
} tspace_WindingReport;

/* Determines which faces to flip (reverse the order of their corners) so that neighboring faces have consistent
 * winding and the outside matches the convention.
 *
 * Faces are paired at shared edges. If more than two faces meet at an edge, two that share it by index are paired;
 * other faces are sorted by angle around the edge and adjacent ones are paired (of the two possible pairings, the
 * one with the smaller gaps; of an odd number, only the straightest pair). Pairs by angle that contradict other
 * pairs are dropped. Coincident faces keep their relative winding, so two-sided sheets stay two-sided.
 * Winding is first made consistent within each component; then the first applicable rule of tspace_WindingReport
 * decides the component as a whole. An open surface without an inside (such as a terrain) that is entirely inverted
 * and has no normals cannot be detected; it is left unchanged.
 *
 * mesh       positions and indices, and normals with options.use_normals; UVs are ignored
 * turned     one per face: 1 to flip it, else 0; must not overlap the inputs
 * execution  threads and memory; does not affect the result
 * Errors: those of tspace_validate; COUNT_MISMATCH (turned), OUT_OF_MEMORY.
 * O(corners), except for sorting the edges of one point, and O(n log n) for nested closed components. Scratch
 * memory: 16 bytes per corner, 32 per face, 28 per vertex, and 50 more per face for nested closed components.
 * Thread-safe; same bits for any thread count.
 * In C: `turned` has face_count bytes. */
tspace_ErrorCode tspace_mendWinding(const tspace_Mesh* mesh, const tspace_WindingOptions* options, uint8_t* turned,
                                    size_t turned_count, const tspace_Execution* execution,
                                    tspace_WindingReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* For TSPACE_INIT: the defaults that are not zero. scripts/api writes the bodies of these functions. */
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
