# SPDX-License-Identifier: MIT
"""numpy arrays as the spans of the C API.

Arrays with a type and a layout that the C API supports are used without a copy. Others are converted to new arrays;
values that cannot be converted raise an error.
"""

import ctypes
import math
from typing import Any, Optional, Sequence, Tuple, Type, TypeVar

import numpy

from . import _abi
from ._errors import IndexRangeError, InputError, raise_error
from ._memory import new_array

T = TypeVar("T")
FLOAT32 = numpy.dtype(numpy.float32)
UINT32 = numpy.dtype(numpy.uint32)
INT32 = numpy.dtype(numpy.int32)
# Index types of the C API that are used without conversion. Negative int32 indices become very large, so the library
# rejects them.
_INDEX_TYPES = {
    numpy.dtype(numpy.uint8): 1,
    numpy.dtype(numpy.uint16): 2,
    UINT32: 4,
    INT32: 4,
}
_INDEX_OUT_OF_RANGE = 3
EMPTY_SPAN = _abi.Span()
NO_INDICES = _abi.Indices()


def shape_text(shape: Sequence[int]) -> str:
    return "(" + ", ".join(str(n) for n in shape) + ("," if len(shape) == 1 else "") + ")"


def _as_array(name: str, value: Any) -> numpy.ndarray:
    if value is None:
        raise TypeError(f"{name} must be an array, not None")
    try:
        return numpy.asarray(value)
    except Exception as error:
        raise TypeError(f"{name} must be an array of numbers: {error}") from error


def _converted_to_float32(name: str, value: numpy.ndarray) -> numpy.ndarray:
    try:
        with numpy.errstate(over="raise", invalid="ignore"):
            return numpy.ascontiguousarray(value, FLOAT32)
    except FloatingPointError:
        with numpy.errstate(over="ignore"):
            bad = numpy.isinf(value.astype(FLOAT32)) & ~numpy.isinf(value)
        where = tuple(int(i[0]) for i in numpy.nonzero(bad))
        place = "[" + ", ".join(str(i) for i in where) + "]"
        raise InputError(
            f"{name}{place} is {value[where]}, which is out of the range of float32", element=where[0]
        ) from None


def float_array(name: str, value: Any, components: int) -> numpy.ndarray:
    """Returns an array of shape (n, components) with real numbers of any type and layout."""
    array = value if type(value) is numpy.ndarray else _as_array(name, value)
    if array.dtype is not FLOAT32 and array.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be an array of float32, not of {array.dtype}")
    if array.shape == (0,):  # an empty list
        array = array.reshape(0, components)
    if array.ndim != 2 or array.shape[1] != components:
        raise InputError(f"{name} must have shape (n, {components}), not {shape_text(array.shape)}", "countMismatch")
    if len(array) > _abi.MAX_CORNERS:
        raise InputError(f"{name} has {len(array)} entries; at most {_abi.MAX_CORNERS} are possible", "tooLarge")
    return array


def read_span(name: str, array: numpy.ndarray) -> Tuple[_abi.Span, numpy.ndarray]:
    """Returns a span over the result of float_array or over a copy, and the array that must outlive it."""
    if array.dtype is not FLOAT32:
        array = _converted_to_float32(name, array)
    address, stride = array.ctypes.data, array.strides[0]
    if array.strides[1] != 4 or stride < 4 * array.shape[1] or (stride | address) & 3:
        array = array.copy(order="C")
        address, stride = array.ctypes.data, array.strides[0]
    return _abi.Span(address, len(array), stride), array


def output_array(out: Optional[numpy.ndarray], count: int, components: int) -> numpy.ndarray:
    """Returns the caller's array for results, after checks, or a new one. `components` 0: its shape is (count,)."""
    shape = (count, components) if components else (count,)
    if out is None:
        return new_array(shape)
    if type(out) is not numpy.ndarray or out.dtype != FLOAT32:
        kind = out.dtype if isinstance(out, numpy.ndarray) else type(out).__name__
        raise TypeError(f"out must be a numpy array of float32, not {kind}")
    if out.shape != shape:
        raise InputError(f"out must have shape {shape_text(shape)}, not {shape_text(out.shape)}", "countMismatch")
    if not out.flags.writeable:
        raise InputError("out is read-only")
    if out.size and (out.strides[1] != 4 or out.strides[0] < 4 * components or (out.strides[0] | out.ctypes.data) & 3):
        raise InputError("out must be C-contiguous within each row, with its rows in increasing order", "strideTooSmall")
    return out


def write_span(array: numpy.ndarray) -> _abi.Span:
    """Returns a span over an array that output_array() returned."""
    return _abi.Span(array.ctypes.data, len(array), array.strides[0])


def check_apart(out: Optional[numpy.ndarray], inputs: Sequence[numpy.ndarray]) -> None:
    """Raises an error if the array for results shares memory with inputs, which are read while it is written."""
    if out is None:
        return
    for array in inputs:
        if numpy.may_share_memory(out, array) and _overlap(out, array):
            raise InputError("out shares memory with an input")


def _overlap(a: numpy.ndarray, b: numpy.ndarray) -> bool:
    try:
        return numpy.shares_memory(a, b, max_work=10000)
    except Exception:  # too expensive to determine
        return True


def index_array(name: str, value: Any) -> numpy.ndarray:
    """Returns an array of integers, not yet converted."""
    array = value if type(value) is numpy.ndarray else _as_array(name, value)
    if array.dtype.kind not in "iu":
        if array.size or type(value) is numpy.ndarray:
            raise TypeError(f"{name} must be an array of integers, not of {array.dtype}")
        array = array.astype(UINT32)  # an empty list
    if array.size > _abi.MAX_CORNERS:
        raise InputError(f"{name} has {array.size} entries; at most {_abi.MAX_CORNERS} are possible", "tooLarge")
    return array


def uint32_array(name: str, value: Any) -> numpy.ndarray:
    """Returns a contiguous one-dimensional (or single-column) uint32 array; a copy if necessary."""
    array = index_array(name, value)
    if array.ndim == 2 and array.shape[1] == 1:
        array = array[:, 0]
    if array.ndim != 1:
        raise InputError(f"{name} must have shape (n,), not {shape_text(array.shape)}", "countMismatch")
    if array.dtype != UINT32:
        bad = _first_outside(array, 2**32)
        if bad is not None:
            raise InputError(f"{name}[{bad}] is {array[bad]}, which is out of the range of uint32", "invalidOption", bad)
    return numpy.require(array, UINT32, ("C", "A"))


def _first_outside(array: numpy.ndarray, end: int) -> Optional[int]:
    """Returns the position of the first number outside [0, end), or None."""
    if array.size == 0 or (int(array.min()) >= 0 and int(array.max()) < end):
        return None
    flat = array.ravel()
    return int(numpy.flatnonzero((flat < 0) | (flat >= end))[0])


def index_error(name: str, array: numpy.ndarray, place: int, entry_count: int) -> IndexRangeError:
    """Returns the error for an index out of range, with the caller's original value."""
    text = f"{name}[{place}] is {array.flat[place]}; it must be 0 or more and less than {entry_count}"
    return IndexRangeError(text, "indexOutOfRange", place)


def fail_at_index(error: _abi.Error, name: str, array: Optional[numpy.ndarray], entry_count: int) -> None:
    """Raises the C API's error. For a negative index of this list, the message has the caller's original value."""
    if error.code == _INDEX_OUT_OF_RANGE and array is not None and array.dtype == INT32:
        if error.element < array.size and array.flat[error.element] < 0:
            raise index_error(name, array, error.element, entry_count)
    raise_error(error)


def read_indices(name: str, array: numpy.ndarray, entry_count: int) -> Tuple[_abi.Indices, numpy.ndarray]:
    """Returns indices over the result of index_array or over a copy, and the array that must outlive them. entry_count:
    number of entries that the indices refer to."""
    kind = _INDEX_TYPES.get(array.dtype)
    if kind is None:
        bad = _first_outside(array, entry_count)
        if bad is not None:
            raise index_error(name, array, bad, entry_count)
        array, kind = array.astype(UINT32), 4
    if not (array.flags.c_contiguous and array.flags.aligned):
        array = array.copy(order="C")
    return _abi.Indices(array.ctypes.data, array.size, kind), array


def copied(address: Optional[int], shape: Tuple[int, ...], dtype: numpy.dtype) -> numpy.ndarray:
    """Returns a copy of 4-byte numbers that the library will free, as an array."""
    size = 4 * math.prod(shape)
    if size == 0 or address is None:
        return numpy.empty(shape, dtype)
    return numpy.frombuffer(memoryview((ctypes.c_char * size).from_address(address)), dtype).reshape(shape).copy()


def report(kind: Type[T], struct: Any) -> T:
    """Returns the named tuple for a C API struct with the same fields."""
    values = (getattr(struct, field) for field in kind._fields)  # type: ignore[attr-defined]
    kinds = kind.__annotations__.values()
    return kind(*(bool(value) if kind is bool else value for kind, value in zip(kinds, values)))
