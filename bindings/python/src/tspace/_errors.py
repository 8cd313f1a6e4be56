# SPDX-License-Identifier: MIT
"""Exceptions, and turning the errors of the C API into them."""

import re
from typing import Any, Optional, Type

from . import _abi

_OUT_OF_MEMORY = 9
_FIRST_FILE_CODE = 100
_READ_WRITE_CODES = (103, 104)


class Error(Exception):
    """What tspace refused. `str(error)` says what is wrong and where.

    code:    a stable name, such as "indexOutOfRange"
    element: the number of the element that is wrong, or None
    """

    code: str
    element: Optional[int]

    def __init__(self, message: str, code: str = "invalidArgument", element: Optional[int] = None):
        super().__init__(message)
        self.code = code
        self.element = element


class InputError(Error, ValueError):
    """An argument with the right type and a wrong value: shape, count, range, name of an option."""


class UnknownOptionError(InputError, TypeError):
    """An option that a function of files does not have."""


class IndexRangeError(InputError, IndexError):
    """An index that names no vertex."""


class FileError(Error):
    """A model file that is broken, or has what tspace does not read."""


class ReadWriteError(FileError, OSError):
    """A file that cannot be read or written."""


def shown(value: Any) -> str:
    """A value as messages show it: what is long by its type."""
    text = repr(value)
    return text if len(text) <= 60 and "\n" not in text else f"an object of type {type(value).__name__}"


# How messages of the C API begin, and how they begin with the name of the argument here.
_IN_PYTHON = (
    (r"^crease_angle_deg ", "crease "),
    (r"^face sizes ", "face_sizes "),
    (r"^(\d+ corners are not a whole number of faces)", r"face_sizes, indices: \1"),
    (r"^index (\d+) of corner", r"indices: index \1 of corner"),
    (r"^corner (\d+) has no vertex", r"indices: corner \1 has no vertex"),
    (r"^(\w+ needs?) normals, and the mesh has none", r"normals is None: \1 them"),
    (r"^this method needs UVs, and the mesh has none", "uvs is None: this method needs UVs"),
    (r"^(only lengyel and basis have|results per vertex need)", r'domain is "vertex": \1'),
    (r"^the symmetric frame ", r'frame is "symmetric": the symmetric frame '),
)


def raise_error(error: _abi.Error) -> None:
    """Raises what the C API said."""
    message = error.message.decode("utf-8", "replace")
    for pattern, words in _IN_PYTHON:
        message = re.sub(pattern, words, message)
    if error.code == _OUT_OF_MEMORY:
        raise MemoryError(message)
    code = _abi.library.tspace_errorName(error.code).decode()
    element = None if error.element == _abi.NO_ELEMENT else error.element
    kind: Type[Error]
    if error.code >= _FIRST_FILE_CODE:
        kind = ReadWriteError if error.code in _READ_WRITE_CODES else FileError
    elif code == "indexOutOfRange":
        kind = IndexRangeError
    elif code in ("internal", "cancelled"):
        kind = Error
    else:
        kind = InputError
    raise kind(message, code, element)
