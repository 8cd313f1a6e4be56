# SPDX-License-Identifier: MIT
"""How the shared libraries are found and loaded."""

import ctypes
import sys
from pathlib import Path


def file_name(name):
    """The file of a library on this system."""
    if sys.platform == "win32":
        return f"{name}.dll"
    return f"lib{name}.dylib" if sys.platform == "darwin" else f"lib{name}.so.0"


def load(name):
    """The shared library of this name: the one in the package, or else the system's."""
    name = file_name(name)
    bundled = Path(__file__).parent / "_lib" / name
    try:
        return ctypes.CDLL(str(bundled) if bundled.exists() else name)
    except OSError as error:
        # The loader's words for a library that is there, and for which there is no memory.
        if any(words in str(error) for words in ("failed to map segment", "annot allocate", "cannot map")):
            raise MemoryError(str(error)) from error
        raise


def declare(library, signatures):
    """Says what functions take and give: {name: (result, argument...)}."""
    for name, (result, *arguments) in signatures.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
