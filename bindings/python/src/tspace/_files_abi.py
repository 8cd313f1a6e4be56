# SPDX-License-Identifier: MIT
"""The C API of model files, as ctypes. The library is loaded when it is first needed."""

import ctypes
import functools
from ctypes import CFUNCTYPE, POINTER, Structure, c_char_p, c_size_t, c_uint32, c_void_p

from ._abi import Error as ErrorStruct
from ._abi import declare, load
from ._errors import Error

# Wheels that were compiled for another system than that of their build have arrays alone.
NO_FILES = "this package has no library for model files, only for arrays: take the one that scripts/python builds on your system"


class Bytes(Structure):
    _fields_ = [("data", c_void_p), ("size", c_size_t)]


FindFile = CFUNCTYPE(c_uint32, c_void_p, c_char_p, POINTER(c_void_p), POINTER(c_size_t))


class Model(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("data", c_void_p),
        ("size", c_size_t),
        ("name", c_char_p),
        ("find_file", FindFile),
        ("user", c_void_p),
    ]


# A path, a model, options as JSON, and what comes back.
_PATH, _MODEL, _OPTIONS, _BACK = c_char_p, POINTER(Model), c_char_p, (POINTER(Bytes), POINTER(ErrorStruct))
SIGNATURES = {
    "tspace_destroyBytes": (None, POINTER(Bytes)),
    "tspace_generateFile": (c_uint32, _PATH, _PATH, _OPTIONS, *_BACK),
    "tspace_generateBytes": (c_uint32, _MODEL, _OPTIONS, POINTER(Bytes), *_BACK),
    "tspace_checkFile": (c_uint32, _PATH, _OPTIONS, *_BACK),
    "tspace_checkBytes": (c_uint32, _MODEL, _OPTIONS, *_BACK),
    "tspace_inspectFile": (c_uint32, _PATH, _OPTIONS, *_BACK),
    "tspace_inspectBytes": (c_uint32, _MODEL, _OPTIONS, *_BACK),
    "tspace_identifyFile": (c_uint32, _PATH, _OPTIONS, *_BACK),
    "tspace_identifyBytes": (c_uint32, _MODEL, _OPTIONS, *_BACK),
    "tspace_diffFiles": (c_uint32, _PATH, _PATH, _OPTIONS, *_BACK),
    "tspace_diffBytes": (c_uint32, _MODEL, _MODEL, _OPTIONS, *_BACK),
    "tspace_flipGreenFile": (c_uint32, _PATH, _PATH, _OPTIONS, *_BACK),
    "tspace_convertMapFile": (c_uint32, _PATH, _PATH, _OPTIONS, *_BACK),
    "tspace_heightToNormalFile": (c_uint32, _PATH, _PATH, _OPTIONS, *_BACK),
    "tspace_compressMapFile": (c_uint32, _PATH, _PATH, _OPTIONS, *_BACK),
    "tspace_compressMapBytes": (c_uint32, c_void_p, c_size_t, _OPTIONS, POINTER(Bytes), *_BACK),
    "tspace_bakeFile": (c_uint32, _PATH, _PATH, _PATH, _OPTIONS, *_BACK),
    "tspace_finishFile": (c_uint32, _PATH, _PATH, _OPTIONS, *_BACK),
    "tspace_flipGreenBytes": (c_uint32, c_void_p, c_size_t, _OPTIONS, POINTER(Bytes), *_BACK),
}


@functools.lru_cache(maxsize=None)
def library() -> ctypes.CDLL:
    """libtspace-files.so.0, with its functions declared."""
    try:
        loaded = load("tspace-files")
    except OSError as error:
        raise Error(f"{NO_FILES} ({error})", "unsupported") from error
    declare(loaded, SIGNATURES)
    return loaded
