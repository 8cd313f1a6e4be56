# SPDX-License-Identifier: MIT
"""The C API of tspace, as ctypes: structs, numbers of enumerations, functions.

ctypes releases the global interpreter lock during each call.
"""

from ctypes import CFUNCTYPE, POINTER, Structure
from ctypes import c_char, c_char_p, c_double, c_float, c_int, c_size_t, c_uint32, c_uint64, c_void_p

from ._library import declare, load

# Everything below is written by scripts/api.
ERROR_CODES = {
    "ok": 0,
    "null_data": 1,
    "count_mismatch": 2,
    "index_out_of_range": 3,
    "stride_too_small": 4,
    "misaligned": 5,
    "too_large": 6,
    "missing_attribute": 7,
    "invalid_option": 8,
    "out_of_memory": 9,
    "plan_mismatch": 10,
    "internal": 11,
    "cancelled": 12,
    "invalid_file": 100,
    "unsupported_file": 101,
    "forbidden_path": 102,
    "cannot_read": 103,
    "cannot_write": 104,
}
INDEX_TYPES = {
    "none": 0,
    "u8": 1,
    "u16": 2,
    "u32": 4,
    "corners": 8,
}
SIMD_TARGETS = {
    "best": 0,
    "scalar": 1,
    "sse2": 2,
    "avx2": 3,
    "avx512": 4,
    "neon": 5,
}
V_AXES = {
    "up": 1,
    "down": 2,
}
GREENS = {
    "up": 0,
    "down": 1,
}
STORED_SIGNS = {
    "as_is": 0,
    "negated": 1,
}
HANDEDNESSES = {
    "right": 0,
    "left": 1,
}
WINDINGS = {
    "counter_clockwise": 0,
    "clockwise": 1,
}
METHODS = {
    "mikktspace": 0,
    "lengyel": 1,
    "uniform": 2,
    "angle": 3,
    "area": 4,
    "flat": 5,
    "basis": 6,
    "fast": 7,
    "best": 8,
}
PAIRINGS = {
    "reference": 0,
    "corrected": 1,
}
NGONS = {
    "triangulate": 0,
    "skip": 1,
}
OUTPUT_DOMAINS = {
    "corner": 0,
    "vertex": 1,
}
FRAME_SHAPES = {
    "gram_schmidt": 0,
    "symmetric": 1,
}
NORMAL_WEIGHTINGS = {
    "flat": 0,
    "uniform": 1,
    "area": 2,
    "angle": 3,
    "angle_area": 4,
    "max": 5,
    "best": 6,
}
FRAME_FORMATS = {
    "frame32": 0,
    "frame48": 1,
    "frame64": 2,
    "oct32": 3,
    "qtangent64": 4,
    "snorm8_pair": 5,
    "snorm16_pair": 6,
    "gltf_snorm8": 7,
    "gltf_snorm16": 8,
}
CONVENTIONS = (
    "gltf",
    "opengl",
    "directx",
    "unreal",
    "unity",
    "blender",
    "godot",
)
NO_ELEMENT = 18446744073709551615
MAX_CORNERS = 2147483647
ALL_THREADS = 4294967295
NO_CORNER = 4294967295


class Error(Structure):
    _fields_ = [
        ("code", c_uint32),
        ("reserved", c_uint32),
        ("element", c_uint64),
        ("message", c_char * 240),
    ]


class ConstSpan(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride_bytes", c_size_t),
    ]

Span = ConstSpan

ByteSpan = ConstSpan


class Indices(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("count", c_size_t),
        ("type", c_uint32),
    ]


class Mesh(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("face_size", c_uint32),
        ("positions", ConstSpan),
        ("normals", ConstSpan),
        ("uvs", ConstSpan),
        ("indices", Indices),
        ("face_sizes", c_void_p),
        ("face_count", c_size_t),
        ("normal_indices", Indices),
        ("uv_indices", Indices),
    ]


class Executor(Structure):
    _fields_ = [
        ("run", CFUNCTYPE(None, c_void_p, c_size_t, CFUNCTYPE(None, c_void_p, c_size_t), c_void_p)),
        ("user", c_void_p),
        ("concurrency", c_uint32),
    ]


class Allocator(Structure):
    _fields_ = [
        ("allocate", CFUNCTYPE(c_void_p, c_void_p, c_size_t, c_size_t)),
        ("release", CFUNCTYPE(None, c_void_p, c_void_p, c_size_t, c_size_t)),
        ("user", c_void_p),
    ]


class Execution(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("thread_count", c_uint32),
        ("executor", POINTER(Executor)),
        ("allocator", POINTER(Allocator)),
        ("simd", c_uint32),
        ("reserved", c_uint32),
    ]


class Convention(Structure):
    _fields_ = [
        ("v_axis", c_uint32),
        ("green", c_uint32),
        ("stored_sign", c_uint32),
        ("handedness", c_uint32),
        ("winding", c_uint32),
    ]


class TangentOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("method", c_uint32),
        ("convention", Convention),
        ("ngons", c_uint32),
        ("domain", c_uint32),
        ("frame", c_uint32),
        ("angular_threshold_deg", c_float),
        ("pairing", c_uint32),
        ("refine", c_uint32),
        ("normalize_normals", c_uint32),
    ]


class TangentReport(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reference_order_abandoned", c_uint32),
        ("triangle_count", c_uint64),
        ("degenerate_triangle_count", c_uint64),
        ("degenerate_uv_count", c_uint64),
        ("mirrored_count", c_uint64),
        ("skipped_face_count", c_uint64),
        ("group_count", c_uint64),
        ("default_corner_count", c_uint64),
        ("not_finite_count", c_uint64),
    ]


class TangentOutput(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("tangents", Span),
        ("bitangents", Span),
        ("magnitudes_s", Span),
        ("magnitudes_t", Span),
        ("has_tangent", ByteSpan),
    ]


class MeshJob(Structure):
    _fields_ = [
        ("mesh", POINTER(Mesh)),
        ("options", POINTER(TangentOptions)),
        ("out", POINTER(TangentOutput)),
        ("report", POINTER(TangentReport)),
        ("error", POINTER(Error)),
    ]


class Pose(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("positions", ConstSpan),
        ("normals", ConstSpan),
    ]


class TangentPlanInfo(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("method", c_uint32),
        ("vertex_count", c_size_t),
        ("corner_count", c_size_t),
        ("output_count", c_size_t),
        ("memory_bytes", c_size_t),
    ]


class Triangulation(Structure):
    _fields_ = [
        ("corners", c_void_p),
        ("faces", c_void_p),
        ("triangle_count", c_size_t),
    ]


class Vec2(Structure):
    _fields_ = [
        ("x", c_float),
        ("y", c_float),
    ]


class Vec3(Structure):
    _fields_ = [
        ("x", c_float),
        ("y", c_float),
        ("z", c_float),
    ]


class Vec4(Structure):
    _fields_ = [
        ("x", c_float),
        ("y", c_float),
        ("z", c_float),
        ("w", c_float),
    ]


class Frame(Structure):
    _fields_ = [
        ("tangent", Vec3),
        ("bitangent", Vec3),
        ("normal", Vec3),
    ]


class Mat3(Structure):
    _fields_ = [
        ("rows", Vec3 * 3),
    ]


class FaceFrame(Structure):
    _fields_ = [
        ("tangent", Vec3),
        ("bitangent", Vec3),
        ("determinant", c_float),
    ]


class NormalOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("weighting", c_uint32),
        ("convention", Convention),
        ("crease_angle_deg", c_float),
        ("smoothing_groups", c_void_p),
        ("smoothing_group_count", c_size_t),
        ("smoothing_groups_are_masks", c_uint32),
        ("weld_positions", c_uint32),
        ("refine", c_uint32),
        ("reserved", c_uint32),
        ("denoise", c_float),
        ("weld_distance", c_float),
    ]


class NormalReport(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("face_count", c_uint64),
        ("degenerate_face_count", c_uint64),
        ("fallback_corner_count", c_uint64),
        ("noise", c_float),
        ("crease_angle_deg", c_float),
    ]


class PositionNoise(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("sigma", c_float),
        ("kink_share", c_float),
        ("noise", c_float),
        ("mean_edge", c_double),
    ]


class SanitizeOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("orthogonalize_all", c_uint32),
    ]


class SanitizeReport(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("not_finite_count", c_uint64),
        ("zero_count", c_uint64),
        ("not_unit_count", c_uint64),
        ("parallel_count", c_uint64),
        ("bad_sign_count", c_uint64),
        ("mixed_sign_count", c_uint64),
        ("orthogonalized_count", c_uint64),
        ("normalized_count", c_uint64),
        ("from_neighbor_count", c_uint64),
        ("from_basis_count", c_uint64),
        ("bad_normal_count", c_uint64),
        ("mended_count", c_uint64),
        ("placeholder_count", c_uint64),
    ]


class CornerAttribute(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("stride_bytes", c_size_t),
        ("component_count", c_uint32),
        ("tolerance", c_float),
    ]


class SplitResult(Structure):
    _fields_ = [
        ("indices", c_void_p),
        ("corner_count", c_size_t),
        ("source_vertices", c_void_p),
        ("source_corners", c_void_p),
        ("vertex_count", c_size_t),
    ]


class IndexedFramesOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("make_normals", c_uint32),
        ("sanitize", c_uint32),
        ("orthogonalize_all", c_uint32),
        ("tangents", POINTER(TangentOptions)),
        ("normals", POINTER(NormalOptions)),
        ("keep_apart", POINTER(CornerAttribute)),
        ("keep_apart_count", c_size_t),
    ]


class IndexedFrames(Structure):
    _fields_ = [
        ("indices", c_void_p),
        ("corner_count", c_size_t),
        ("source_vertices", c_void_p),
        ("source_corners", c_void_p),
        ("normals", c_void_p),
        ("tangents", c_void_p),
        ("vertex_count", c_size_t),
        ("normal_report", POINTER(NormalReport)),
        ("tangent_report", POINTER(TangentReport)),
        ("sanitize_report", POINTER(SanitizeReport)),
    ]


class PlanBufferOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("indices", c_void_p),
        ("index_count", c_size_t),
        ("source_corners", c_void_p),
        ("source_corner_count", c_size_t),
        ("mesh", POINTER(Mesh)),
        ("normals", POINTER(NormalOptions)),
    ]


class PlanBuffers(Structure):
    _fields_ = [
        ("words", c_void_p),
        ("word_count", c_size_t),
        ("result_count", c_size_t),
    ]


class FrameErrorBound(Structure):
    _fields_ = [
        ("normal_deg", c_double),
        ("tangent_deg", c_double),
    ]


class PackReport(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("bad_normal_count", c_uint64),
        ("not_finite_count", c_uint64),
        ("zero_count", c_uint64),
        ("parallel_count", c_uint64),
        ("not_unit_count", c_uint64),
        ("not_orthogonal_count", c_uint64),
        ("bad_sign_count", c_uint64),
        ("mended_count", c_uint64),
    ]


class WindingOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("convention", Convention),
        ("use_normals", c_uint32),
        ("weld_positions", c_uint32),
        ("weld_distance", c_float),
    ]


class WindingReport(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("face_count", c_uint64),
        ("turned_count", c_uint64),
        ("conflict_count_before", c_uint64),
        ("conflict_count_after", c_uint64),
        ("component_count", c_uint64),
        ("turned_component_count", c_uint64),
        ("by_normals_count", c_uint64),
        ("by_volume_count", c_uint64),
        ("by_nesting_count", c_uint64),
        ("by_winding_number_count", c_uint64),
        ("by_majority_count", c_uint64),
        ("small_count", c_uint64),
        ("one_sided_count", c_uint64),
    ]


class Bytes(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("size", c_size_t),
    ]

FindFile = CFUNCTYPE(c_uint32, c_void_p, c_char_p, POINTER(c_void_p), POINTER(c_size_t))


class Model(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("data", c_void_p),
        ("size", c_size_t),
        ("name", c_char_p),
        ("find_file", FindFile),
        ("user", c_void_p),
    ]


SIGNATURES = {
    "tspace_version": (
        c_uint32,
    ),
    "tspace_errorName": (
        c_char_p,
        c_uint32,
    ),
    "tspace_cornerCount": (
        c_size_t,
        POINTER(Mesh),
    ),
    "tspace_faceCount": (
        c_size_t,
        POINTER(Mesh),
    ),
    "tspace_validate": (
        c_uint32,
        POINTER(Mesh),
        POINTER(Error),
    ),
    "tspace_initExecution": (
        c_uint32,
        POINTER(Execution),
        c_uint32,
        POINTER(Error),
    ),
    "tspace_createArena": (
        c_uint32,
        POINTER(c_void_p),
        POINTER(Error),
    ),
    "tspace_arenaAllocator": (
        POINTER(Allocator),
        c_void_p,
    ),
    "tspace_arenaHeldBytes": (
        c_size_t,
        c_void_p,
    ),
    "tspace_arenaUsedBytes": (
        c_size_t,
        c_void_p,
    ),
    "tspace_trimArena": (
        None,
        c_void_p,
    ),
    "tspace_destroyArena": (
        None,
        c_void_p,
    ),
    "tspace_findConvention": (
        c_uint32,
        c_char_p,
        POINTER(Convention),
        POINTER(Error),
    ),
    "tspace_signFactor": (
        c_float,
        Convention,
    ),
    "tspace_normalFactor": (
        c_float,
        Convention,
    ),
    "tspace_methodName": (
        c_char_p,
        c_uint32,
    ),
    "tspace_initTangentOptions": (
        c_uint32,
        POINTER(TangentOptions),
        c_uint32,
        POINTER(Error),
    ),
    "tspace_generateTangents": (
        c_uint32,
        POINTER(Mesh),
        POINTER(TangentOptions),
        POINTER(TangentOutput),
        POINTER(Execution),
        POINTER(TangentReport),
        POINTER(Error),
    ),
    "tspace_generateTangentsOfMeshes": (
        c_uint32,
        POINTER(MeshJob),
        c_size_t,
        POINTER(Execution),
        POINTER(Error),
    ),
    "tspace_planTangents": (
        c_uint32,
        POINTER(Mesh),
        POINTER(TangentOptions),
        POINTER(Execution),
        POINTER(c_void_p),
        POINTER(Error),
    ),
    "tspace_evaluateTangents": (
        c_uint32,
        c_void_p,
        POINTER(Pose),
        POINTER(TangentOutput),
        POINTER(Execution),
        POINTER(TangentReport),
        POINTER(Error),
    ),
    "tspace_describeTangentPlan": (
        c_uint32,
        c_void_p,
        POINTER(TangentPlanInfo),
        POINTER(Error),
    ),
    "tspace_destroyTangentPlan": (
        None,
        c_void_p,
    ),
    "tspace_triangulate": (
        c_uint32,
        POINTER(Mesh),
        POINTER(POINTER(Triangulation)),
        POINTER(Error),
    ),
    "tspace_destroyTriangulation": (
        None,
        POINTER(Triangulation),
    ),
    "tspace_faceFrame": (
        FaceFrame,
        POINTER(Vec3),
        POINTER(Vec2),
    ),
    "tspace_faceFrameFromPath": (
        FaceFrame,
        POINTER(Vec3),
        POINTER(Vec2),
    ),
    "tspace_determinant": (
        c_float,
        Frame,
    ),
    "tspace_frameSign": (
        c_float,
        Frame,
    ),
    "tspace_rebuildBitangent": (
        Vec3,
        Vec3,
        Vec4,
    ),
    "tspace_orthonormalize": (
        Frame,
        Frame,
    ),
    "tspace_packTangent": (
        Vec4,
        Frame,
    ),
    "tspace_basisFromNormal": (
        Frame,
        Vec3,
    ),
    "tspace_tangentToObject": (
        Mat3,
        Frame,
    ),
    "tspace_objectToTangentOrthonormal": (
        Mat3,
        Frame,
    ),
    "tspace_objectToTangent": (
        c_int,
        Frame,
        POINTER(Mat3),
    ),
    "tspace_transform": (
        Vec3,
        Mat3,
        Vec3,
    ),
    "tspace_toTangentSpace": (
        Vec3,
        Frame,
        Vec3,
    ),
    "tspace_toObjectSpace": (
        Vec3,
        Frame,
        Vec3,
    ),
    "tspace_decodeNormal": (
        Vec3,
        Vec3,
        c_float,
        c_uint32,
    ),
    "tspace_tileUv": (
        Vec2,
        Vec2,
        Vec2,
        Vec2,
    ),
    "tspace_lambert": (
        c_float,
        Frame,
        Vec3,
        Vec3,
    ),
    "tspace_objectNormal": (
        Vec3,
        Frame,
        Vec3,
    ),
    "tspace_objectNormalMikktspace": (
        Vec3,
        Vec3,
        Vec4,
        Vec3,
    ),
    "tspace_initNormalOptions": (
        c_uint32,
        POINTER(NormalOptions),
        c_uint32,
        POINTER(Error),
    ),
    "tspace_generateNormals": (
        c_uint32,
        POINTER(Mesh),
        POINTER(NormalOptions),
        Span,
        POINTER(Execution),
        POINTER(NormalReport),
        POINTER(Error),
    ),
    "tspace_measurePositionNoise": (
        c_uint32,
        POINTER(Mesh),
        POINTER(Execution),
        POINTER(PositionNoise),
        POINTER(Error),
    ),
    "tspace_initSanitizeOptions": (
        c_uint32,
        POINTER(SanitizeOptions),
        c_uint32,
        POINTER(Error),
    ),
    "tspace_sanitizeTangents": (
        c_uint32,
        POINTER(Mesh),
        POINTER(SanitizeOptions),
        Span,
        POINTER(Execution),
        POINTER(SanitizeReport),
        POINTER(Error),
    ),
    "tspace_splitVertices": (
        c_uint32,
        POINTER(Indices),
        c_size_t,
        c_size_t,
        POINTER(CornerAttribute),
        c_size_t,
        POINTER(Execution),
        POINTER(POINTER(SplitResult)),
        POINTER(Error),
    ),
    "tspace_destroySplitResult": (
        None,
        POINTER(SplitResult),
    ),
    "tspace_initIndexedFramesOptions": (
        c_uint32,
        POINTER(IndexedFramesOptions),
        c_uint32,
        POINTER(Error),
    ),
    "tspace_makeIndexedFrames": (
        c_uint32,
        POINTER(Mesh),
        POINTER(IndexedFramesOptions),
        POINTER(Execution),
        POINTER(POINTER(IndexedFrames)),
        POINTER(Error),
    ),
    "tspace_destroyIndexedFrames": (
        None,
        POINTER(IndexedFrames),
    ),
    "tspace_planBuffers": (
        c_uint32,
        c_void_p,
        POINTER(PlanBufferOptions),
        POINTER(Execution),
        POINTER(POINTER(PlanBuffers)),
        POINTER(Error),
    ),
    "tspace_destroyPlanBuffers": (
        None,
        POINTER(PlanBuffers),
    ),
    "tspace_frameBytes": (
        c_size_t,
        c_uint32,
    ),
    "tspace_frameErrorBound": (
        FrameErrorBound,
        c_uint32,
    ),
    "tspace_packFrames": (
        c_uint32,
        ConstSpan,
        ConstSpan,
        c_uint32,
        c_void_p,
        c_size_t,
        POINTER(PackReport),
        POINTER(Error),
    ),
    "tspace_unpackFrames": (
        c_uint32,
        c_void_p,
        c_size_t,
        c_uint32,
        Span,
        Span,
        POINTER(Error),
    ),
    "tspace_initWindingOptions": (
        c_uint32,
        POINTER(WindingOptions),
        c_uint32,
        POINTER(Error),
    ),
    "tspace_mendWinding": (
        c_uint32,
        POINTER(Mesh),
        POINTER(WindingOptions),
        c_void_p,
        c_size_t,
        POINTER(Execution),
        POINTER(WindingReport),
        POINTER(Error),
    ),
}
FILE_SIGNATURES = {
    "tspace_destroyBytes": (
        None,
        POINTER(Bytes),
    ),
    "tspace_generateFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_generateBytes": (
        c_uint32,
        POINTER(Model),
        c_char_p,
        POINTER(Bytes),
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_checkFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_checkBytes": (
        c_uint32,
        POINTER(Model),
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_inspectFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_inspectBytes": (
        c_uint32,
        POINTER(Model),
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_identifyFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_identifyBytes": (
        c_uint32,
        POINTER(Model),
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_diffFiles": (
        c_uint32,
        c_char_p,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_diffBytes": (
        c_uint32,
        POINTER(Model),
        POINTER(Model),
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_flipGreenBytes": (
        c_uint32,
        c_void_p,
        c_size_t,
        c_char_p,
        POINTER(Bytes),
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_flipGreenFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_convertMapFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_heightToNormalFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_compressMapFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_compressMapBytes": (
        c_uint32,
        c_void_p,
        c_size_t,
        c_char_p,
        POINTER(Bytes),
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_bakeFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
    "tspace_finishFile": (
        c_uint32,
        c_char_p,
        c_char_p,
        c_char_p,
        POINTER(Bytes),
        POINTER(Error),
    ),
}

library = load("tspace")
declare(library, SIGNATURES)
