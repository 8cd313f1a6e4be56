# SPDX-License-Identifier: MIT
"""Conversion of corners to an indexed mesh, and of polygons to triangles."""

import ctypes
import math
from ctypes import POINTER, byref
from typing import Any, Iterable, List, NamedTuple, Optional, Sequence, Tuple

import numpy

from . import _abi
from ._arrays import (
    NO_INDICES,
    UINT32,
    copied,
    fail_at_index,
    float_array,
    index_array,
    read_indices,
    read_span,
    shape_text,
)
from ._errors import InputError, shown
from ._mesh import Mesh
from ._options import execution, real
from ._types import FaceSizes, IndexArray, Numbers, Rows, Threads

_library = _abi.library
_MOST_COLUMNS = 16


def corner_attributes(
    name: str, attributes: Sequence[Any], corner_count: int, tolerance: Any
) -> Tuple[Any, List[numpy.ndarray]]:
    """Returns the C structs for arrays of shape (corners, k), and the arrays that must outlive them."""
    if isinstance(attributes, (numpy.ndarray, str, bytes)) or not isinstance(attributes, Iterable):
        raise TypeError(f"{name} must be a list of arrays, such as [tangents], not an array")
    tolerance = real("tolerance", tolerance)
    if not 0 <= tolerance < math.inf:
        raise InputError(f"tolerance is {tolerance}; it must be finite and not negative", "invalidOption")
    arrays: List[numpy.ndarray] = []
    for attribute in attributes:
        place = f"{name}[{len(arrays)}]"
        array = numpy.asarray(attribute)
        array = float_array(place, array, array.shape[1] if array.ndim == 2 else 1)
        if len(array) != corner_count:
            raise InputError(f"{place} has {len(array)} rows, but there are {corner_count} corners", "countMismatch")
        if not 1 <= array.shape[1] <= _MOST_COLUMNS:
            raise InputError(f"{place} has {array.shape[1]} columns; it must have 1 to {_MOST_COLUMNS}", "invalidOption")
        arrays.append(array)
    rows = (_abi.CornerAttribute * len(arrays))()
    for number, array in enumerate(arrays):
        span, arrays[number] = read_span(f"{name}[{number}]", array)
        rows[number] = _abi.CornerAttribute(span.data, span.stride_bytes, array.shape[1], tolerance)
    return rows, arrays


class Split(NamedTuple):
    """New index list, and the source of each new vertex. Old vertices keep their positions, copies are appended."""

    indices: IndexArray  #: (corners,) uint32: the new vertex of each corner
    #: (new vertices,) uint32: the old vertex that each one copies; use it to gather vertex attributes
    source_vertices: IndexArray
    #: (new vertices,) uint32: a corner whose values each vertex has; 0xffffffff: no corner uses it
    source_corners: IndexArray


def split(
    indices: Optional[Numbers],
    vertex_count: int,
    attributes: Sequence[Rows],
    *,
    tolerance: float = 0.0,
    threads: Threads = 1,
) -> Split:
    """Splits vertices whose corners differ in any attribute: converts results per corner to an indexed mesh.

    indices:      (corners,) or (faces, k), the old vertex of each corner; None: corner c is vertex c
    vertex_count: number of old vertices
    attributes:   arrays of shape (corners, k), k from 1 to 16, such as results of `tangents` and `normals`
    tolerance:    0: corners are equal if all bits are equal; otherwise: if every number differs by at most this
    threads:      number of threads, or "all"

    >>> s = tspace.split(indices, len(positions), [tangents])
    >>> new_positions, new_tangents = positions[s.source_vertices], tangents[s.source_corners]
    """
    if not isinstance(vertex_count, (int, numpy.integer)) or isinstance(vertex_count, bool):
        raise TypeError(f"vertex_count must be a number, not {shown(vertex_count)}")
    if not 0 <= vertex_count <= _abi.MAX_CORNERS:
        raise InputError(f"vertex_count is {vertex_count}; it must be from 0 to {_abi.MAX_CORNERS}", "tooLarge")
    struct, corner_count, index_list = NO_INDICES, int(vertex_count), None
    if indices is not None:
        given = index_array("indices", indices)
        if not 1 <= given.ndim <= 2:
            raise InputError(
                f"indices must have shape (corners,) or (faces, k), not {shape_text(given.shape)}", "countMismatch"
            )
        struct, index_list = read_indices("indices", given.ravel(), int(vertex_count))
        corner_count = index_list.size
    rows, keep = corner_attributes("attributes", attributes, corner_count, tolerance)
    result = POINTER(_abi.SplitResult)()
    error = _abi.Error()
    if _library.tspace_splitVertices(
        byref(struct),
        int(vertex_count),
        corner_count,
        rows,
        len(rows),
        byref(execution(threads)),
        byref(result),
        byref(error),
    ):
        fail_at_index(error, "indices", index_list, int(vertex_count))
    del keep
    try:
        made = result.contents
        return Split(
            copied(made.indices, (made.corner_count,), UINT32),
            copied(made.source_vertices, (made.vertex_count,), UINT32),
            copied(made.source_corners, (made.vertex_count,), UINT32),
        )
    finally:
        _library.tspace_destroySplitResult(result)


class Triangles(NamedTuple):
    """Triangles of a polygon mesh."""

    corners: IndexArray  #: (triangles, 3) uint32: corners of the mesh (not vertices), with the original winding
    faces: IndexArray  #: (triangles,) uint32: the original face of each triangle


def triangulate(
    positions: Rows, indices: Optional[Numbers] = None, *, face_sizes: FaceSizes = None, uvs: Optional[Rows] = None
) -> Triangles:
    """Splits faces with 4 or more corners into triangles.

    Quads are split along the diagonal that MikkTSpace chooses, which also depends on `uvs` if given; n-gons by ear
    clipping. Faces with fewer than 3 corners are skipped.

    positions:  (vertices, 3)
    indices:    (corners,), or (faces, k) for faces of k corners; None: corner c is vertex c
    face_sizes: a number: corners of every face. (faces,): corners of each face
    uvs:        (vertices, 2), or None

    >>> triangles = tspace.triangulate(positions, indices, face_sizes=sizes)
    >>> triangle_indices = indices[triangles.corners]
    """
    mesh = Mesh(positions, None, uvs, indices, face_sizes)
    result = POINTER(_abi.Triangulation)()
    error = _abi.Error()
    if _library.tspace_triangulate(byref(mesh.struct), byref(result), byref(error)):
        mesh.fail(error)
    try:
        made = result.contents
        return Triangles(
            copied(made.corners, (made.triangle_count, 3), UINT32), copied(made.faces, (made.triangle_count,), UINT32)
        )
    finally:
        _library.tspace_destroyTriangulation(result)
