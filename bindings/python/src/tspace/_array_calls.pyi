# SPDX-License-Identifier: MIT
"""Functions of arrays as type checkers see them: what they return depends on `full`."""

from typing import Literal, Optional, overload

import numpy

from ._normals import NormalResult
from ._options import ConventionLike
from ._pack import PackResult
from ._sanitize import SanitizeResult
from ._tangents import TangentResult
from ._types import (
    AttributeIndices,
    ByteArray,
    DegreesOrAuto,
    FaceSizes,
    FloatArray,
    FrameFormatName,
    FrameShapeName,
    MethodName,
    NgonsName,
    NormalWeightingName,
    Numbers,
    OutputDomainName,
    PairingName,
    Rows,
    Threads,
)

# Everything below is written by scripts/api.


@overload
def normals(
    positions: Rows,
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    weighting: NormalWeightingName = ...,
    crease_angle: DegreesOrAuto = ...,
    smoothing_groups: Optional[Numbers] = ...,
    smoothing_groups_are_masks: bool = ...,
    weld_positions: bool = ...,
    convention: Optional[ConventionLike] = ...,
    refine: int = ...,
    denoise: DegreesOrAuto = ...,
    weld_distance: DegreesOrAuto = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[False] = ...,
) -> FloatArray:
    """Computes one unit normal per corner: (corners, 3) float32.

    Without hard edges all corners of a vertex get the same normal, so that
    `vertex_normals = numpy.empty_like(positions); vertex_normals[indices] = normals` gives normals per vertex. With hard
    edges they differ: `make_indexed_frames` or `split` create the required vertices.

    positions:        (vertices, 3)
    indices:          (corners,), or (faces, k) for faces of k corners; None: corner c is vertex c
    face_sizes:       None: triangles. A number: corners of every face. (faces,): corners of each face
    weighting:        weight of a face: "angle", "area", "angle_area", "uniform", "max", "best"; "flat": no averaging
    crease_angle:     degrees; edges where face normals differ by more are hard. 180: no edge is hard. "auto": an angle
                      derived from the mesh, stated in the report
    smoothing_groups: (faces,), a number per face: two faces are smoothed only if their numbers are equal and not 0
    smoothing_groups_are_masks: True: two faces are smoothed if their numbers share a bit
    weld_positions:   True: vertices at the same position are welded, so that UV seams stay smooth; False: only by index
    convention:       its handedness and winding define the outside; None: right-handed, counter-clockwise
    refine:           refinement steps of "best": 0, 1 or 2
    denoise:          for "best" on noisy positions, such as scans: uses larger neighborhoods. 0: off. "auto": by the
                      measured noise, unless it looks like shape. Above 0, up to 4: factor of the measured noise, even
                      if it looks like shape
    weld_distance:    with weld_positions: positions that differ by at most this in each coordinate are welded. "auto":
                      twice the spacing of floats at the largest coordinate
    threads:          number of threads, or "all". The results have the same bits for any number
    out:              float32 array that receives the result and is returned
    full:             True: returns a NormalResult, which includes a report
    """


@overload
def normals(
    positions: Rows,
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    weighting: NormalWeightingName = ...,
    crease_angle: DegreesOrAuto = ...,
    smoothing_groups: Optional[Numbers] = ...,
    smoothing_groups_are_masks: bool = ...,
    weld_positions: bool = ...,
    convention: Optional[ConventionLike] = ...,
    refine: int = ...,
    denoise: DegreesOrAuto = ...,
    weld_distance: DegreesOrAuto = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[True],
) -> NormalResult:
    ...


@overload
def pack_frames(
    normals: Rows,
    tangents: Rows,
    format: FrameFormatName = ...,
    *,
    full: Literal[False] = ...,
) -> ByteArray:
    """Packs complete frames (N, T and the sign) into 4 to 16 bytes each: (frames, bytes) uint8.

    normals:  (frames, 3), unit
    tangents: (frames, 4), unit and orthogonal to N; the fourth is the sign. Rows of both arrays
              correspond: both per vertex of a split mesh, or both per corner
    format:   "frame32" (4 bytes; within 0.135 degrees), "frame48" (6; 0.0042), "frame64" (8; 0.00015), "oct32" (4; 0.165),
              "qtangent64" (8; 0.004), "snorm8_pair" (8), "snorm16_pair" (16), "gltf_snorm8" (7), "gltf_snorm16" (14)
    full:     True: returns a PackResult, which includes a report

    Accepts any input: invalid frames are repaired and counted.
    """


@overload
def pack_frames(
    normals: Rows,
    tangents: Rows,
    format: FrameFormatName = ...,
    *,
    full: Literal[True],
) -> PackResult:
    ...


@overload
def sanitize(
    tangents: Rows,
    positions: Rows,
    normals: Rows,
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    normal_indices: AttributeIndices = ...,
    orthogonalize_all: bool = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[False] = ...,
) -> FloatArray:
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


@overload
def sanitize(
    tangents: Rows,
    positions: Rows,
    normals: Rows,
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    normal_indices: AttributeIndices = ...,
    orthogonalize_all: bool = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[True],
) -> SanitizeResult:
    ...


@overload
def tangents(
    positions: Rows,
    normals: Rows,
    uvs: Optional[Rows],
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    normal_indices: AttributeIndices = ...,
    uv_indices: AttributeIndices = ...,
    method: MethodName = ...,
    convention: ConventionLike,
    threshold: float = ...,
    pairing: PairingName = ...,
    ngons: NgonsName = ...,
    domain: OutputDomainName = ...,
    frame: FrameShapeName = ...,
    refine: int = ...,
    normalize_normals: bool = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[False] = ...,
) -> FloatArray:
    """Computes one tangent per corner, with its sign: (corners, 4) float32.

    The first three numbers of a row are the unit tangent T, the fourth is the sign (+1 or -1): B = sign * cross(N, T). One
    vertex can need several tangents, so never write rows through the old index list: `make_indexed_frames` or `split`
    create a new one.

    positions:  (vertices, 3)
    normals:    (vertices, 3), unit; used as given (see normalize_normals). `tspace.normals` computes them
    uvs:        (vertices, 2); None for method="basis", which needs no UVs
    indices:    (corners,), the vertex of each corner, also as a column (corners, 1), or (faces, k) for faces of k corners;
                None: corner c is vertex c
    face_sizes: None: triangles. A number: corners of every face. (faces,): corners of each face
    normal_indices, uv_indices: None: normals and uvs have one row per vertex. A separate index list, shaped like `indices` or
                (corners,): any number of rows. "corners": one row per corner
    method:     "mikktspace" (bit-identical to the MikkTSpace reference), "fast", "best", "lengyel", "uniform", "angle", "area",
                "flat", or "basis"
    convention: determines the sign, so it has no default: "gltf", "opengl", "directx", "unreal", "unity", "blender", "godot",
                or a tspace.Convention
    threshold:  degrees, default 180 as in the reference; mikktspace only: tangents that differ by this or more are not
                averaged
    pairing:    mikktspace only: "reference", or "corrected" without the reference's defect in its last bucket of edges
    ngons:      faces with more than 4 corners: "triangulate", or "skip": their rows are zero, as in the reference
    domain:     "corner"; or "vertex", for "lengyel" and "basis" only: one row per vertex
    frame:      "gram_schmidt"; or "symmetric": T is the bisector of dP/du and the direction across dP/dv
    refine:     refinement steps of "best": 0, 1 or 2
    normalize_normals: True: normals whose length differs from 1 by more than 0.00674 are normalized first; False: they are
                used as given, and tangents are then not perpendicular to them, as in the reference
    threads:    number of threads, or "all". The results have the same bits for any number
    out:        float32 array that receives the result and is returned; may be a field of interleaved vertices
    full:       True: returns a TangentResult, which also includes bitangents, magnitudes, a report, and a mask of the rows
                to which a face contributes

    Invalid geometry (NaN, faces without area) raises no error: it is counted in the report, and `sanitize` repairs the
    result. Raises TypeError, InputError (a ValueError) with the invalid argument and position, or MemoryError.
    """


@overload
def tangents(
    positions: Rows,
    normals: Rows,
    uvs: Optional[Rows],
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    normal_indices: AttributeIndices = ...,
    uv_indices: AttributeIndices = ...,
    method: MethodName = ...,
    convention: ConventionLike,
    threshold: float = ...,
    pairing: PairingName = ...,
    ngons: NgonsName = ...,
    domain: OutputDomainName = ...,
    frame: FrameShapeName = ...,
    refine: int = ...,
    normalize_normals: bool = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[True],
) -> TangentResult:
    ...
