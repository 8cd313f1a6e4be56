# SPDX-License-Identifier: MIT
"""Finds and loads the shared libraries."""

import ctypes
import sys
from pathlib import Path


def file_name(name):
    """Returns the file name of a library on this system."""
    if sys.platform == "win32":
        return f"{name}.dll"
    return f"lib{name}.dylib" if sys.platform == "darwin" else f"lib{name}.so.0"


def load(name):
    """Loads the shared library with this name: from the package, otherwise from the system."""
    name = file_name(name)
    bundled = Path(__file__).parent / "_lib" / name
    try:
        return ctypes.CDLL(str(bundled) if bundled.exists() else name)
    except OSError as error:
        # Messages of the loader if the library exists but memory does not suffice.
        if any(words in str(error) for words in ("failed to map segment", "annot allocate", "cannot map")):
            raise MemoryError(str(error)) from error
        raise


def declare(library, signatures):
    """Declares argument and result types of functions: {name: (result, argument...)}."""
    for name, (result, *arguments) in signatures.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
