# SPDX-License-Identifier: MIT
"""Conversion of a mesh of numpy arrays to the struct of the C API."""

import ctypes
import numbers
from typing import Any, List, Optional, Tuple

import numpy

from . import _abi
from ._arrays import (
    EMPTY_SPAN,
    NO_INDICES,
    fail_at_index,
    float_array,
    index_array,
    read_indices,
    read_span,
    shape_text,
    uint32_array,
)
from ._errors import InputError, raise_error

# Prefixes of C API messages about an index.
_INDEX_WORDS = {"indices": b"index ", "normal_indices": b"normal_indices ", "uv_indices": b"uv_indices "}
_SIZE = ctypes.sizeof(_abi.Mesh)


class Mesh:
    """The C struct, and the arrays that it refers to.

    positions  (vertices, 3); normals (vertices, 3) or None; uvs (vertices, 2) or None
    indices    None: corner c is vertex c. (corners,), also as a column (corners, 1), or (faces, k): faces of k corners
    face_sizes None: triangles, or the shape of `indices`. A number: corners of every face. (faces,): corners of each face
    normal_indices, uv_indices  None: one entry per vertex. "corners": one per corner. Otherwise an array like `indices`
    """

    __slots__ = ("_list_shape", "_lists", "arrays", "corner_count", "struct", "vertex_count")

    def __init__(
        self,
        positions: Any,
        normals: Any,
        uvs: Any,
        indices: Any,
        face_sizes: Any,
        normal_indices: Any = None,
        uv_indices: Any = None,
    ):
        # All shapes are checked first, so that nothing large is copied for a call that fails.
        positions = float_array("positions", positions, 3)
        if normals is not None:
            normals = float_array("normals", normals, 3)
        if uvs is not None:
            uvs = float_array("uvs", uvs, 2)
        if indices is not None:
            indices = _face_indices(index_array("indices", indices))
        self.vertex_count = len(positions)
        self.corner_count = self.vertex_count if indices is None else indices.size
        self._check_count("normals", normals, normal_indices)
        self._check_count("uvs", uvs, uv_indices)
        face_size = _face_size(indices, face_sizes)
        self._list_shape = None if indices is None else indices.shape

        self.arrays: List[numpy.ndarray] = []
        self._lists: List[Tuple[str, numpy.ndarray, int]] = []
        self.struct = _abi.Mesh(
            _SIZE,
            face_size or 0,
            self._span("positions", positions),
            self._span("normals", normals),
            self._span("uvs", uvs),
            self._indices("indices", indices, self.vertex_count),
        )
        if face_size is None:
            face_sizes = uint32_array("face_sizes", face_sizes)
            self.arrays.append(face_sizes)
            self.struct.face_sizes, self.struct.face_count = face_sizes.ctypes.data, face_sizes.size
        if normal_indices is not None:
            self.struct.normal_indices = self._attribute_indices("normal_indices", normal_indices, normals)
        if uv_indices is not None:
            self.struct.uv_indices = self._attribute_indices("uv_indices", uv_indices, uvs)

    def _check_count(self, name: str, array: Optional[numpy.ndarray], indices: Any) -> None:
        if array is None or not (indices is None or isinstance(indices, str)):
            return
        count, what = (self.vertex_count, "positions has") if indices is None else (self.corner_count, "corners are")
        if len(array) != count:
            raise InputError(f"{name} has {len(array)} entries, {what} {count}", "countMismatch")

    def fail(self, error: _abi.Error) -> None:
        """Raises the C API's error; for a negative index, with the caller's original value."""
        for name, array, count in self._lists:
            if error.message.startswith(_INDEX_WORDS[name]):
                fail_at_index(error, name, array, count)
        raise_error(error)

    def _span(self, name: str, array: Optional[numpy.ndarray]) -> _abi.Span:
        if array is None:
            return EMPTY_SPAN
        span, array = read_span(name, array)
        self.arrays.append(array)
        return span

    def _indices(self, name: str, array: Optional[numpy.ndarray], count: int) -> _abi.Indices:
        if array is None:
            return NO_INDICES
        struct, array = read_indices(name, array, count)
        self.arrays.append(array)
        self._lists.append((name, array, count))
        return struct

    def _attribute_indices(self, name: str, value: Any, attribute: Optional[numpy.ndarray]) -> _abi.Indices:
        if isinstance(value, str):
            if value != "corners":
                raise InputError(f'{name} is {value!r}; it must be an array, "corners" or None', "invalidOption")
            return _abi.Indices(None, 0, _abi.INDEX_TYPES["corners"])
        array = index_array(name, value)
        if array.size != self.corner_count:
            raise InputError(f"{name} has {array.size} entries, but the mesh has {self.corner_count} corners", "countMismatch")
        shapes = [(array.size,), (array.size, 1)]
        if self._list_shape is not None and len(self._list_shape) == 2:
            shapes.append(self._list_shape)
        elif self.struct.face_size and self.corner_count % self.struct.face_size == 0:
            shapes.append((self.corner_count // self.struct.face_size, self.struct.face_size))
        if array.shape not in shapes:
            wanted = " or ".join(shape_text(shape) for shape in shapes)
            raise InputError(f"{name} must have shape {wanted}, not {shape_text(array.shape)}", "countMismatch")
        return self._indices(name, array, 0 if attribute is None else len(attribute))


def _face_indices(indices: numpy.ndarray) -> numpy.ndarray:
    """Returns the indices without the second dimension of a column, which is how numpy reads an accessor of scalars.
    Shapes that are probably a mistake are rejected: faces of two corners would give zeros, and one large face a wrong
    result."""
    if indices.ndim != 2 or indices.shape[1] == 0:
        return indices
    rows, columns = indices.shape
    if columns == 1:
        return indices[:, 0]
    if columns == 2:
        raise InputError(
            f"indices of shape {shape_text(indices.shape)} would be faces of 2 corners; use shape (corners,), or "
            "(faces, k) with 3 corners or more",
            "countMismatch",
        )
    if rows == 1 and columns > 4:
        raise InputError(
            f"indices of shape {shape_text(indices.shape)} would be a single face of {columns} corners. For triangles use shape "
            f"(corners,) or (faces, 3); for this one face use shape ({columns},) and face_sizes={columns}",
            "countMismatch",
        )
    return indices


def _face_size(indices: Optional[numpy.ndarray], face_sizes: Any) -> Optional[int]:
    """Returns the number of corners of every face; None if `face_sizes` is an array."""
    if indices is not None and indices.ndim == 2:
        if face_sizes is not None:
            raise InputError("face_sizes cannot be used with indices of shape (faces, k), which determines the number of corners per face")
        if indices.shape[1] == 0:
            raise InputError("indices of shape (n, 0) have no corners per face")
        return indices.shape[1]
    if indices is not None and indices.ndim != 1:
        raise InputError(
            f"indices must have shape (corners,) or (faces, k), not {shape_text(indices.shape)}", "countMismatch"
        )
    if face_sizes is None:
        return 3
    if isinstance(face_sizes, numbers.Integral):
        if isinstance(face_sizes, bool) or not 1 <= int(face_sizes) <= _abi.MAX_CORNERS:
            raise InputError(f"face_sizes is {face_sizes}; faces must have at least 1 corner", "invalidOption")
        return int(face_sizes)
    return None
