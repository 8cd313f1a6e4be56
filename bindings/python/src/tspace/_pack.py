# SPDX-License-Identifier: MIT
"""Packing of complete frames into a few bytes."""

import ctypes
from ctypes import byref
from typing import NamedTuple, Tuple, Union

import numpy

from . import _abi
from ._arrays import FLOAT32, float_array, read_span, report, write_span
from ._errors import InputError, raise_error
from ._options import named
from ._reports import PackReport
from ._types import ByteArray, FloatArray, FrameFormatName, Rows

_library = _abi.library


class PackResult(NamedTuple):
    """Packed frames, and a report on repairs."""

    frames: ByteArray  #: (frames, bytes) uint8
    report: PackReport


def pack_frames(
    normals: Rows, tangents: Rows, format: FrameFormatName = "frame32", *, full: bool = False
) -> Union[ByteArray, PackResult]:
    """Packs complete frames (N, T and the sign) into 4 to 16 bytes each: (frames, bytes) uint8.

    normals:  (frames, 3), unit
    tangents: (frames, 4), unit and orthogonal to N; the fourth is the sign. Rows of both arrays
              correspond: both per vertex of a split mesh, or both per corner
    format:   "frame32" (4 bytes; within 0.135 degrees), "frame48" (6; 0.0042), "frame64" (8; 0.00015), "oct32" (4; 0.165),
              "qtangent64" (8; 0.004), "snorm8_pair" (8), "snorm16_pair" (16), "gltf_snorm8" (7), "gltf_snorm16" (14)
    full:     True: returns a PackResult, which includes a report

    Accepts any input: invalid frames are repaired and counted.
    """
    number = named("format", format, _abi.FRAME_FORMATS)
    normals = float_array("normals", normals, 3)
    tangents = float_array("tangents", tangents, 4)
    if len(normals) != len(tangents):
        raise InputError(f"normals has {len(normals)} rows, but tangents has {len(tangents)}", "countMismatch")
    normals_span, normals = read_span("normals", normals)
    tangents_span, tangents = read_span("tangents", tangents)
    frames = numpy.empty((len(normals), _library.tspace_frameBytes(number)), numpy.uint8)
    counts = _abi.PackReport(ctypes.sizeof(_abi.PackReport))
    error = _abi.Error()
    if _library.tspace_packFrames(
        normals_span, tangents_span, number, frames.ctypes.data, frames.size, byref(counts), byref(error)
    ):
        raise_error(error)
    return PackResult(frames, report(PackReport, counts)) if full else frames


def unpack_frames(
    frames: Union[bytes, bytearray, memoryview, ByteArray], format: FrameFormatName = "frame32"
) -> Tuple[FloatArray, FloatArray]:
    """Unpacks frames: normals (frames, 3) and tangents (frames, 4), float32.

    frames: bytes, or a uint8 array of any shape that contains complete frames
    format: see `pack_frames`

    All bytes are valid frames: N and T are finite and unit, the sign is +1 or -1.
    """
    number = named("format", format, _abi.FRAME_FORMATS)
    size = _library.tspace_frameBytes(number)
    if isinstance(frames, (bytes, bytearray, memoryview)):
        frames = numpy.frombuffer(frames, numpy.uint8)
    if not isinstance(frames, numpy.ndarray) or frames.dtype != numpy.uint8:
        kind = frames.dtype if isinstance(frames, numpy.ndarray) else type(frames).__name__
        raise TypeError(f"frames must be bytes or an array of uint8, not {kind}")
    frames = numpy.ascontiguousarray(frames)
    if frames.size % size:
        raise InputError(f"frames has {frames.size} bytes, which is not a multiple of {size}", "countMismatch")
    count = frames.size // size
    normals, tangents = numpy.empty((count, 3), FLOAT32), numpy.empty((count, 4), FLOAT32)
    error = _abi.Error()
    if _library.tspace_unpackFrames(
        frames.ctypes.data, frames.size, number, write_span(normals), write_span(tangents), byref(error)
    ):
        raise_error(error)
    return normals, tangents
