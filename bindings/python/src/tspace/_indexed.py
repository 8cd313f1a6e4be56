# SPDX-License-Identifier: MIT
"""The common case in one call: an indexed mesh with normals and tangents."""

import ctypes
from ctypes import POINTER, byref, pointer
from typing import Any, NamedTuple, Optional, Sequence, Union

import numpy

from . import _abi
from ._arrays import FLOAT32, UINT32, copied, report, uint32_array
from ._mesh import Mesh
from ._normals import normal_options
from ._options import ConventionLike, execution
from ._reports import NormalReport, SanitizeReport, TangentReport
from ._split import corner_attributes
from ._tangents import tangent_options
from ._types import (
    AttributeIndices,
    DegreesOrAuto,
    FaceSizes,
    FloatArray,
    FrameShapeName,
    IndexArray,
    MethodName,
    NgonsName,
    Numbers,
    PairingName,
    Rows,
    Threads,
    NormalWeightingName,
)

_library = _abi.library


class IndexedFramesReport(NamedTuple):
    """Reports of the steps; None if a step was skipped."""

    normals: Optional[NormalReport]
    tangents: TangentReport
    sanitize: Optional[SanitizeReport]


class IndexedFrames(NamedTuple):
    """Indexed mesh with the same faces as the input. Corners share a vertex only if all their values are equal."""

    indices: IndexArray  #: (corners,) uint32: the new vertex of each corner
    source_vertices: IndexArray  #: (new vertices,) uint32: the old vertex that each new one copies
    source_corners: IndexArray  #: (new vertices,) uint32: first corner that uses each vertex; 0xffffffff: unused
    normals: FloatArray  #: (new vertices, 3) float32: the mesh's normals, bit for bit, or generated ones
    tangents: FloatArray  #: (new vertices, 4) float32: unit tangent and sign
    report: IndexedFramesReport


def make_indexed_frames(
    positions: Rows,
    normals: Optional[Rows] = None,
    uvs: Optional[Rows] = None,
    indices: Optional[Numbers] = None,
    *,
    face_sizes: FaceSizes = None,
    normal_indices: AttributeIndices = None,
    uv_indices: AttributeIndices = None,
    method: MethodName = "mikktspace",
    convention: ConventionLike,
    threshold: float = 180.0,
    pairing: PairingName = "reference",
    ngons: NgonsName = "triangulate",
    frame: FrameShapeName = "gram_schmidt",
    refine: Optional[int] = None,
    make_normals: bool = False,
    weighting: NormalWeightingName = "angle",
    crease_angle: DegreesOrAuto = 180.0,
    denoise: DegreesOrAuto = 0,
    smoothing_groups: Optional[Numbers] = None,
    smoothing_groups_are_masks: bool = False,
    weld_positions: bool = True,
    weld_distance: DegreesOrAuto = 0,
    normalize_normals: bool = False,
    sanitize: bool = True,
    orthogonalize_all: bool = False,
    keep_apart: Sequence[Rows] = (),
    threads: Threads = 1,
) -> IndexedFrames:
    """Creates an indexed mesh with normals and tangents: the common case in one call.

    Computes missing normals, then tangents, repairs invalid ones, and splits vertices whose corners have different values.
    Gather other vertex attributes (UVs, skin weights, morph targets) by `source_vertices`, and attributes with a separate
    index list by corner: `uvs[uv_indices[source_corners]]`.

    positions:  (vertices, 3)
    normals:    (vertices, 3), unit; None: computed
    uvs:        (vertices, 2); None for method="basis"
    indices:    (corners,), or (faces, k) for faces of k corners; None: corner c is vertex c
    face_sizes, normal_indices, uv_indices, method, convention, threshold, pairing, ngons, frame: see `tangents`
    refine:     refinement steps of "best", for tangents and normals: 0, 1 or 2;
                None: 1 for tangents and 2 for normals
    make_normals: True: existing normals are recomputed
    weighting, crease_angle, denoise, smoothing_groups, smoothing_groups_are_masks, weld_positions, weld_distance: options of
                the computed normals, see `normals`
    normalize_normals: see `tangents`; the result then contains the normalized normals
    sanitize:   False: invalid tangents are kept
    orthogonalize_all: True: also makes valid tangents unit and orthogonal to N
    keep_apart: arrays of shape (corners, k), only without indices: further values that must not be merged, such as colors
    threads:    number of threads, or "all". The results have the same bits for any number

    In a mesh with one index list vertices keep their positions, and copies follow; otherwise new vertices are in the
    order of their corners, one for all corners with the same bits.
    """
    run = execution(threads)
    steps = 1 if refine is None else refine
    tangents = tangent_options(
        method, convention, threshold, pairing, ngons, "corner", frame, steps, normalize_normals
    )
    groups = None if smoothing_groups is None else uint32_array("smoothing_groups", smoothing_groups)
    made_by = normal_options(
        weighting,
        crease_angle,
        groups,
        smoothing_groups_are_masks,
        weld_positions,
        convention,
        2 if refine is None else refine,
        denoise,
        weld_distance,
    )
    mesh = Mesh(positions, normals, uvs, indices, face_sizes, normal_indices, uv_indices)
    rows, keep = corner_attributes("keep_apart", keep_apart, mesh.corner_count, 0.0)
    options = _abi.IndexedFramesOptions(
        ctypes.sizeof(_abi.IndexedFramesOptions),
        bool(make_normals),
        bool(sanitize),
        bool(orthogonalize_all),
        pointer(tangents),
        pointer(made_by),
        rows,
        len(rows),
    )
    result = POINTER(_abi.IndexedFrames)()
    error = _abi.Error()
    if _library.tspace_makeIndexedFrames(byref(mesh.struct), byref(options), byref(run), byref(result), byref(error)):
        mesh.fail(error)
    del keep
    try:
        return _copied_frames(result.contents, bool(sanitize))
    finally:
        _library.tspace_destroyIndexedFrames(result)


def _copied_frames(made: _abi.IndexedFrames, sanitized: bool) -> IndexedFrames:
    count = made.vertex_count
    return IndexedFrames(
        copied(made.indices, (made.corner_count,), UINT32),
        copied(made.source_vertices, (count,), UINT32),
        copied(made.source_corners, (count,), UINT32),
        copied(made.normals, (count, 3), FLOAT32),
        copied(made.tangents, (count, 4), FLOAT32),
        IndexedFramesReport(
            report(NormalReport, made.normal_report.contents) if made.normal_report else None,
            report(TangentReport, made.tangent_report.contents),
            report(SanitizeReport, made.sanitize_report.contents) if sanitized else None,
        ),
    )
