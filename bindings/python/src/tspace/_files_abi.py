# SPDX-License-Identifier: MIT
"""The C API of model files, as ctypes. The library is loaded when it is first needed."""

import ctypes
import functools

from ._abi import FILE_SIGNATURES
from ._errors import Error
from ._library import declare, load

# Wheels that were compiled for another system than that of their build have arrays alone.
NO_FILES = "this package has no library for model files, only for arrays: take the one that scripts/python builds on your system"


@functools.lru_cache(maxsize=None)
def library() -> ctypes.CDLL:
    """libtspace-files.so.0, with its functions declared."""
    try:
        loaded = load("tspace-files")
    except OSError as error:
        raise Error(f"{NO_FILES} ({error})", "unsupported") from error
    declare(loaded, FILE_SIGNATURES)
    return loaded
