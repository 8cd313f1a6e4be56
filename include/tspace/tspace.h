/* SPDX-License-Identifier: MIT */
/* The C API of the core library: everything that the C++ headers offer, for C11 and for bindings.
 *
 * Words: a *face* is a triangle, quad or n-gon; a *corner* is one (face, local vertex) pair, numbered face
 * after face; a *vertex* is one entry of the vertex arrays. A *sign* is +1 or -1: B = sign * cross(N, T).
 *
 * Rules that hold for every function:
 * - A function that can fail returns TSPACE_OK or an error code. Its last parameter `error` may be null;
 *   otherwise it is written in either case (code TSPACE_OK and an empty message after success).
 * - Structs that start with `struct_size` are prepared with TSPACE_INIT, which sets the size and every default; what
 *   has no other default is zero. Fields are only ever added at the end, and the size says which a program knows: one
 *   that was compiled with an older header works with a newer library. A size that this version does not know is
 *   TSPACE_ERROR_INVALID_OPTION.
 * - Options and reports may be null: default options, no report wanted. (Tangents need options: a convention has no
 *   default.) A report is written only on success.
 * - Arrays are the caller's. Inputs are read during the call only. Outputs must not overlap inputs or each
 *   other.
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

/* Why a call failed. The numbers are stable, the same in C++, and never reused. */
typedef uint32_t tspace_ErrorCode;
enum {
    TSPACE_OK = 0,
    TSPACE_ERROR_NULL_DATA = 1,          /* a pointer is null although it is needed, or its count is not zero */
    TSPACE_ERROR_COUNT_MISMATCH = 2,     /* two arrays that must have the same length do not */
    TSPACE_ERROR_INDEX_OUT_OF_RANGE = 3, /* an index is not smaller than the number of vertices */
    TSPACE_ERROR_STRIDE_TOO_SMALL = 4,   /* elements of a span would overlap */
    TSPACE_ERROR_MISALIGNED = 5,         /* a pointer or stride is not a multiple of its element's alignment */
    TSPACE_ERROR_TOO_LARGE = 6,          /* a size does not fit: the sum of face sizes, or more than 2^31-1 corners */
    TSPACE_ERROR_MISSING_ATTRIBUTE = 7,  /* the mesh does not have the normals or UVs that the method needs */
    TSPACE_ERROR_INVALID_OPTION = 8,     /* a value outside its range, or a struct of an unknown size */
    TSPACE_ERROR_OUT_OF_MEMORY = 9,      /* the allocator returned null */
    TSPACE_ERROR_PLAN_MISMATCH = 10,     /* arrays do not fit the plan they are evaluated with */
    TSPACE_ERROR_INTERNAL = 11,          /* a defect of tspace; please report it */
    TSPACE_ERROR_INVALID_FILE = 100,     /* 100 and up: model files; no function of this header returns these */
    TSPACE_ERROR_UNSUPPORTED_FILE = 101,
    TSPACE_ERROR_FORBIDDEN_PATH = 102,
    TSPACE_ERROR_CANNOT_READ = 103,
    TSPACE_ERROR_CANNOT_WRITE = 104
};

/* Element of an error that is about no element in particular. */
#define TSPACE_NO_ELEMENT UINT64_MAX

/* What went wrong. The layout of this struct never changes. */
typedef struct tspace_Error {
    tspace_ErrorCode code;
    uint32_t reserved; /* 0 */
    uint64_t element;  /* index of the offending element, or TSPACE_NO_ELEMENT */
    char message[240]; /* one sentence in UTF-8 without line break, ended by 0; cut when it is longer */
} tspace_Error;

/* Stable identifier of a code in lowerCamelCase ("indexOutOfRange"), "unknown" for other numbers. Static
 * memory. */
const char* tspace_errorName(tspace_ErrorCode code) TSPACE_NOEXCEPT;

/* `count` elements of some floats each, the first at `data`, each `stride_bytes` after the one before. How
 * many floats an element has is said where the span is used. stride_bytes 0: tightly packed. data may be null
 * when count is 0. Strides are multiples of 4 and at least the size of an element. */
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

/* Bytes of one index. */
typedef uint32_t tspace_IndexType;
enum {
    TSPACE_INDEX_NONE = 0,
    TSPACE_INDEX_U8 = 1,
    TSPACE_INDEX_U16 = 2,
    TSPACE_INDEX_U32 = 4,
    TSPACE_INDEX_CORNERS = 8 /* for normal_indices and uv_indices: corner c uses entry c, without a list in memory */
};

/* Tightly packed indices, one per corner. TSPACE_INDEX_NONE (count 0): corner c uses vertex c. */
typedef struct tspace_Indices {
    const void* data;
    size_t count;
    tspace_IndexType type;
} tspace_Indices;

/* A mesh: views of the caller's arrays. Only positions are always needed; each function says what else it
 * uses. */
typedef struct tspace_Mesh {
    uint32_t struct_size;
    uint32_t face_size;         /* corners of every face when face_sizes is null; 0 means 3 */
    tspace_ConstSpan positions; /* 3 floats per vertex */
    tspace_ConstSpan normals;   /* 3 floats per vertex, used as given (never normalised), or empty */
    tspace_ConstSpan uvs;       /* 2 floats per vertex, or empty */
    tspace_Indices indices;     /* one per corner, or none */
    const uint32_t* face_sizes; /* corners of each face, or null; faces of 0, 1 or 2 corners are ignored */
    size_t face_count;          /* entries of face_sizes */
    /* One per corner, into normals and uvs, which then have any number of entries. TSPACE_INDEX_NONE: these attributes
     * have one entry per vertex, and follow `indices`. TSPACE_INDEX_CORNERS (data null, count 0): they have one entry
     * per corner. Corners count as one vertex, as if the mesh had one list, where their three indices are equal, and for
     * TSPACE_INDEX_CORNERS where the entries have the same bits. */
    tspace_Indices normal_indices;
    tspace_Indices uv_indices;
} tspace_Mesh;

/* Corners of a mesh: the length of results. Not checked: call tspace_validate for that. 0 for null. */
size_t tspace_cornerCount(const tspace_Mesh* mesh) TSPACE_NOEXCEPT;
/* Faces of a mesh, unchecked as well. 0 for null. */
size_t tspace_faceCount(const tspace_Mesh* mesh) TSPACE_NOEXCEPT;

/* Checks pointers, counts, strides, alignment, every index, and that face sizes add up. Values of floats may
 * be anything. Every function that takes a mesh does this first; call it only to get the error early.
 * mesh      not null
 * Errors: NULL_DATA, COUNT_MISMATCH, INDEX_OUT_OF_RANGE, STRIDE_TOO_SMALL, MISALIGNED, TOO_LARGE,
 *         INVALID_OPTION.
 * O(corners), no memory. */
tspace_ErrorCode tspace_validate(const tspace_Mesh* mesh, tspace_Error* error) TSPACE_NOEXCEPT;

/* The caller's job system. `run` must call task(context, i) exactly once for each i in [0, task_count), on
 * any threads and in any order, and return when all are done. Tasks never call back into `run`. */
typedef struct tspace_Executor {
    void (*run)(void* user, size_t task_count, void (*task)(void* context, size_t task_index), void* context);
    void* user;
    uint32_t concurrency; /* how many tasks can run at the same time; 0 means 1 */
} tspace_Executor;

/* The caller's memory. `allocate` returns memory of that alignment (a power of two, at most 64) or null,
 * which makes the call fail with OUT_OF_MEMORY. Both are called from the calling thread only. */
typedef struct tspace_Allocator {
    void* (*allocate)(void* user, size_t bytes, size_t alignment);
    void (*release)(void* user, void* memory, size_t bytes, size_t alignment);
    void* user;
} tspace_Allocator;

/* The instructions that the hot loops use. */
typedef uint32_t tspace_SimdTarget;
enum {
    TSPACE_SIMD_BEST = 0, /* the best that this CPU has */
    TSPACE_SIMD_SCALAR = 1,
    TSPACE_SIMD_SSE2 = 2, /* x86-64 without anything else */
    TSPACE_SIMD_AVX2 = 3,
    TSPACE_SIMD_AVX512 = 4, /* F and DQ */
    TSPACE_SIMD_NEON = 5    /* 64-bit ARM, every CPU */
};

/* For tspace_Execution.thread_count: as many as there are cores. */
#define TSPACE_ALL_THREADS UINT32_MAX

/* Where work runs and where its memory comes from. Neither changes a bit of any result. The structs are read
 * during the call only; the functions in them, and `user`, must outlive a plan that was made with them. */
typedef struct tspace_Execution {
    const tspace_Executor* executor;   /* runs all work, whatever thread_count says; null: threads joined in the call */
    const tspace_Allocator* allocator; /* null: operator new. For scratch memory and plans */
    uint32_t thread_count;             /* 0 and 1: the calling thread only; TSPACE_ALL_THREADS */
    tspace_SimdTarget simd; /* for tests and measurements; what the CPU lacks becomes the best of a lower number */
} tspace_Execution;

/* Memory that is kept from call to call: from the second call on, no page is taken from the system. For one call at
 * a time, so one for each thread that makes calls. It must outlive the plans whose memory it holds. */
typedef struct tspace_Arena tspace_Arena;

/* Makes an arena, which holds nothing at first.
 * arena     not null; *arena is null after an error. End it with tspace_destroyArena.
 * Errors: NULL_DATA, OUT_OF_MEMORY. */
tspace_ErrorCode tspace_createArena(tspace_Arena** arena, tspace_Error* error) TSPACE_NOEXCEPT;

/* For tspace_Execution.allocator; valid as long as the arena. `arena` is not null. */
const tspace_Allocator* tspace_arenaAllocator(const tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Bytes that the arena holds, in use or not: about the most that was in use at one time, and up to 2 MiB. `arena` is
 * not null. */
size_t tspace_arenaHeldBytes(const tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Gives back what lies behind the last allocation in use; between calls without plans, everything. `arena` is not
 * null. */
void tspace_trimArena(tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Frees an arena. Null is allowed. */
void tspace_destroyArena(tspace_Arena* arena) TSPACE_NOEXCEPT;

/* Where v = 0 lies in the texture. It decides every sign, so nothing stands for it when it is not said. */
typedef uint32_t tspace_VAxis;
enum {
    TSPACE_V_UNSET = 0, /* not said: what computes tangents then fails with INVALID_OPTION */
    TSPACE_V_UP = 1,    /* bottom row of the image */
    TSPACE_V_DOWN = 2   /* top row */
};

/* What a large green value in a normal map means. */
typedef uint32_t tspace_Green;
enum {
    TSPACE_GREEN_UP = 0,  /* towards the top row ("OpenGL") */
    TSPACE_GREEN_DOWN = 1 /* towards the bottom row ("DirectX") */
};

/* Whether the stored sign is the one of B = sign * cross(N, T) or its negative. */
typedef uint32_t tspace_StoredSign;
enum { TSPACE_SIGN_AS_IS = 0, TSPACE_SIGN_NEGATED = 1 };

typedef uint32_t tspace_Handedness;
enum { TSPACE_HANDEDNESS_RIGHT = 0, TSPACE_HANDEDNESS_LEFT = 1 };

/* Order of a face's vertices as seen from outside. */
typedef uint32_t tspace_Winding;
enum { TSPACE_WINDING_COUNTER_CLOCKWISE = 0, TSPACE_WINDING_CLOCKWISE = 1 };

/* What the sign of a tangent means and which side of a face is out. There is no default for tangents: take a preset,
 * "gltf" for glTF. "opengl" is the plain mathematical reading, under which the method mikktspace gives the reference's
 * sign. Normals look at the last two fields only. */
typedef struct tspace_Convention {
    tspace_VAxis v_axis;
    tspace_Green green;
    tspace_StoredSign stored_sign;
    tspace_Handedness handedness;
    tspace_Winding winding;
} tspace_Convention;

/* Finds a preset by its name: "gltf", "opengl", "directx", "unreal", "unity", "blender" or "godot".
 * name      0-ended, lower case, not null
 * out       not null; written after success only
 * Errors: NULL_DATA, INVALID_OPTION (no such preset). */
tspace_ErrorCode tspace_findConvention(const char* name, tspace_Convention* out, tspace_Error* error) TSPACE_NOEXCEPT;

/* +1 or -1: what the sign of dP/dv over the UVs as given is multiplied with before it is stored. */
float tspace_signFactor(tspace_Convention convention) TSPACE_NOEXCEPT;
/* +1 or -1: what cross(P1-P0, P2-P0) is multiplied with to point outside. */
float tspace_normalFactor(tspace_Convention convention) TSPACE_NOEXCEPT;

/* How much a face counts in the mean at one of its corners. e1, e2 are the edges, a the angle between. */
typedef uint32_t tspace_NormalWeighting;
enum {
    TSPACE_NORMAL_WEIGHTING_FLAT = 0,    /* no averaging: each corner gets its face's unit normal */
    TSPACE_NORMAL_WEIGHTING_UNIFORM = 1, /* 1: mean of unit face normals (Gouraud 1971) */
    TSPACE_NORMAL_WEIGHTING_AREA = 2,    /* |e1 x e2| */
    TSPACE_NORMAL_WEIGHTING_ANGLE = 3,   /* a: independent of tessellation (Thuermer & Wuethrich 1998); the default */
    TSPACE_NORMAL_WEIGHTING_ANGLE_AREA = 4, /* a * area */
    TSPACE_NORMAL_WEIGHTING_MAX = 5,        /* sin(a) / (|e1| |e2|): exact on a sphere (Max 1999) */
    TSPACE_NORMAL_WEIGHTING_BEST = 6        /* quadratic fit; angle * area on noise and bevels */
};

typedef struct tspace_NormalOptions {
    uint32_t struct_size;
    tspace_NormalWeighting weighting; /* default: angle */
    /* Degrees, 0 to 180; default 180: never hard. Two faces that share an edge are smoothed over it only when their
     * normals differ by no more than this. */
    float crease_angle_deg;
    uint32_t smoothing_groups_are_masks; /* 0 or 1; 1: faces with a bit in common smooth together */
    /* One number per face, or null. Faces smooth together only when their numbers are equal and not 0. */
    const uint32_t* smoothing_groups;
    size_t smoothing_group_count; /* entries of smoothing_groups */
    /* 0 or 1; default 1: vertices at the same position are one point, so that UV seams stay smooth. 0: only equal
     * indices are. */
    uint32_t weld_positions;
    tspace_Convention convention; /* handedness and winding say which side is out */
    tspace_Execution execution;
    uint32_t refine; /* 0, 1 or 2 steps that TSPACE_NORMAL_WEIGHTING_BEST takes after its fit; default 1 */
} tspace_NormalOptions;

/* What was met. Broken input is counted and never makes a call fail. */
typedef struct tspace_NormalReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t face_count;            /* faces with at least 3 corners */
    uint64_t degenerate_face_count; /* faces without a normal (zero area or not finite) */
    uint64_t fallback_corner_count; /* corners whose mean vanished and that got a substitute */
} tspace_NormalReport;

/* Computes one unit normal per corner: the weighted mean of the unit face normals (Newell's sum) of the faces
 * that are connected to the corner's face around the vertex over smooth edges. A mean that vanishes is
 * replaced by the face's own normal, then by the mean of the other faces, then by (0, 0, 1). Corners of faces
 * with fewer than 3 corners get zeros.
 * mesh      not null; positions and indices are used
 * out       3 floats per corner; count = tspace_cornerCount(mesh)
 * Errors: those of tspace_validate; COUNT_MISMATCH, INVALID_OPTION, OUT_OF_MEMORY.
 * O(corners). Scratch memory: about 18 bytes per triangle for a mesh of triangles without hard edges, else
 * about 40 bytes per corner. */
tspace_ErrorCode tspace_generateNormals(const tspace_Mesh* mesh, const tspace_NormalOptions* options, tspace_Span out,
                                        tspace_NormalReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* How tangents are computed. */
typedef uint32_t tspace_Method;
enum {
    TSPACE_METHOD_MIKKTSPACE = 0, /* for triangles and quads every bit of the reference (Mikkelsen 2008) */
    TSPACE_METHOD_LENGYEL = 1,    /* sum of dP/du and dP/dv at a vertex index (Lengyel 2001); never splits */
    TSPACE_METHOD_UNIFORM = 2,    /* weighted mean of unit face tangents in groups; the weight is 1, */
    TSPACE_METHOD_ANGLE = 3,      /* the corner's angle, */
    TSPACE_METHOD_AREA = 4,       /* or the face's area */
    TSPACE_METHOD_FLAT = 5,       /* the face's own dP/du, made orthogonal to N */
    TSPACE_METHOD_BASIS = 6,      /* without UVs: a basis from N alone (Duff et al. 2017) */
    TSPACE_METHOD_FAST = 7,       /* in groups: two weighted sums of dP/du, mixed by the angle between them */
    TSPACE_METHOD_BEST = 8        /* in groups: a quadratic map from UVs to space, fitted around each vertex */
};

/* How mikktspace finds neighbouring faces. */
typedef uint32_t tspace_Pairing;
enum {
    TSPACE_PAIRING_REFERENCE = 0, /* with the reference's defect: its last bucket of edges is not sorted */
    TSPACE_PAIRING_CORRECTED = 1  /* without it */
};

/* What happens to faces with more than 4 corners, which the MikkTSpace reference ignores. */
typedef uint32_t tspace_Ngons;
enum {
    TSPACE_NGONS_TRIANGULATE = 0, /* cut as by tspace_triangulate; results are per corner of the n-gon */
    TSPACE_NGONS_SKIP = 1         /* nothing is computed, outputs are 0 */
};

/* What one entry of the outputs belongs to. */
typedef uint32_t tspace_OutputDomain;
enum {
    TSPACE_DOMAIN_CORNER = 0,
    TSPACE_DOMAIN_VERTEX = 1 /* LENGYEL and BASIS only: one entry per vertex of the mesh, the one that its corners
                              * would get; 0 for vertices that no used face names */
};

/* Which orthonormal frame stands for dP/du and dP/dv, where UVs are sheared. */
typedef uint32_t tspace_FrameShape;
enum {
    TSPACE_FRAME_GRAM_SCHMIDT = 0, /* T is the direction of dP/du */
    TSPACE_FRAME_SYMMETRIC = 1     /* T is the bisector of dP/du and of the direction perpendicular to dP/dv; not for
                                    * MIKKTSPACE and BASIS */
};

typedef struct tspace_TangentOptions {
    uint32_t struct_size;
    tspace_Method method;
    /* Degrees; default 180, as in the reference. mikktspace only: faces of one group whose tangents (or bitangents)
     * differ by this or more are not averaged. */
    float angular_threshold_deg;
    tspace_Pairing pairing; /* mikktspace only */
    tspace_Ngons ngons;
    tspace_OutputDomain domain;
    tspace_Convention convention; /* decides the stored sign; has no default: tspace_findConvention */
    tspace_Execution execution;
    tspace_FrameShape frame;
    uint32_t refine; /* 0, 1 or 2 steps that TSPACE_METHOD_BEST takes after its fit; default 1 */
} tspace_TangentOptions;

/* What was met. Broken input is counted and never makes a call fail. */
typedef struct tspace_TangentReport {
    uint32_t struct_size;
    /* 1: the reference would take quadratic time, so its last step was left out: the last bucket was paired as
     * CORRECTED does, or a group of more than 4096 faces was not split by the threshold */
    uint32_t reference_order_abandoned;
    uint64_t triangle_count;            /* triangles computed with, after cutting quads and n-gons */
    uint64_t degenerate_triangle_count; /* two corners at the same position */
    uint64_t degenerate_uv_count;       /* triangles without UV area: they take their neighbours' frame */
    uint64_t mirrored_count;            /* triangles with negative UV area */
    uint64_t skipped_face_count;        /* faces for which nothing was computed */
    uint64_t group_count;               /* sets of corners that share one tangent */
    uint64_t default_corner_count;      /* outputs that no face gives a tangent: they hold the method's default */
    uint64_t not_finite_count;          /* outputs whose tangent has a NaN or infinity */
} tspace_TangentReport;

/* Where results go: one entry per corner (or vertex, see tspace_OutputDomain). Only tangents is required; empty spans
 * are not written. */
typedef struct tspace_TangentOutput {
    uint32_t struct_size;
    uint32_t reserved;
    tspace_Span tangents;     /* 4 floats: unit tangent and sign */
    tspace_Span bitangents;   /* 3 floats: unit direction of dP/dv; in general not cross(N, T) */
    tspace_Span magnitudes_s; /* 1 float: mean length of dP/du; 1 for methods without */
    tspace_Span magnitudes_t; /* 1 float: mean length of dP/dv; 1 for methods without */
} tspace_TangentOutput;

/* Computes tangents for a mesh in one call.
 * mesh      not null; positions and normals are used, and UVs by all methods but BASIS
 * options   not null, since its convention has no default
 * out       not null; spans of tspace_cornerCount(mesh) entries (or as many as vertices: DOMAIN_VERTEX)
 * Corners of faces with fewer than 3 corners (and of n-gons with NGONS_SKIP) get 0 in every output.
 * Errors: those of tspace_validate; MISSING_ATTRIBUTE, COUNT_MISMATCH, INVALID_OPTION, OUT_OF_MEMORY.
 * Linear in the number of corners whatever the input. docs/methods has a page for each method. */
tspace_ErrorCode tspace_generateTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                         const tspace_TangentOutput* out, tspace_TangentReport* report,
                                         tspace_Error* error) TSPACE_NOEXCEPT;

/* Everything about a mesh that does not change while it deforms: welding, neighbours, groups, splits, UVs.
 * Immutable, so that many threads may evaluate one plan at the same time. Keeps no pointer into the mesh. */
typedef struct tspace_TangentPlan tspace_TangentPlan;

/* Makes a plan. Inputs, errors and complexity as tspace_generateTangents.
 * plan      not null; *plan is null after an error. End it with tspace_destroyTangentPlan. */
tspace_ErrorCode tspace_planTangents(const tspace_Mesh* mesh, const tspace_TangentOptions* options,
                                     tspace_TangentPlan** plan, tspace_Error* error) TSPACE_NOEXCEPT;

/* The shape of a mesh at one moment. Counts and meaning as in tspace_Mesh. */
typedef struct tspace_Pose {
    uint32_t struct_size;
    uint32_t reserved;
    tspace_ConstSpan positions; /* 3 floats per vertex */
    tspace_ConstSpan normals;   /* 3 floats per vertex */
} tspace_Pose;

/* Computes frames for a pose with the plan's groups and splits. On the pose the plan was made from the result
 * is bit for bit that of tspace_generateTangents.
 * plan, pose, out   not null
 * execution         replaces the plan's; null: default
 * Errors: PLAN_MISMATCH when counts differ from the plan's; NULL_DATA, COUNT_MISMATCH (outputs),
 *         STRIDE_TOO_SMALL, MISALIGNED, INVALID_OPTION, OUT_OF_MEMORY.
 * O(corners). */
tspace_ErrorCode tspace_evaluateTangents(const tspace_TangentPlan* plan, const tspace_Pose* pose,
                                         const tspace_TangentOutput* out, const tspace_Execution* execution,
                                         tspace_TangentReport* report, tspace_Error* error) TSPACE_NOEXCEPT;

/* What a plan is for. */
typedef struct tspace_TangentPlanInfo {
    uint32_t struct_size;
    tspace_Method method;
    size_t vertex_count;
    size_t corner_count;
    size_t output_count; /* entries of every output: corners or vertices */
    size_t memory_bytes; /* held by the plan */
} tspace_TangentPlanInfo;

/* Describes a plan. plan and info are not null; info is written after success only.
 * Errors: NULL_DATA, INVALID_OPTION. */
tspace_ErrorCode tspace_describeTangentPlan(const tspace_TangentPlan* plan, tspace_TangentPlanInfo* info,
                                            tspace_Error* error) TSPACE_NOEXCEPT;

/* Frees a plan. Null is allowed. */
void tspace_destroyTangentPlan(tspace_TangentPlan* plan) TSPACE_NOEXCEPT;

typedef struct tspace_SanitizeOptions {
    uint32_t struct_size;
    /* 0 or 1. 1: also make every sound tangent unit and orthogonal to N; the result then no longer matches a
     * bake. */
    uint32_t orthogonalize_all;
    tspace_Execution execution;
} tspace_SanitizeOptions;

/* Corners mended, by cause (the first that applies, in this order) and by cure. */
typedef struct tspace_SanitizeReport {
    uint32_t struct_size;
    uint32_t reserved;
    uint64_t not_finite_count;     /* NaN or infinity in the tangent */
    uint64_t zero_count;           /* length 0 (or too small to be normalised) */
    uint64_t not_unit_count;       /* length off by more than 5e-4 */
    uint64_t parallel_count;       /* within 1 degree of +N or -N */
    uint64_t bad_sign_count;       /* sign not exactly +1 or -1 */
    uint64_t mixed_sign_count;     /* sign changed because the face's corners disagreed */
    uint64_t orthogonalized_count; /* sound ones changed by orthogonalize_all */
    uint64_t normalized_count;     /* cure: own direction, made unit and orthogonal to N */
    uint64_t from_neighbor_count;  /* cure: direction of a sound corner of the same face or position */
    uint64_t from_basis_count;     /* cure: basis from N alone (Duff et al. 2017) */
    uint64_t bad_normal_count;     /* corners whose N is zero or not finite */
    uint64_t mended_count;         /* all corners that were written: the sum of the causes */
    uint64_t placeholder_count;    /* cause: exactly (1, 0, 0), and not in the plane across N; after parallel */
} tspace_SanitizeReport;

/* Mends tangents in place: those that are not finite, zero, not unit, parallel to N, placeholders that lean
 * out of the surface (the (1, 0, 0) of corners around which no triangle has UV area), or whose sign is not +-1 or
 * differs inside a face. What is written is unit and orthogonal to the corner's N within 1e-6. Sound
 * tangents keep every bit.
 * mesh      not null; positions and normals are used
 * tangents  4 floats per corner, read and written
 * Errors: those of tspace_validate; MISSING_ATTRIBUTE, COUNT_MISMATCH, INVALID_OPTION, OUT_OF_MEMORY.
 * O(corners). */
tspace_ErrorCode tspace_sanitizeTangents(const tspace_Mesh* mesh, const tspace_SanitizeOptions* options,
                                         tspace_Span tangents, tspace_SanitizeReport* report,
                                         tspace_Error* error) TSPACE_NOEXCEPT;

/* One attribute given per corner. */
typedef struct tspace_CornerAttribute {
    const float* data;        /* not null unless there are no corners */
    size_t stride_bytes;      /* from corner to corner; 0 means tightly packed */
    uint32_t component_count; /* floats per corner, 1..16 */
    /* 0: corners are equal only when all bits are. Above 0: equal when every component differs by at most
     * this from the first corner that got the vertex. */
    float tolerance;
} tspace_CornerAttribute;

/* Marks a vertex that no corner uses. */
#define TSPACE_NO_CORNER UINT32_MAX

/* The new index buffer and where each new vertex comes from. Made by the library; later versions may append
 * fields. */
typedef struct tspace_SplitResult {
    const uint32_t* indices; /* one per corner: the new vertex */
    size_t corner_count;
    /* One per new vertex: the old vertex that it copies. Old vertices keep their place, copies are appended.
     * Gather every vertex attribute, skin weight and morph target through it. */
    const uint32_t* source_vertices;
    /* One per new vertex: the corner whose attribute values belong to it, or TSPACE_NO_CORNER. */
    const uint32_t* source_corners;
    size_t vertex_count;
} tspace_SplitResult;

/* Splits vertices whose corners disagree in any of the attributes. The first corner of an old vertex keeps
 * it; each corner that equals none of the vertex's earlier variants gets a copy, appended in corner order.
 * indices          the old vertex of each corner; null: corner c uses vertex c
 * vertex_count     number of old vertices
 * corner_count     length of every attribute; equals indices->count unless there are none
 * attributes       attribute_count entries; may be null when that is 0
 * execution        null: default
 * result           not null; *result is null after an error. Free it with tspace_destroySplitResult.
 * Errors: NULL_DATA, COUNT_MISMATCH, INDEX_OUT_OF_RANGE, STRIDE_TOO_SMALL, TOO_LARGE, INVALID_OPTION,
 *         OUT_OF_MEMORY.
 * O(corners) expected. The result holds 4 bytes per corner and 8 per new vertex. */
tspace_ErrorCode tspace_splitVertices(const tspace_Indices* indices, size_t vertex_count, size_t corner_count,
                                      const tspace_CornerAttribute* attributes, size_t attribute_count,
                                      const tspace_Execution* execution, tspace_SplitResult** result,
                                      tspace_Error* error) TSPACE_NOEXCEPT;

/* Frees a result of tspace_splitVertices. Null is allowed. */
void tspace_destroySplitResult(tspace_SplitResult* result) TSPACE_NOEXCEPT;

/* How tspace_makeIndexedFrames works. */
typedef struct tspace_IndexedFramesOptions {
    uint32_t struct_size;
    uint32_t make_normals;      /* 0 or 1; 1: also where the mesh has normals. Made anyway where it has none */
    uint32_t sanitize;          /* 0 or 1; default 1: mend tangents as tspace_sanitizeTangents */
    uint32_t orthogonalize_all; /* as in tspace_SanitizeOptions */
    /* Not null, since its convention has no default. The convention also says which side of a face is out, and the
     * execution serves all steps. */
    const tspace_TangentOptions* tangents;
    /* Where normals are made; null: defaults. Its convention and execution are not looked at. */
    const tspace_NormalOptions* normals;
    /* Further attributes, one entry per corner, that must not be shared: corners that disagree get a vertex each. Only a
     * mesh without indices needs it, for what hangs on its vertices beside position, normal and UV. */
    const tspace_CornerAttribute* keep_apart;
    size_t keep_apart_count;
} tspace_IndexedFramesOptions;

/* A mesh with the faces of the given one. Gather every other vertex attribute, skin weight and morph target through
 * source_vertex, and attributes that have an index list of their own through the corner: their_indices[source_corner].
 * Made by the library; later versions may append fields. */
typedef struct tspace_IndexedFrames {
    const uint32_t* indices; /* one per corner: the new vertex */
    size_t corner_count;
    const uint32_t* source_vertex; /* one per new vertex: the entry of positions that it copies */
    const uint32_t* source_corner; /* one per new vertex: the first corner that uses it, or TSPACE_NO_CORNER */
    const float* normals;          /* 3 per new vertex: those of the mesh, bit for bit, or the ones made */
    const float* tangents;         /* 4 per new vertex: unit tangent and sign */
    size_t vertex_count;
    const tspace_NormalReport* normal_report; /* null where normals were not made */
    const tspace_TangentReport* tangent_report;
    const tspace_SanitizeReport* sanitize_report;
} tspace_IndexedFrames;

/* The usual case in one call: makes normals where they are missing or asked for, tangents, mends those that are broken,
 * and splits vertices whose corners disagree in either. Each corner has the tangent that tspace_generateNormals,
 * tspace_generateTangents and tspace_sanitizeTangents give it, bit for bit.
 * A mesh with one index list keeps its vertices in their places, also those that no corner uses (which get a frame from
 * their normal), and copies come behind them. A mesh without indices, or with an index list per attribute, gets new
 * vertices in the order in which corners first use them, one for all corners with the same bits of position, normal, UV,
 * tangent and keep_apart (the zeros of a position are equal, as they are for normals).
 * mesh      not null; positions; normals or none; UVs (all methods but BASIS)
 * options   not null
 * frames    not null; *frames is null after an error. Free it with tspace_destroyIndexedFrames.
 * Errors: those of the four calls. O(corners) expected. */
tspace_ErrorCode tspace_makeIndexedFrames(const tspace_Mesh* mesh, const tspace_IndexedFramesOptions* options,
                                          tspace_IndexedFrames** frames, tspace_Error* error) TSPACE_NOEXCEPT;

/* Frees a result of tspace_makeIndexedFrames. Null is allowed. */
void tspace_destroyIndexedFrames(tspace_IndexedFrames* frames) TSPACE_NOEXCEPT;

/* Triangles of a polygon mesh. Made by the library; later versions may append fields. */
typedef struct tspace_Triangulation {
    const uint32_t* corners; /* three per triangle: corners of the mesh (not vertices), winding kept */
    const uint32_t* faces;   /* one per triangle: the face it was cut from */
    size_t triangle_count;
} tspace_Triangulation;

/* Cuts every face with 4 or more corners: quads along the diagonal that MikkTSpace takes, n-gons by clipping
 * the ear with the shortest diagonal first. Faces with fewer than 3 corners give nothing. Triangles come in
 * face order.
 * mesh      not null; positions and indices are used, and UVs when there are any
 * result    not null; *result is null after an error. Free it with tspace_destroyTriangulation.
 * Errors: those of tspace_validate; OUT_OF_MEMORY.
 * O(corners) for triangles and quads, O(n^2) at most for an n-gon. */
tspace_ErrorCode tspace_triangulate(const tspace_Mesh* mesh, tspace_Triangulation** result,
                                    tspace_Error* error) TSPACE_NOEXCEPT;

/* Frees a result of tspace_triangulate. Null is allowed. */
void tspace_destroyTriangulation(tspace_Triangulation* result) TSPACE_NOEXCEPT;

/* For TSPACE_INIT: the defaults that are not zero. */
static inline void tspace_setNoDefaults(void* object) { (void)object; }
static inline void tspace_setNormalDefaults(tspace_NormalOptions* options) {
    options->weighting = TSPACE_NORMAL_WEIGHTING_ANGLE;
    options->crease_angle_deg = 180.0f;
    options->weld_positions = 1;
    options->refine = 1;
}
static inline void tspace_setIndexedFramesDefaults(tspace_IndexedFramesOptions* options) { options->sanitize = 1; }
static inline void tspace_setTangentDefaults(tspace_TangentOptions* options) {
    options->angular_threshold_deg = 180.0f;
    options->refine = 1;
}

#ifdef __cplusplus
}

inline void tspace_setDefaults(void*) noexcept {}
inline void tspace_setDefaults(tspace_NormalOptions* options) noexcept { tspace_setNormalDefaults(options); }
inline void tspace_setDefaults(tspace_IndexedFramesOptions* options) noexcept {
    tspace_setIndexedFramesDefaults(options);
}
inline void tspace_setDefaults(tspace_TangentOptions* options) noexcept { tspace_setTangentDefaults(options); }
#define TSPACE_SET_DEFAULTS(object) tspace_setDefaults(&(object))
#else
/* clang-format off */
#define TSPACE_SET_DEFAULTS(object)                             \
    _Generic((object),                                          \
        tspace_NormalOptions: tspace_setNormalDefaults,         \
        tspace_IndexedFramesOptions: tspace_setIndexedFramesDefaults, \
        tspace_TangentOptions: tspace_setTangentDefaults,       \
        default: tspace_setNoDefaults)((void*)&(object))
/* clang-format on */
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#include "tspace/tspace_frame.h"
#include "tspace/tspace_pack.h"

#endif
