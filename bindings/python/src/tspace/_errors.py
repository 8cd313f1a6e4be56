# SPDX-License-Identifier: MIT
"""Exceptions, and conversion of C API errors."""

import errno
import os
import re
from typing import Any, Optional, Sequence, Type

from . import _abi
from ._file_options import OPTIONS

_OUT_OF_MEMORY = 9
_FIRST_FILE_CODE = 100
_READ_WRITE_CODES = (103, 104)


class Error(Exception):
    """Base class of tspace's errors. `str(error)` describes the fault and its location.

    code:    stable name, such as "indexOutOfRange"
    element: index of the invalid element, or None
    """

    code: str
    element: Optional[int]

    def __init__(self, message: str, code: str = "invalidArgument", element: Optional[int] = None):
        super().__init__(message)
        self.code = code
        self.element = element


class InputError(Error, ValueError):
    """An argument with a valid type and an invalid value: shape, count, range, or option name."""


class UnknownOptionError(InputError, TypeError):
    """An unknown option of a file function."""


class IndexRangeError(InputError, IndexError):
    """An index that refers to no vertex."""


class FileError(Error):
    """A model file that is corrupt or uses unsupported features."""


class ReadWriteError(FileError, OSError):
    """A file that cannot be read or written. `errno` and `filename` are set if they are known."""

    def __str__(self) -> str:
        return str(self.args[0])  # OSError.__str__ would omit the message


class MissingFileError(ReadWriteError, FileNotFoundError):
    """A file, or the folder of an output, that does not exist."""


class ForbiddenFileError(ReadWriteError, PermissionError):
    """A file for which the permission to read or write is missing."""


_OF_ERRNO = {errno.ENOENT: MissingFileError, errno.ENOTDIR: MissingFileError, errno.EACCES: ForbiddenFileError}
_OF_ERRNO[errno.EPERM] = ForbiddenFileError


def _failure_of(path: bytes, is_output: bool) -> Optional[OSError]:
    """Returns the error that the system would report for a path, without changing anything."""
    try:
        if not is_output:
            if os.path.isdir(path):
                return IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
            os.close(os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)))
        elif not os.access(os.path.dirname(path) or b".", os.W_OK):
            os.stat(os.path.dirname(path) or b".")
            return PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    except OSError as error:
        return error
    return None


def read_write_error(message: str, code: str, paths: Sequence[bytes], outputs: Sequence[bytes]) -> ReadWriteError:
    """Returns the error of a call with these paths, for the first path that the system rejects."""
    for path, is_output in [*((path, False) for path in paths), *((path, True) for path in outputs)]:
        failure = _failure_of(path, is_output)
        if failure is not None and failure.errno is not None:
            error = _OF_ERRNO.get(failure.errno, ReadWriteError)(message, code)
            error.errno, error.strerror, error.filename = failure.errno, failure.strerror, os.fsdecode(path)
            return error
    return ReadWriteError(message, code)


def shown(value: Any) -> str:
    """Formats a value for messages; long values are replaced by their type."""
    text = repr(value)
    return text if len(text) <= 60 and "\n" not in text else f"an object of type {type(value).__name__}"


# Prefixes of C API messages, and the same prefixes with Python's argument names.
_IN_PYTHON = (
    (r"^crease_angle_deg ", "crease_angle "),
    (r"^angular_threshold_deg ", "threshold "),
    (r"^face sizes ", "face_sizes "),
    (r"^the (\d+ corners cannot be divided into faces)", r"face_sizes, indices: the \1"),
    (r"^index (\d+) of corner", r"indices: index \1 of corner"),
    (r"^corner (\d+) has no vertex", r"indices: corner \1 has no vertex"),
    (r"^(\w+ needs?) normals, but the mesh has none", r"normals is None: \1 them"),
    (r"^this method needs UVs, but the mesh has none", "uvs is None: this method needs UVs"),
    (r"^(only the methods lengyel and basis support|results per vertex need)", r'domain is "vertex": \1'),
    (r"^the symmetric frame ", r'frame is "symmetric": the symmetric frame '),
)

# In any place of a message: a path or another word of the caller, a value of the C API that is "auto" in Python, and an
# option of the command-line tool.
_NAME = re.compile(r"(?<!\w)'.*?'(?!\w)|\b(?:crease|denoise|weld)_auto\b(?: \(-1\))?|(?<![\w-])--([a-z]+(?:-[a-z]+)*)")
_OPTIONS = {name for names in OPTIONS.values() for name in names}


def argument_name(option: str) -> str:
    """Returns the name of an argument for an option of the command-line tool, without its dashes."""
    return "from_" if option == "from" else option.replace("-", "_")


def _python_name(found: "re.Match[str]") -> str:
    if found[1]:
        name = argument_name(found[1])
        return name if name in _OPTIONS else found[0]
    return found[0] if found[0].startswith("'") else '"auto"'


def raise_error(error: _abi.Error, paths: Sequence[bytes] = (), outputs: Sequence[bytes] = ()) -> None:
    """Raises the C API's error. paths, outputs: files that the call read and wrote."""
    message = error.message.decode("utf-8", "replace")
    for pattern, words in _IN_PYTHON:
        message = re.sub(pattern, words, message)
    message = _NAME.sub(_python_name, message)
    if error.code == _OUT_OF_MEMORY:
        raise MemoryError(message)
    code = _abi.library.tspace_errorName(error.code).decode()
    element = None if error.element == _abi.NO_ELEMENT else error.element
    kind: Type[Error]
    if error.code >= _FIRST_FILE_CODE:
        if error.code in _READ_WRITE_CODES:
            raise read_write_error(message, code, paths, outputs)
        kind = FileError
    elif code == "indexOutOfRange":
        kind = IndexRangeError
    elif code in ("internal", "cancelled"):
        kind = Error
    else:
        kind = InputError
    raise kind(message, code, element)
