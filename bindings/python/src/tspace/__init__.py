# SPDX-License-Identifier: MIT
"""Normals and tangent frames for meshes: T, B, N and the sign that normal maps need.

A *corner* is a pair of a face and one of its vertices; corners are numbered face by face. A *vertex* is one entry of the
arrays. One vertex can need several tangents (at UV seams, and where the UV map is mirrored), so results are per corner.
The *sign* is the fourth number of a tangent: B = sign * cross(N, T). Its meaning depends on the format, so every call
needs a *convention*.

An indexed mesh with tangents, in one call:

>>> import numpy, tspace
>>> positions = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], numpy.float32)
>>> uvs = numpy.array([[0, 1], [1, 1], [1, 0], [0, 0]], numpy.float32)
>>> indices = numpy.array([[0, 1, 2], [0, 2, 3]], numpy.uint32)
>>> mesh = tspace.make_indexed_frames(positions, None, uvs, indices, convention="gltf")
>>> mesh.indices.tolist(), mesh.normals[0].tolist(), mesh.tangents[0].tolist()
([0, 1, 2, 0, 2, 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0])
>>> new_positions, new_uvs = positions[mesh.source_vertices], uvs[mesh.source_vertices]

The same in separate steps: compute tangents per corner, repair them, then split vertices:

>>> normals = numpy.broadcast_to(numpy.float32([0, 0, 1]), positions.shape)
>>> tangents = tspace.tangents(positions, normals, uvs, indices, convention="gltf")
>>> tangents.shape
(6, 4)
>>> repaired = tspace.sanitize(tangents, positions, normals, indices)
>>> mesh = tspace.split(indices, len(positions), [repaired])
>>> positions[mesh.source_vertices].shape, repaired[mesh.source_corners].shape
((4, 3), (4, 4))

A mesh that deforms:

>>> plan = tspace.Plan(positions, normals, uvs, indices, convention="gltf")
>>> bool((plan.evaluate(positions, normals) == tangents).all())
True

Functions
    make_indexed_frames   computes missing normals and tangents, repairs and splits them: an indexed mesh
    tangents        computes one tangent per corner, with nine methods; "mikktspace" is bit-identical to the reference
    tangents_of_meshes   computes tangents of many meshes (MeshJob) in one call
    normals         computes one normal per corner, with crease angles and smoothing groups
    Plan            groups corners once, then computes tangents for every pose
    plan_buffers    exports a plan as arrays for compute shaders
    fix_winding     flips faces with inconsistent winding (former name: mend_winding)
    sanitize        repairs invalid tangents, and keeps all others bit for bit
    split           converts results per corner to an indexed mesh
    triangulate     splits quads and n-gons into triangles
    pack_frames, unpack_frames   N, T and the sign in 4 to 16 bytes

Model files (glTF, GLB, OBJ), on disk or in memory
    generate_file, generate_bytes   adds normals and tangents where materials need them
    check           finds faults in the frames of a model
    remedy_text     describes the remedy of a finding, with calls of this module
    identify        identifies the method that computed a model's tangents
    diff            measures the angles between the frames of two models
    inspect         describes the contents of a file
    flip_green_file, flip_green_bytes   inverts the green channel of a normal map
    convert_map_file                    converts a normal map for other tangents, another space or another program
    height_to_normal_file               converts a height map to a normal map
    compress_map_file, compress_map_bytes   compresses a normal map to a texture for engines
    bake_file       bakes the maps of a low poly from a high poly
    finish_file     repairs a generated or scanned mesh, and bakes maps onto a low poly

Arrays
    Positions and normals have shape (vertices, 3), UVs (vertices, 2), indices (corners,) or (faces, k); lengths may
    have any unit, angles are in degrees. float32 arrays are used without a copy, with any stride, and so are indices of
    type uint8, uint16, uint32 and int32. Other real numbers (float64, float16, integers, lists) are converted to a new
    float32 array, other integers to uint32; so are layouts such as reversed or broadcast arrays. Numbers out of range, and
    all other types (complex, bool, text), raise an error.

Errors
    TypeError for arguments that are not arrays of numbers, InputError (a ValueError) for invalid shapes and options,
    IndexRangeError (also an IndexError) for indices; messages contain the argument and the position. FileError for corrupt
    models, ReadWriteError (an OSError) for files that cannot be read or written. An unknown option raises a TypeError that
    lists the valid ones (UnknownOptionError, for models). Invalid geometry raises no error: it is counted in the reports
    that `full=True` returns.

Threads
    The interpreter lock is released during each call. Do not write to arrays while a call of another thread reads them. A
    call uses one thread unless `threads` is larger; results have the same bits for any number of threads.
"""

from ._abi import library as _library
from ._array_calls import normals, pack_frames, sanitize, tangents
from ._errors import Error, FileError, IndexRangeError, InputError, ReadWriteError, UnknownOptionError
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
from ._normals import NormalResult, position_noise
from ._options import Convention
from ._pack import PackResult, unpack_frames
from ._plan_buffers import PlanBuffers, plan_buffers
from ._reports import NormalReport, PackReport, PositionNoise, SanitizeReport, TangentReport, WindingReport
from ._remedies import remedy_text
from ._sanitize import SanitizeResult
from ._split import Split, Triangles, split, triangulate
from ._tangents import MeshJob, Plan, TangentResult, tangents_of_meshes
from ._winding import WindingResult, fix_winding, mend_winding

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
    "fix_winding",
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
