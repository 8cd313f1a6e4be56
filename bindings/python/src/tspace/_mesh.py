# SPDX-License-Identifier: MIT
"""A mesh of numpy arrays as the struct of the C API."""

import ctypes
import numbers
from typing import Any, List, Optional

import numpy

from . import _abi
from ._arrays import EMPTY_SPAN, INT32, NO_INDICES, float_array, index_array, index_error, read_indices, read_span, uint32_array
from ._errors import InputError, raise_error

_INDEX_OUT_OF_RANGE = 3
_SIZE = ctypes.sizeof(_abi.Mesh)


class Mesh:
    """The struct, with the arrays that it points into.

    positions  (vertices, 3); normals (vertices, 3) or None; uvs (vertices, 2) or None
    indices    None: corner c is vertex c. (corners,), or (faces, k): faces of k corners
    face_sizes None: triangles, or what the shape of `indices` says. A number: corners of every face. (faces,): of each
    """

    __slots__ = ("arrays", "corner_count", "struct", "vertex_count")

    def __init__(self, positions: Any, normals: Any, uvs: Any, indices: Any, face_sizes: Any):
        # All shapes first, so that nothing large is copied for a call that fails.
        positions = float_array("positions", positions, 3)
        if normals is not None:
            normals = float_array("normals", normals, 3)
        if uvs is not None:
            uvs = float_array("uvs", uvs, 2)
        if indices is not None:
            indices = index_array("indices", indices)
        self.vertex_count = len(positions)
        self.check_count("normals", normals)
        self.check_count("uvs", uvs)

        face_size = self._face_size(indices, face_sizes)
        positions_span, positions = read_span("positions", positions)
        self.arrays: List[numpy.ndarray] = [positions]
        normals_span = self._span("normals", normals)
        uvs_span = self._span("uvs", uvs)
        if indices is None:
            indices_struct = NO_INDICES
            self.corner_count = self.vertex_count
        else:
            indices_struct, indices = read_indices("indices", indices, self.vertex_count)
            self.arrays.append(indices)
            self.corner_count = indices.size
        sizes_address, face_count = None, 0
        if face_size is None:
            face_sizes = uint32_array("face_sizes", face_sizes)
            self.arrays.append(face_sizes)
            face_size, sizes_address, face_count = 0, face_sizes.ctypes.data, face_sizes.size
        self.struct = _abi.Mesh(
            _SIZE,
            face_size,
            positions_span,
            normals_span,
            uvs_span,
            indices_struct,
            sizes_address,
            face_count,
        )

    def check_count(self, name: str, array: Optional[numpy.ndarray]) -> None:
        if array is not None and len(array) != self.vertex_count:
            raise InputError(f"{name} has {len(array)} entries, positions has {self.vertex_count}", "countMismatch")

    def fail(self, error: _abi.Error) -> None:
        """Raises what the C API said, with a negative index as the caller wrote it."""
        for array in self.arrays:
            if error.code == _INDEX_OUT_OF_RANGE and array.dtype == INT32:
                raise index_error("indices", array, error.element, self.vertex_count)
        raise_error(error)

    def _span(self, name: str, array: Optional[numpy.ndarray]) -> _abi.Span:
        if array is None:
            return EMPTY_SPAN
        span, array = read_span(name, array)
        self.arrays.append(array)
        return span

    @staticmethod
    def _face_size(indices: Optional[numpy.ndarray], face_sizes: Any) -> Optional[int]:
        """Corners of every face; None where `face_sizes` is an array."""
        if indices is not None and indices.ndim == 2:
            if face_sizes is not None:
                raise InputError("indices of shape (faces, k) say how many corners faces have: leave face_sizes out")
            if indices.shape[1] == 0:
                raise InputError("indices has shape (n, 0): faces without corners")
            return indices.shape[1]
        if indices is not None and indices.ndim != 1:
            raise InputError(f"indices must have shape (corners,) or (faces, k), not {indices.shape}", "countMismatch")
        if face_sizes is None:
            return 3
        if isinstance(face_sizes, numbers.Integral):
            if isinstance(face_sizes, bool) or not 1 <= face_sizes <= _abi.MAX_COUNT:
                raise InputError(f"face_sizes is {face_sizes}; faces must have 1 corner or more", "invalidOption")
            return int(face_sizes)
        return None
