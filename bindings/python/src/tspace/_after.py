# SPDX-License-Identifier: MIT
"""What comes after tangents: mending, splitting, cutting polygons, packing."""

import ctypes
from ctypes import POINTER, byref
from typing import Any, NamedTuple, Optional, Sequence, Tuple, Union

import numpy

from . import _abi
from ._arrays import (
    FLOAT32,
    NO_INDICES,
    check_apart,
    float_array,
    index_array,
    output_array,
    read_indices,
    read_span,
    write_span,
)
from ._errors import InputError, raise_error
from ._mesh import Mesh
from ._options import execution, named, real
from ._reports import PackReport, SanitizeReport, report

_library = _abi.library


class SanitizeResult(NamedTuple):
    """Mended tangents, and what was mended."""

    tangents: numpy.ndarray  #: (corners, 4) float32
    report: SanitizeReport


def sanitize(
    tangents: Any,
    positions: Any,
    normals: Any,
    indices: Any = None,
    *,
    face_sizes: Any = None,
    orthogonalize_all: bool = False,
    threads: Union[int, str] = 1,
    out: Optional[numpy.ndarray] = None,
    full: bool = False,
) -> Union[numpy.ndarray, SanitizeResult]:
    """Mends tangents that are not finite, zero, not unit, parallel to N, or of mixed sign in a face: (corners, 4) float32.

    Sound tangents keep every bit. What is written is unit and orthogonal to the corner's N.

    tangents:   (corners, 4), as `tangents` gives them; not changed, unless out=tangents
    positions:  (vertices, 3)
    normals:    (vertices, 3)
    indices, face_sizes: as for `tangents`
    orthogonalize_all: True: also makes sound tangents unit and orthogonal to N; they then no longer match a bake
    threads:    1, another number, or "all"
    out:        an array of float32 that takes the result; the same array as `tangents` mends in place
    full:       True: returns a SanitizeResult, which has a report too
    """
    source = float_array("tangents", tangents, 4)
    mesh = Mesh(positions, normals, None, indices, face_sizes)
    if len(source) != mesh.corner_count:
        raise InputError(f"tangents has {len(source)} rows, the mesh has {mesh.corner_count} corners", "countMismatch")
    result = output_array(out, mesh.corner_count, 4)
    check_apart(out, mesh.arrays)
    if result is not source:
        result[...] = read_span("tangents", source)[1]
    options = _abi.SanitizeOptions(
        ctypes.sizeof(_abi.SanitizeOptions), bool(orthogonalize_all), execution(threads)
    )
    counts = _abi.SanitizeReport(ctypes.sizeof(_abi.SanitizeReport))
    error = _abi.Error()
    if _library.tspace_sanitizeTangents(
        byref(mesh.struct), byref(options), write_span(result), byref(counts), byref(error)
    ):
        mesh.fail(error)
    return SanitizeResult(result, report(SanitizeReport, counts)) if full else result


def _copied(address: Optional[int], count: int) -> numpy.ndarray:
    """Numbers that the library will free, as an array of uint32."""
    if not count:
        return numpy.empty(0, numpy.uint32)
    return numpy.ctypeslib.as_array((ctypes.c_uint32 * count).from_address(address)).copy()


class Split(NamedTuple):
    """A new index list, and where each new vertex comes from. Old vertices keep their place, copies are appended."""

    indices: numpy.ndarray  #: (corners,) uint32: the new vertex of each corner
    source_vertex: numpy.ndarray  #: (new vertices,) uint32: the old vertex that each copies. Gather by it
    source_corner: numpy.ndarray  #: (new vertices,) uint32: a corner whose values each has; 0xffffffff: no corner uses it


def split(
    indices: Any,
    vertex_count: int,
    attributes: Sequence[Any],
    *,
    tolerance: float = 0.0,
    threads: Union[int, str] = 1,
) -> Split:
    """Splits vertices whose corners disagree in any attribute, which makes an indexed mesh of results per corner.

    indices:      (corners,) or (faces, k), the old vertex of each corner; None: corner c is vertex c
    vertex_count: number of old vertices
    attributes:   arrays of shape (corners, k), k from 1 to 16: those of `tangents` and `normals`, for instance
    tolerance:    0: corners are equal when all bits are; above: when every number differs by at most this
    threads:      1, another number, or "all"

    >>> s = tspace.split(indices, len(positions), [tangents])
    >>> new_positions, new_tangents = positions[s.source_vertex], tangents[s.source_corner]
    """
    if isinstance(attributes, numpy.ndarray):
        raise TypeError("attributes must be a list of arrays: [tangents], not tangents")
    if not isinstance(vertex_count, (int, numpy.integer)) or isinstance(vertex_count, bool):
        raise TypeError(f"vertex_count must be a number, not {vertex_count!r}")
    if not 0 <= vertex_count <= _abi.MAX_COUNT:
        raise InputError(f"vertex_count is {vertex_count}; it must be 0 to {_abi.MAX_COUNT}", "tooLarge")
    keep, rows = [], []
    for number, attribute in enumerate(attributes):
        name = f"attributes[{number}]"
        array = numpy.asarray(attribute)
        array = float_array(name, array, array.shape[1] if array.ndim == 2 else 1)
        span, array = read_span(name, array)
        keep.append(array)
        rows.append(_abi.CornerAttribute(span.data, span.stride_bytes, array.shape[1], real("tolerance", tolerance)))
    corner_count = int(vertex_count)
    index_struct = NO_INDICES
    if indices is not None:
        array = index_array("indices", indices).ravel()
        index_struct, array = read_indices("indices", array, int(vertex_count))
        keep.append(array)
        corner_count = array.size
    for number, array in enumerate(keep[: len(rows)]):
        if len(array) != corner_count:
            raise InputError(
                f"attributes[{number}] has {len(array)} rows, there are {corner_count} corners", "countMismatch"
            )
    result = POINTER(_abi.SplitResult)()
    error = _abi.Error()
    if _library.tspace_splitVertices(
        byref(index_struct),
        int(vertex_count),
        corner_count,
        (_abi.CornerAttribute * len(rows))(*rows),
        len(rows),
        byref(execution(threads)),
        byref(result),
        byref(error),
    ):
        raise_error(error)
    try:
        made = result.contents
        return Split(
            _copied(made.indices, made.corner_count),
            _copied(made.source_vertices, made.vertex_count),
            _copied(made.source_corners, made.vertex_count),
        )
    finally:
        _library.tspace_destroySplitResult(result)


class Triangles(NamedTuple):
    """Triangles of a polygon mesh."""

    corners: numpy.ndarray  #: (triangles, 3) uint32: corners of the mesh (not vertices), winding kept
    faces: numpy.ndarray  #: (triangles,) uint32: the face that each was cut from


def triangulate(
    positions: Any, indices: Any = None, *, face_sizes: Any = None, uvs: Any = None
) -> Triangles:
    """Cuts faces of 4 and more corners into triangles.

    Quads are cut along the diagonal that MikkTSpace takes, for which it looks at `uvs` too, where they are given; n-gons by
    clipping ears. Faces of fewer than 3 corners give nothing.

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
            _copied(made.corners, 3 * made.triangle_count).reshape(-1, 3), _copied(made.faces, made.triangle_count)
        )
    finally:
        _library.tspace_destroyTriangulation(result)


class PackResult(NamedTuple):
    """Packed frames, and what was mended before."""

    frames: numpy.ndarray  #: (frames, bytes) uint8
    report: PackReport


def pack_frames(
    normals: Any, tangents: Any, format: str = "frame32", *, full: bool = False
) -> Union[numpy.ndarray, PackResult]:
    """Packs whole frames (N, T and the sign) into 4 to 16 bytes each: (frames, bytes) uint8.

    normals:  (frames, 3), unit
    tangents: (frames, 4), unit and orthogonal to N; the fourth is the sign. Row i belongs to row i of normals, so both are
              per vertex of a split mesh, or both per corner
    format:   "frame32" (4 bytes; within 0.135 degrees), "frame48" (6; 0.0042), "frame64" (8; 0.00015), "oct32" (4; 0.165),
              "qtangent64" (8; 0.004), "snorm8_pair" (8), "snorm16_pair" (16), "gltf_snorm8" (7), "gltf_snorm16" (14)
    full:     True: returns a PackResult, which has a report too

    Any input is packed: what is broken is mended and counted.
    """
    number = named("format", format, _abi.FRAME_FORMATS)
    normals = float_array("normals", normals, 3)
    tangents = float_array("tangents", tangents, 4)
    if len(normals) != len(tangents):
        raise InputError(f"normals has {len(normals)} rows, tangents has {len(tangents)}", "countMismatch")
    normals_span, normals = read_span("normals", normals)
    tangents_span, tangents = read_span("tangents", tangents)
    frames = numpy.empty((len(normals), _library.tspace_frameBytes(number)), numpy.uint8)
    counts = _abi.PackReport(ctypes.sizeof(_abi.PackReport))
    error = _abi.Error()
    if _library.tspace_packFrames(
        number, normals_span, tangents_span, frames.ctypes.data, frames.size, byref(counts), byref(error)
    ):
        raise_error(error)
    return PackResult(frames, report(PackReport, counts)) if full else frames


def unpack_frames(frames: Any, format: str = "frame32") -> Tuple[numpy.ndarray, numpy.ndarray]:
    """Unpacks frames: normals (frames, 3) and tangents (frames, 4), float32.

    frames: bytes, or an array of uint8 of any shape that holds whole frames
    format: as for `pack_frames`

    Any bytes are frames: N and T are finite and unit, the sign is +1 or -1.
    """
    number = named("format", format, _abi.FRAME_FORMATS)
    size = _library.tspace_frameBytes(number)
    if isinstance(frames, (bytes, bytearray, memoryview)):
        frames = numpy.frombuffer(frames, numpy.uint8)
    if not isinstance(frames, numpy.ndarray) or frames.dtype != numpy.uint8:
        kind = frames.dtype if isinstance(frames, numpy.ndarray) else type(frames).__name__
        raise TypeError(f"frames must be bytes or an array of uint8, not {kind}")
    frames = numpy.ascontiguousarray(frames)
    if frames.size % size:
        raise InputError(f"frames has {frames.size} bytes, which is no multiple of {size}", "countMismatch")
    count = frames.size // size
    normals, tangents = numpy.empty((count, 3), FLOAT32), numpy.empty((count, 4), FLOAT32)
    error = _abi.Error()
    if _library.tspace_unpackFrames(
        number, frames.ctypes.data, frames.size, write_span(normals), write_span(tangents), byref(error)
    ):
        raise_error(error)
    return normals, tangents
