# SPDX-License-Identifier: MIT
"""The C API of tspace, as ctypes: structs, numbers of enumerations, functions. A test compares all of it with the headers.

ctypes lets go of the interpreter's lock for the time of each call.
"""

import ctypes
import sys
from ctypes import POINTER, Structure, c_char, c_char_p, c_double, c_float, c_size_t, c_uint32, c_uint64, c_void_p
from pathlib import Path

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
PAIRINGS = {"reference": 0, "corrected": 1}
NGONS = {"triangulate": 0, "skip": 1}
DOMAINS = {"corner": 0, "vertex": 1}
FRAME_SHAPES = {"gram_schmidt": 0, "symmetric": 1}
WEIGHTINGS = {"flat": 0, "uniform": 1, "area": 2, "angle": 3, "angle_area": 4, "max": 5, "best": 6}
CONVENTIONS = ("gltf", "opengl", "directx", "unreal", "unity", "blender", "godot")
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
V_AXES = {"up": 1, "down": 2}
GREENS = {"up": 0, "down": 1}
STORED_SIGNS = {"as_is": 0, "negated": 1}
HANDEDNESSES = {"right": 0, "left": 1}
WINDINGS = {"counter_clockwise": 0, "clockwise": 1}

INDEX_CORNERS = 8  # corner c uses entry c
ALL_THREADS = 2**32 - 1
NO_ELEMENT = 2**64 - 1
NO_CORNER = 2**32 - 1
MAX_COUNT = 2**31 - 1  # of corners, and of vertices: the library says TOO_LARGE for more


class Error(Structure):
    _fields_ = [("code", c_uint32), ("reserved", c_uint32), ("element", c_uint64), ("message", c_char * 240)]


class Span(Structure):
    """tspace_Span and tspace_ConstSpan."""

    _fields_ = [("data", c_void_p), ("count", c_size_t), ("stride_bytes", c_size_t)]


class Indices(Structure):
    _fields_ = [("data", c_void_p), ("count", c_size_t), ("type", c_uint32)]


class Mesh(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("face_size", c_uint32),
        ("positions", Span),
        ("normals", Span),
        ("uvs", Span),
        ("indices", Indices),
        ("face_sizes", c_void_p),
        ("face_count", c_size_t),
        ("normal_indices", Indices),
        ("uv_indices", Indices),
    ]


class Execution(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("thread_count", c_uint32),
        ("executor", c_void_p),
        ("allocator", c_void_p),
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
        ("has_tangent", Span),
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
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("positions", Span), ("normals", Span)]


class TangentPlanInfo(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("method", c_uint32),
        ("vertex_count", c_size_t),
        ("corner_count", c_size_t),
        ("output_count", c_size_t),
        ("memory_bytes", c_size_t),
    ]


class SanitizeOptions(Structure):
    _fields_ = [("struct_size", c_uint32), ("orthogonalize_all", c_uint32)]


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
    _fields_ = [("data", c_void_p), ("stride_bytes", c_size_t), ("component_count", c_uint32), ("tolerance", c_float)]


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


class Triangulation(Structure):
    _fields_ = [("corners", c_void_p), ("faces", c_void_p), ("triangle_count", c_size_t)]


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


def file_name(name):
    """The file of a library on this system."""
    if sys.platform == "win32":
        return f"{name}.dll"
    return f"lib{name}.dylib" if sys.platform == "darwin" else f"lib{name}.so.0"


def load(name):
    """The shared library of this name: the one in the package, or else the system's."""
    name = file_name(name)
    bundled = Path(__file__).parent / "_lib" / name
    try:
        return ctypes.CDLL(str(bundled) if bundled.exists() else name)
    except OSError as error:
        # The loader's words for a library that is there, and for which there is no memory.
        if any(words in str(error) for words in ("failed to map segment", "annot allocate", "cannot map")):
            raise MemoryError(str(error)) from error
        raise


def declare(library, signatures):
    """Says what functions take and give: {name: (result, argument...)}."""
    for name, (result, *arguments) in signatures.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments


library = load("tspace")
declare(
    library,
    {
        "tspace_version": (c_uint32,),
        "tspace_errorName": (c_char_p, c_uint32),
        "tspace_findConvention": (c_uint32, c_char_p, POINTER(Convention), POINTER(Error)),
        "tspace_signFactor": (c_float, Convention),
        "tspace_normalFactor": (c_float, Convention),
        "tspace_generateNormals": (
            c_uint32,
            POINTER(Mesh),
            POINTER(NormalOptions),
            Span,
            POINTER(Execution),
            POINTER(NormalReport),
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
        "tspace_measurePositionNoise": (
            c_uint32,
            POINTER(Mesh),
            POINTER(Execution),
            POINTER(PositionNoise),
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
        "tspace_generateTangentsOfMeshes": (c_uint32, POINTER(MeshJob), c_size_t, POINTER(Execution), POINTER(Error)),
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
        "tspace_describeTangentPlan": (c_uint32, c_void_p, POINTER(TangentPlanInfo), POINTER(Error)),
        "tspace_destroyTangentPlan": (None, c_void_p),
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
        "tspace_destroySplitResult": (None, POINTER(SplitResult)),
        "tspace_makeIndexedFrames": (
            c_uint32,
            POINTER(Mesh),
            POINTER(IndexedFramesOptions),
            POINTER(Execution),
            POINTER(POINTER(IndexedFrames)),
            POINTER(Error),
        ),
        "tspace_destroyIndexedFrames": (None, POINTER(IndexedFrames)),
        "tspace_triangulate": (c_uint32, POINTER(Mesh), POINTER(POINTER(Triangulation)), POINTER(Error)),
        "tspace_destroyTriangulation": (None, POINTER(Triangulation)),
        "tspace_frameBytes": (c_size_t, c_uint32),
        "tspace_packFrames": (
            c_uint32,
            Span,
            Span,
            c_uint32,
            c_void_p,
            c_size_t,
            POINTER(PackReport),
            POINTER(Error),
        ),
        "tspace_unpackFrames": (c_uint32, c_void_p, c_size_t, c_uint32, Span, Span, POINTER(Error)),
    },
)
