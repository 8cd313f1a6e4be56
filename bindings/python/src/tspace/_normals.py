# SPDX-License-Identifier: MIT
"""Normals per corner."""

import ctypes
from ctypes import byref
from typing import Any, NamedTuple, Optional, Union

import numpy

from . import _abi
from ._arrays import check_apart, output_array, report, uint32_array, write_span
from ._mesh import Mesh
from ._options import ConventionLike, convention_struct, execution, named, real_or_auto, small_number
from ._reports import NormalReport, PositionNoise
from ._types import DegreesOrAuto, FaceSizes, FloatArray, Numbers, Rows, Threads, NormalWeightingName


class NormalResult(NamedTuple):
    """Normals with a report."""

    normals: FloatArray  #: (corners, 3) float32
    report: NormalReport


def normal_options(
    weighting: Any,
    crease_angle: Any,
    groups: Optional[numpy.ndarray],
    smoothing_groups_are_masks: Any,
    weld_positions: Any,
    convention: Any,
    refine: Any,
    denoise: Any,
    weld_distance: Any,
) -> _abi.NormalOptions:
    """Returns the struct of the C API, which refers to `groups`."""
    # The C API rejects all-zero options as uninitialized; flat, which is 0, uses none of the other options.
    if refine == 0 and weighting == "flat":
        refine = 1
    return _abi.NormalOptions(
        ctypes.sizeof(_abi.NormalOptions),
        named("weighting", weighting, _abi.NORMAL_WEIGHTINGS),
        convention_struct("gltf" if convention is None else convention),
        real_or_auto("crease_angle", crease_angle),
        None if groups is None else groups.ctypes.data,
        0 if groups is None else groups.size,
        bool(smoothing_groups_are_masks),
        bool(weld_positions),
        small_number("refine", refine),
        0,
        real_or_auto("denoise", denoise),
        real_or_auto("weld_distance", weld_distance),
    )


def normals(
    positions: Rows,
    indices: Optional[Numbers] = None,
    *,
    face_sizes: FaceSizes = None,
    weighting: NormalWeightingName = "angle",
    crease_angle: DegreesOrAuto = 180.0,
    smoothing_groups: Optional[Numbers] = None,
    smoothing_groups_are_masks: bool = False,
    weld_positions: bool = True,
    convention: Optional[ConventionLike] = None,
    refine: int = 2,
    denoise: DegreesOrAuto = 0,
    weld_distance: DegreesOrAuto = 0,
    threads: Threads = 1,
    out: Optional[numpy.ndarray] = None,
    full: bool = False,
) -> Union[FloatArray, NormalResult]:
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
    mesh = Mesh(positions, None, None, indices, face_sizes)
    groups = None if smoothing_groups is None else uint32_array("smoothing_groups", smoothing_groups)
    options = normal_options(
        weighting, crease_angle, groups, smoothing_groups_are_masks, weld_positions, convention, refine, denoise, weld_distance
    )
    run = execution(threads)
    result = output_array(out, mesh.corner_count, 3)
    check_apart(out, mesh.arrays if groups is None else [*mesh.arrays, groups])
    counts = _abi.NormalReport(ctypes.sizeof(_abi.NormalReport))
    error = _abi.Error()
    if _abi.library.tspace_generateNormals(
        byref(mesh.struct), byref(options), write_span(result), byref(run), byref(counts), byref(error)
    ):
        mesh.fail(error)
    return NormalResult(result, report(NormalReport, counts)) if full else result


def position_noise(
    positions: Rows, indices: Optional[Numbers] = None, *, face_sizes: FaceSizes = None, threads: Threads = 1
) -> PositionNoise:
    """Measures the noise in the positions of a mesh: `noise` is what `normals(..., denoise="auto")` removes.

    positions, indices, face_sizes, threads: see `normals`
    """
    mesh = Mesh(positions, None, None, indices, face_sizes)
    run = execution(threads)
    found = _abi.PositionNoise(ctypes.sizeof(_abi.PositionNoise))
    error = _abi.Error()
    if _abi.library.tspace_measurePositionNoise(byref(mesh.struct), byref(run), byref(found), byref(error)):
        mesh.fail(error)
    return report(PositionNoise, found)
