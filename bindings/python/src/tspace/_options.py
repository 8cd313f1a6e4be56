# SPDX-License-Identifier: MIT
"""Named options, and conventions."""

import ctypes
import functools
import math
import numbers
from ctypes import byref
from dataclasses import dataclass
from typing import Any, Dict, Union

from . import _abi
from ._errors import InputError, raise_error, shown
from ._types import PresetName, Threads


def named(option: str, name: Any, table: Dict[str, int]) -> int:
    """Returns the number for a name."""
    number = table.get(name) if isinstance(name, str) else None
    if number is None:
        known = ", ".join(repr(known) for known in table)
        if not isinstance(name, str):
            raise TypeError(f"{option} must be one of {known}, not {shown(name)}")
        raise InputError(f"{option} is {shown(name)}; it must be one of {known}", "invalidOption")
    return number


@dataclass(frozen=True)
class Convention:
    """Convention of a format or engine: determines the sign of tangents, and which side of a face is outside.

    Functions accept a Convention or the name of a preset: "gltf", "opengl", "directx", "unreal", "unity", "blender",
    "godot".

    v_axis:      "up" (v = 0 is the bottom row of the image) or "down" (the top row, as in glTF); has no default
    green:       direction of large green values: "up" (toward the top row, "OpenGL") or "down" ("DirectX")
    stored_sign: "as_is" (B = sign * cross(N, T)) or "negated"
    handedness:  of the coordinate system, "right" or "left"
    winding:     of a face seen from outside, "counter_clockwise" or "clockwise"
    """

    v_axis: str
    green: str = "up"
    stored_sign: str = "as_is"
    handedness: str = "right"
    winding: str = "counter_clockwise"

    @staticmethod
    def preset(name: PresetName) -> "Convention":
        """Returns the preset with this name."""
        found = convention_struct(name)
        values = []
        for table, number in zip(_CONVENTION_TABLES, (getattr(found, field) for field, _ in found._fields_)):
            values.append(next(word for word, value in table.items() if value == number))
        return Convention(*values)


_CONVENTION_TABLES = (_abi.V_AXES, _abi.GREENS, _abi.STORED_SIGNS, _abi.HANDEDNESSES, _abi.WINDINGS)
_PRESETS = ", ".join(map(repr, _abi.CONVENTIONS))
ConventionLike = Union[PresetName, Convention]


@functools.lru_cache(maxsize=64)
def _convention_struct(convention: Any) -> _abi.Convention:
    struct = _abi.Convention()
    if isinstance(convention, Convention):
        for (field, _), table in zip(struct._fields_, _CONVENTION_TABLES):
            setattr(struct, field, named(field, getattr(convention, field), table))
        return struct
    if convention not in _abi.CONVENTIONS:
        raise InputError(f"convention is {shown(convention)}; it must be one of {_PRESETS}", "invalidOption")
    error = _abi.Error()
    if _abi.library.tspace_findConvention(convention.encode(), byref(struct), byref(error)):
        raise_error(error)
    return struct


def convention_struct(convention: Any) -> _abi.Convention:
    """Returns the struct of the C API; it is shared, so it must not be modified."""
    if not isinstance(convention, (str, Convention)):
        raise TypeError(f"convention must be a tspace.Convention or one of {_PRESETS}, not {shown(convention)}")
    return _convention_struct(convention)


def thread_count(threads: Threads) -> int:
    """Returns the thread count for the C API: `threads` is a number of at least 1, or "all"."""
    if type(threads) is int and threads == 1:
        return 1
    if isinstance(threads, str) and threads == "all":
        return _abi.ALL_THREADS
    count = small_number("threads", threads)
    if not 1 <= count < _abi.ALL_THREADS:
        raise InputError(f'threads is {threads}; it must be 1 or more, or "all"', "invalidOption")
    return count


def execution(threads: Threads) -> _abi.Execution:
    return _abi.Execution(ctypes.sizeof(_abi.Execution), thread_count(threads))


def real(option: str, value: Any) -> float:
    """Checks a real number; the library checks its range."""
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        raise TypeError(f"{option} must be a real number, not {shown(value)}")
    if math.isnan(value):
        raise InputError(f"{option} must not be NaN", "invalidOption")
    return float(value)


def real_or_auto(option: str, value: Any) -> float:
    """Checks a real number, or "auto", which is -1 in the library. Callers cannot pass -1: it becomes another negative
    number, so that the library's error states the valid range."""
    if isinstance(value, str):
        if value == "auto":
            return -1.0
        raise TypeError(f'{option} must be a real number or "auto", not {shown(value)}')
    number = real(option, value)
    return -2.0 if number < 0 else number


def small_number(option: str, value: Any) -> int:
    """Checks an integer that fits a uint32; the library checks its range."""
    if not isinstance(value, numbers.Integral) or isinstance(value, bool):
        raise TypeError(f"{option} must be an integer, not {shown(value)}")
    number = int(value)
    if not 0 <= number < 2**32:
        raise InputError(f"{option} is {value}, but must be from 0 to 4294967295", "invalidOption")
    return number
