# SPDX-License-Identifier: MIT
"""Repair of the winding of faces."""

import ctypes
from ctypes import byref
from typing import Any, NamedTuple, Optional, Union

import numpy

from . import _abi
from ._arrays import report
from ._mesh import Mesh
from ._options import ConventionLike, convention_struct, execution, real_or_auto
from ._reports import WindingReport
from ._types import DegreesOrAuto, FaceSizes, IndexArray, Numbers, Rows, Threads


class WindingResult(NamedTuple):
    """Indices with consistent winding, and the flipped faces."""

    indices: IndexArray  #: same shape as the input; corners of flipped faces are reordered
    report: WindingReport
    turned: numpy.ndarray  #: (faces,) bool: the flipped faces


def _face_sizes(mesh: Mesh, face_sizes: Any) -> numpy.ndarray:
    size = mesh.struct.face_size
    if size == 0:
        return numpy.asarray(face_sizes, numpy.int64)
    return numpy.full(mesh.corner_count // size, size)


def fix_winding(
    positions: Rows,
    indices: Optional[Numbers] = None,
    *,
    face_sizes: FaceSizes = None,
    normals: Optional[Rows] = None,
    weld_positions: bool = True,
    weld_distance: DegreesOrAuto = 0,
    convention: Optional[ConventionLike] = None,
    threads: Threads = 1,
) -> WindingResult:
    """Flips faces whose winding differs from their neighbors, and components that are inside out.

    The outside of a component is determined by its signed volume if it is closed, by the volume that it encloses if it is
    open, otherwise by the majority of its faces. Components with fewer than 4 faces are not changed.

    positions:      (vertices, 3)
    indices:        (corners,), or (faces, k) for faces of k corners; None: corner c is vertex c
    face_sizes:     None: triangles. A number: corners of every face. (faces,): corners of each face
    normals:        (vertices, 3): they define the outside where they are consistent; None: not used
    weld_positions: True: vertices at the same position are welded; False: only by index
    weld_distance:  with weld_positions: positions that differ by at most this in each coordinate are welded. "auto":
                    twice the spacing of floats at the largest coordinate
    convention:     its handedness and winding define the correct order; None: right-handed, counter-clockwise
    threads:        number of threads, or "all". The results have the same bits for any number
    """
    mesh = Mesh(positions, normals, None, indices, face_sizes)
    run = execution(threads)
    options = _abi.WindingOptions(
        ctypes.sizeof(_abi.WindingOptions),
        convention_struct("gltf" if convention is None else convention),
        normals is not None,
        bool(weld_positions),
        real_or_auto("weld_distance", weld_distance),
    )
    sizes = _face_sizes(mesh, face_sizes)
    turned = numpy.zeros(len(sizes), numpy.uint8)
    counts = _abi.WindingReport(ctypes.sizeof(_abi.WindingReport))
    error = _abi.Error()
    if _abi.library.tspace_mendWinding(
        byref(mesh.struct), byref(options), turned.ctypes.data, len(turned), byref(run), byref(counts), byref(error)
    ):
        mesh.fail(error)
    given = numpy.arange(mesh.corner_count, dtype=numpy.uint32) if indices is None else numpy.asarray(indices)
    made = given.flatten()
    first = numpy.concatenate(([0], numpy.cumsum(sizes)))
    for face in numpy.flatnonzero(turned):
        corners = slice(first[face] + 1, first[face + 1])
        made[corners] = made[corners][::-1].copy()
    return WindingResult(made.reshape(given.shape), report(WindingReport, counts), turned.astype(bool))


mend_winding = fix_winding  #: the former name of fix_winding
