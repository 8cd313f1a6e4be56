# SPDX-License-Identifier: MIT
"""The C API of model files, as ctypes. The library is loaded when it is first needed."""

import ctypes
import functools

from ._abi import FILE_SIGNATURES
from ._errors import Error
from ._library import declare, load

# Wheels that were cross-compiled for another system contain only the functions on arrays.
NO_FILES = "this package has no library for model files, only for arrays: take the one that scripts/python builds on your system"


@functools.lru_cache(maxsize=None)
def library() -> ctypes.CDLL:
    """Loads libtspace-files.so.0 and declares its functions."""
    try:
        loaded = load("tspace-files")
    except OSError as error:
        raise Error(f"{NO_FILES} ({error})", "unsupported") from error
    declare(loaded, FILE_SIGNATURES)
    return loaded
