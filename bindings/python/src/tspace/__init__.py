# SPDX-License-Identifier: MIT
"""Normals and tangent frames for meshes: the (T, B, N) and the sign that normal maps need.

A *corner* is one (face, local vertex) pair; corners are numbered face after face. A *vertex* is one entry of the arrays. One
vertex can need several tangents (at UV seams, where the UV map is mirrored), so results come per corner. The *sign* is the
fourth number of a tangent: B = sign * cross(N, T). A *convention* says what a format means by it, so it must be named.

An indexed mesh with tangents, in one call:

>>> import numpy, tspace
>>> positions = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], numpy.float32)
>>> uvs = numpy.array([[0, 1], [1, 1], [1, 0], [0, 0]], numpy.float32)
>>> indices = numpy.array([[0, 1, 2], [0, 2, 3]], numpy.uint32)
>>> mesh = tspace.make_indexed_frames(positions, None, uvs, indices, convention="gltf")
>>> mesh.indices.tolist(), mesh.normals[0].tolist(), mesh.tangents[0].tolist()
([0, 1, 2, 0, 2, 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0])
>>> new_positions, new_uvs = positions[mesh.source_vertices], uvs[mesh.source_vertices]

The same in steps: tangents per corner, mended, then split:

>>> normals = numpy.broadcast_to(numpy.float32([0, 0, 1]), positions.shape)
>>> tangents = tspace.tangents(positions, normals, uvs, indices, convention="gltf")
>>> tangents.shape
(6, 4)
>>> mended = tspace.sanitize(tangents, positions, normals, indices)
>>> mesh = tspace.split(indices, len(positions), [mended])
>>> positions[mesh.source_vertices].shape, mended[mesh.source_corners].shape
((4, 3), (4, 4))

A mesh that deforms:

>>> plan = tspace.Plan(positions, normals, uvs, indices, convention="gltf")
>>> bool((plan.evaluate(positions, normals) == tangents).all())
True

Functions
    make_indexed_frames   normals where missing, tangents, mended and split: an indexed mesh
    tangents        one tangent per corner, by nine methods; "mikktspace" gives every bit of the reference
    tangents_of_meshes   the same for many meshes (MeshJob) in one call
    normals         one normal per corner; crease angles, smoothing groups
    Plan            groups once, tangents for every pose
    plan_buffers    a plan as arrays, for compute shaders
    mend_winding    turns faces that are wound the wrong way
    sanitize        mends broken tangents, leaves every other bit alone
    split           from corners back to an indexed mesh
    triangulate     quads and n-gons into triangles
    pack_frames, unpack_frames   N, T and the sign in 4 to 16 bytes

Model files (glTF, GLB, OBJ), on disk or in memory
    generate_file, generate_bytes   adds normals and tangents where materials need them
    check           what is wrong with a model's frames, as findings
    remedy_text     how to mend one of them, with calls of this module
    identify        which method made its tangents
    diff            the angles between the frames of two models
    inspect         what is in a file
    flip_green_file, flip_green_bytes   inverts the green channel of a normal map
    convert_map_file                    converts a normal map for other tangents, another space or another program
    height_to_normal_file               makes a normal map of a height map
    compress_map_file, compress_map_bytes   packs a normal map as a texture for engines
    bake_file       bakes the maps of a low poly from a high poly
    finish_file     makes a mesh of a generator or a scanner ready, with all maps

Arrays
    Positions and normals have shape (vertices, 3), UVs (vertices, 2), indices (corners,) or (faces, k); units are yours, angles
    are degrees. Arrays of float32 are read where they lie, with any stride, and so are indices of uint8, uint16, uint32 and
    int32. Other real numbers (float64, float16, integers, lists) are converted into a new array of float32, other integers
    into uint32; so are layouts such as reversed or broadcast arrays. Numbers that do not fit, and all other types (complex,
    bool, text), are an error.

Errors
    TypeError for what is no array of numbers, InputError (a ValueError) for wrong shapes and options, IndexRangeError (an
    IndexError too) for indices: they say which argument, and where. FileError for broken models, ReadWriteError (an OSError) for
    files that cannot be read or written. An option that does not exist is a TypeError that lists those that do
    (UnknownOptionError, for models). Broken geometry is no error: it is counted in the reports
    that `full=True` gives.

Threads
    The interpreter's lock is free during each call. Do not write to arrays while another thread's call reads them. A call
    uses one thread unless `threads` says more; the bits are the same for any number.
"""

from typing import TYPE_CHECKING

from ._abi import library as _library
from ._errors import Error, FileError, IndexRangeError, InputError, ReadWriteError, UnknownOptionError
from ._files import (
    BakeReport,
    CheckReport,
    CompressMapReport,
    DiffReport,
    Finding,
    FinishReport,
    FlipGreenReport,
    ConvertMapReport,
    HeightToNormalReport,
    Generated,
    GenerateReport,
    IdentifyReport,
    InspectReport,
    Report,
)
from ._indexed import IndexedFrames, IndexedFramesReport, make_indexed_frames
from ._normals import NormalResult, normals, position_noise
from ._options import Convention
from ._pack import PackResult, pack_frames, unpack_frames
from ._plan_buffers import PlanBuffers, plan_buffers
from ._reports import NormalReport, PackReport, PositionNoise, SanitizeReport, TangentReport, WindingReport
from ._remedies import remedy_text
from ._sanitize import SanitizeResult, sanitize
from ._split import Split, Triangles, split, triangulate
from ._tangents import MeshJob, Plan, TangentResult, tangents, tangents_of_meshes
from ._winding import WindingResult, mend_winding

# Type checkers see each option of the functions of files; at run time an unknown one is an error that lists them.
if TYPE_CHECKING:
    from ._file_calls import (
        bake_file,
        check,
        compress_map_bytes,
        compress_map_file,
        diff,
        finish_file,
        flip_green_bytes,
        flip_green_file,
        generate_bytes,
        generate_file,
        convert_map_file,
        height_to_normal_file,
        identify,
        inspect,
    )
else:
    from ._files import (
        bake_file,
        check,
        compress_map_bytes,
        compress_map_file,
        diff,
        finish_file,
        flip_green_bytes,
        flip_green_file,
        generate_bytes,
        generate_file,
        convert_map_file,
        height_to_normal_file,
        identify,
        inspect,
    )

_number = _library.tspace_version()
__version__ = f"{_number // 10000}.{_number // 100 % 100}.{_number % 100}"

__all__ = [
    "BakeReport",
    "CheckReport",
    "CompressMapReport",
    "Convention",
    "DiffReport",
    "Error",
    "FileError",
    "Finding",
    "FinishReport",
    "FlipGreenReport",
    "ConvertMapReport",
    "HeightToNormalReport",
    "GenerateReport",
    "Generated",
    "IdentifyReport",
    "IndexRangeError",
    "IndexedFrames",
    "IndexedFramesReport",
    "InputError",
    "InspectReport",
    "MeshJob",
    "NormalReport",
    "NormalResult",
    "PackReport",
    "PackResult",
    "Plan",
    "PlanBuffers",
    "PositionNoise",
    "ReadWriteError",
    "Report",
    "SanitizeReport",
    "SanitizeResult",
    "Split",
    "TangentReport",
    "TangentResult",
    "Triangles",
    "UnknownOptionError",
    "WindingReport",
    "WindingResult",
    "bake_file",
    "check",
    "compress_map_bytes",
    "compress_map_file",
    "diff",
    "finish_file",
    "flip_green_bytes",
    "flip_green_file",
    "generate_bytes",
    "generate_file",
    "convert_map_file",
    "height_to_normal_file",
    "identify",
    "inspect",
    "make_indexed_frames",
    "mend_winding",
    "normals",
    "pack_frames",
    "plan_buffers",
    "position_noise",
    "remedy_text",
    "sanitize",
    "split",
    "tangents",
    "tangents_of_meshes",
    "triangulate",
    "unpack_frames",
]
