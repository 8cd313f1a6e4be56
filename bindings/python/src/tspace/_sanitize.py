# SPDX-License-Identifier: MIT
"""Repair of tangents."""

import ctypes
from ctypes import byref
from typing import NamedTuple, Optional, Union

import numpy

from . import _abi
from ._arrays import check_apart, float_array, output_array, read_span, report, write_span
from ._errors import InputError
from ._mesh import Mesh
from ._options import execution
from ._reports import SanitizeReport
from ._types import AttributeIndices, FaceSizes, FloatArray, Numbers, Rows, Threads

_library = _abi.library


class SanitizeResult(NamedTuple):
    """Repaired tangents with a report."""

    tangents: FloatArray  #: (corners, 4) float32
    report: SanitizeReport


def sanitize(
    tangents: Rows,
    positions: Rows,
    normals: Rows,
    indices: Optional[Numbers] = None,
    *,
    face_sizes: FaceSizes = None,
    normal_indices: AttributeIndices = None,
    orthogonalize_all: bool = False,
    threads: Threads = 1,
    out: Optional[numpy.ndarray] = None,
    full: bool = False,
) -> Union[FloatArray, SanitizeResult]:
    """Repairs invalid tangents.

    A tangent is invalid if it contains NaN or infinity, is zero, does not have unit length, is parallel to N, or if the
    signs within its face differ.

    Returns (corners, 4) float32. Valid tangents keep all bits. Repaired ones are unit and orthogonal to the corner's N.

    tangents:   (corners, 4), as returned by `tangents`; not changed, unless out=tangents
    positions:  (vertices, 3)
    normals:    (vertices, 3)
    indices, face_sizes, normal_indices: see `tangents`
    orthogonalize_all: True: also makes valid tangents unit and orthogonal to N; they then no longer match a bake
    threads:    number of threads, or "all"
    out:        float32 array that receives the result; pass `tangents` to repair in place
    full:       True: returns a SanitizeResult, which includes a report
    """
    source = float_array("tangents", tangents, 4)
    mesh = Mesh(positions, normals, None, indices, face_sizes, normal_indices)
    if len(source) != mesh.corner_count:
        raise InputError(f"tangents has {len(source)} rows, but the mesh has {mesh.corner_count} corners", "countMismatch")
    result = output_array(out, mesh.corner_count, 4)
    check_apart(out, mesh.arrays)
    if result is not source:
        result[...] = read_span("tangents", source)[1]
    options = _abi.SanitizeOptions(ctypes.sizeof(_abi.SanitizeOptions), bool(orthogonalize_all))
    run = execution(threads)
    counts = _abi.SanitizeReport(ctypes.sizeof(_abi.SanitizeReport))
    error = _abi.Error()
    if _library.tspace_sanitizeTangents(
        byref(mesh.struct), byref(options), write_span(result), byref(run), byref(counts), byref(error)
    ):
        mesh.fail(error)
    return SanitizeResult(result, report(SanitizeReport, counts)) if full else result
