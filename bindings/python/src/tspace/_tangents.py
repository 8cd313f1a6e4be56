# SPDX-License-Identifier: MIT
"""Tangents per corner, computed in one call or with a plan."""

import ctypes
import functools
import weakref
from ctypes import byref
from typing import Any, Iterable, List, Literal, NamedTuple, Optional, Tuple, Union, overload

import numpy

from . import _abi
from ._arrays import EMPTY_SPAN, check_apart, float_array, output_array, read_span, report, write_span
from ._errors import InputError, raise_error
from ._mesh import Mesh
from ._options import ConventionLike, convention_struct, execution, named, real, small_number
from ._reports import TangentReport
from ._types import (
    AttributeIndices,
    BoolArray,
    OutputDomainName,
    FaceSizes,
    FloatArray,
    FrameShapeName,
    MethodName,
    NgonsName,
    Numbers,
    PairingName,
    Rows,
    Threads,
)

_library = _abi.library
_OUTPUT_SIZE = ctypes.sizeof(_abi.TangentOutput)
_METHOD_NAMES = {number: name for name, number in _abi.METHODS.items()}


class TangentResult(NamedTuple):
    """All outputs of a method, one entry per corner (or per vertex for domain="vertex")."""

    tangents: FloatArray  #: (n, 4) float32: unit tangent and sign
    bitangents: FloatArray  #: (n, 3) float32: unit direction of dP/dv; in general different from cross(N, T)
    magnitudes_s: FloatArray  #: (n,) float32: mean length of dP/du; 1 for methods that do not compute it
    magnitudes_t: FloatArray  #: (n,) float32: mean length of dP/dv; 1 for methods that do not compute it
    #: (n,) bool: False if no face contributes to the entry: the method's default was written, or the row is zero
    #: (corners of skipped faces, unused vertices)
    has_tangent: BoolArray
    report: TangentReport


def tangent_options(*values: Any) -> _abi.TangentOptions:
    """Returns the struct of the C API for the arguments of `_tangent_options`. It is shared, so it must not be modified."""
    try:
        hash(values)
    except TypeError:  # wrong types; the function below reports them
        return _tangent_options.__wrapped__(*values)
    return _tangent_options(*values)


@functools.lru_cache(maxsize=64, typed=True)
def _tangent_options(
    method: Any,
    convention: Any,
    threshold: Any,
    pairing: Any,
    ngons: Any,
    domain: Any,
    frame: Any,
    refine: Any,
    normalize_normals: Any,
) -> _abi.TangentOptions:
    degrees, steps = real("threshold", threshold), small_number("refine", refine)
    # The C API rejects zero for both as uninitialized; no method uses both.
    if degrees == 0 and steps == 0:
        degrees, steps = (180.0, 0) if method == "best" else (0.0, 1)
    return _abi.TangentOptions(
        ctypes.sizeof(_abi.TangentOptions),
        named("method", method, _abi.METHODS),
        convention_struct(convention),
        named("ngons", ngons, _abi.NGONS),
        named("domain", domain, _abi.OUTPUT_DOMAINS),
        named("frame", frame, _abi.FRAME_SHAPES),
        degrees,
        named("pairing", pairing, _abi.PAIRINGS),
        steps,
        bool(normalize_normals),
    )


def _output(
    count: int, out: Optional[numpy.ndarray], full: bool
) -> Tuple[_abi.TangentOutput, Tuple[numpy.ndarray, ...]]:
    """Returns the struct and the arrays that it refers to: tangents only, or all five."""
    tangents = output_array(out, count, 4)
    if not full:
        spans = (write_span(tangents), EMPTY_SPAN, EMPTY_SPAN, EMPTY_SPAN, EMPTY_SPAN)
        return _abi.TangentOutput(_OUTPUT_SIZE, 0, *spans), (tangents,)
    arrays = (
        tangents,
        output_array(None, count, 3),
        output_array(None, count, 0),
        output_array(None, count, 0),
        numpy.empty(count, numpy.bool_),  # the library writes bytes with 0 or 1
    )
    return _abi.TangentOutput(_OUTPUT_SIZE, 0, *(write_span(array) for array in arrays)), arrays


def _new_report() -> _abi.TangentReport:
    return _abi.TangentReport(ctypes.sizeof(_abi.TangentReport))


def _full(arrays: Tuple[numpy.ndarray, ...], counts: _abi.TangentReport) -> TangentResult:
    tangents, bitangents, magnitudes_s, magnitudes_t, has_tangent = arrays
    return TangentResult(tangents, bitangents, magnitudes_s, magnitudes_t, has_tangent, report(TangentReport, counts))


def tangents(
    positions: Rows,
    normals: Rows,
    uvs: Optional[Rows],
    indices: Optional[Numbers] = None,
    *,
    face_sizes: FaceSizes = None,
    normal_indices: AttributeIndices = None,
    uv_indices: AttributeIndices = None,
    method: MethodName = "mikktspace",
    convention: ConventionLike,
    threshold: float = 180.0,
    pairing: PairingName = "reference",
    ngons: NgonsName = "triangulate",
    domain: OutputDomainName = "corner",
    frame: FrameShapeName = "gram_schmidt",
    refine: int = 1,
    normalize_normals: bool = False,
    threads: Threads = 1,
    out: Optional[numpy.ndarray] = None,
    full: bool = False,
) -> Union[FloatArray, TangentResult]:
    """Computes one tangent per corner, with its sign: (corners, 4) float32.

    The first three numbers of a row are the unit tangent T, the fourth is the sign (+1 or -1): B = sign * cross(N, T). One
    vertex can need several tangents, so never write rows through the old index list: `make_indexed_frames` or `split`
    create a new one.

    positions:  (vertices, 3)
    normals:    (vertices, 3), unit; used as given (see normalize_normals). `tspace.normals` computes them
    uvs:        (vertices, 2); None for method="basis", which needs no UVs
    indices:    (corners,), the vertex of each corner, also as a column (corners, 1), or (faces, k) for faces of k corners;
                None: corner c is vertex c
    face_sizes: None: triangles. A number: corners of every face. (faces,): corners of each face
    normal_indices, uv_indices: None: normals and uvs have one row per vertex. A separate index list, shaped like `indices` or
                (corners,): any number of rows. "corners": one row per corner
    method:     "mikktspace" (bit-identical to the MikkTSpace reference), "fast", "best", "lengyel", "uniform", "angle", "area",
                "flat", or "basis"
    convention: determines the sign, so it has no default: "gltf", "opengl", "directx", "unreal", "unity", "blender", "godot",
                or a tspace.Convention
    threshold:  degrees, default 180 as in the reference; mikktspace only: tangents that differ by this or more are not
                averaged
    pairing:    mikktspace only: "reference", or "corrected" without the reference's defect in its last bucket of edges
    ngons:      faces with more than 4 corners: "triangulate", or "skip": their rows are zero, as in the reference
    domain:     "corner"; or "vertex", for "lengyel" and "basis" only: one row per vertex
    frame:      "gram_schmidt"; or "symmetric": T is the bisector of dP/du and the direction across dP/dv
    refine:     refinement steps of "best": 0, 1 or 2
    normalize_normals: True: normals whose length differs from 1 by more than 0.00674 are normalized first; False: they are
                used as given, and tangents are then not perpendicular to them, as in the reference
    threads:    number of threads, or "all". The results have the same bits for any number
    out:        float32 array that receives the result and is returned; may be a field of interleaved vertices
    full:       True: returns a TangentResult, which also includes bitangents, magnitudes, a report, and a mask of the rows
                to which a face contributes

    Invalid geometry (NaN, faces without area) raises no error: it is counted in the report, and `sanitize` repairs the
    result. Raises TypeError, InputError (a ValueError) with the invalid argument and position, or MemoryError.
    """
    options = tangent_options(
        method, convention, threshold, pairing, ngons, domain, frame, refine, normalize_normals
    )
    run = execution(threads)
    mesh = Mesh(positions, normals, uvs, indices, face_sizes, normal_indices, uv_indices)
    count = mesh.corner_count if options.domain == 0 else mesh.vertex_count
    output, arrays = _output(count, out, full)
    check_apart(out, mesh.arrays)
    error = _abi.Error()
    if not full:
        if _library.tspace_generateTangents(
            byref(mesh.struct), byref(options), byref(output), byref(run), None, byref(error)
        ):
            mesh.fail(error)
        return arrays[0]
    counts = _new_report()
    if _library.tspace_generateTangents(
        byref(mesh.struct), byref(options), byref(output), byref(run), byref(counts), byref(error)
    ):
        mesh.fail(error)
    return _full(arrays, counts)


class MeshJob:
    """One mesh for `tangents_of_meshes`. Takes the arguments of `tangents`, except `threads`, and keeps the arrays alive.

    Raises the same errors as `tangents` for invalid types, shapes and options.
    """

    def __init__(
        self,
        positions: Rows,
        normals: Rows,
        uvs: Optional[Rows],
        indices: Optional[Numbers] = None,
        *,
        face_sizes: FaceSizes = None,
        normal_indices: AttributeIndices = None,
        uv_indices: AttributeIndices = None,
        method: MethodName = "mikktspace",
        convention: ConventionLike,
        threshold: float = 180.0,
        pairing: PairingName = "reference",
        ngons: NgonsName = "triangulate",
        domain: OutputDomainName = "corner",
        frame: FrameShapeName = "gram_schmidt",
        refine: int = 1,
        normalize_normals: bool = False,
        out: Optional[numpy.ndarray] = None,
        full: bool = False,
    ):
        """Checks the arguments without computing anything."""
        self._options = tangent_options(
            method, convention, threshold, pairing, ngons, domain, frame, refine, normalize_normals
        )
        self._mesh = Mesh(positions, normals, uvs, indices, face_sizes, normal_indices, uv_indices)
        count = self._mesh.corner_count if self._options.domain == 0 else self._mesh.vertex_count
        _output(count, out, full)
        check_apart(out, self._mesh.arrays)
        self._outputs = (count, out, full)

    def _result(
        self, arrays: Tuple[numpy.ndarray, ...], counts: _abi.TangentReport, error: _abi.Error
    ) -> Union[FloatArray, TangentResult, InputError, MemoryError]:
        if error.code:
            try:
                self._mesh.fail(error)
            except (InputError, MemoryError) as failure:
                return failure
        return _full(arrays, counts) if len(arrays) > 1 else arrays[0]


def tangents_of_meshes(
    jobs: Iterable[MeshJob], *, threads: Threads = 1
) -> List[Union[FloatArray, TangentResult, InputError, MemoryError]]:
    """Computes the tangents of many meshes in one call, in parallel by mesh. Use it for models with many small meshes.

    Returns one entry per job, in order: the result of `tangents` for this mesh, with the same bits; or the exception
    (InputError or MemoryError) that `tangents` would raise. A failed job does not affect the others. Outputs of different
    jobs must not overlap.

    jobs:    a MeshJob per mesh, any number
    threads: number of threads, or "all"

    >>> job = tspace.MeshJob(positions, normals, uvs, indices, convention="gltf")
    >>> results = tspace.tangents_of_meshes([job, job], threads="all")
    >>> bool((results[0] == tangents).all())
    True
    """
    jobs = list(jobs)
    for job in jobs:
        if not isinstance(job, MeshJob):
            raise TypeError(f"jobs must contain only tspace.MeshJob, not {type(job).__name__}")
    run = execution(threads)
    outputs = [_output(*job._outputs) for job in jobs]
    counts = [_new_report() for _ in jobs]
    errors = [_abi.Error() for _ in jobs]
    structs = (_abi.MeshJob * len(jobs))()
    for struct, job, (output, _), count, job_error in zip(structs, jobs, outputs, counts, errors):
        struct.mesh, struct.options = ctypes.pointer(job._mesh.struct), ctypes.pointer(job._options)
        struct.out, struct.report, struct.error = (ctypes.pointer(item) for item in (output, count, job_error))
    error = _abi.Error()
    failed = _library.tspace_generateTangentsOfMeshes(structs, len(jobs), byref(run), byref(error))
    if failed and not any(job_error.code for job_error in errors):
        raise_error(error)
    return [
        job._result(arrays, count, job_error)
        for job, (_, arrays), count, job_error in zip(jobs, outputs, counts, errors)
    ]


class Plan:
    """Data of a mesh that does not change while it deforms: adjacency, groups, splits, UVs.

    Takes the arguments of `tangents`. `evaluate` then computes the tangents of a pose in a fraction of the time.
    Immutable, so that many threads may evaluate one plan concurrently; keeps no array alive.

    >>> plan = tspace.Plan(positions, normals, uvs, indices, convention="gltf")
    >>> tangents = plan.evaluate(posed_positions, posed_normals)
    """

    def __init__(
        self,
        positions: Rows,
        normals: Rows,
        uvs: Optional[Rows],
        indices: Optional[Numbers] = None,
        *,
        face_sizes: FaceSizes = None,
        normal_indices: AttributeIndices = None,
        uv_indices: AttributeIndices = None,
        method: MethodName = "mikktspace",
        convention: ConventionLike,
        threshold: float = 180.0,
        pairing: PairingName = "reference",
        ngons: NgonsName = "triangulate",
        domain: OutputDomainName = "corner",
        frame: FrameShapeName = "gram_schmidt",
        refine: int = 1,
        normalize_normals: bool = False,
        threads: Threads = 1,
    ):
        """Creates a plan; the arguments are those of `tangents`."""
        options = tangent_options(
            method, convention, threshold, pairing, ngons, domain, frame, refine, normalize_normals
        )
        mesh = Mesh(positions, normals, uvs, indices, face_sizes, normal_indices, uv_indices)
        plan = ctypes.c_void_p()
        error = _abi.Error()
        if _library.tspace_planTangents(
            byref(mesh.struct), byref(options), byref(execution(threads)), byref(plan), byref(error)
        ):
            mesh.fail(error)
        weakref.finalize(self, _library.tspace_destroyTangentPlan, plan)
        info = _abi.TangentPlanInfo(ctypes.sizeof(_abi.TangentPlanInfo))
        if _library.tspace_describeTangentPlan(plan, byref(info), byref(error)):
            raise_error(error)
        self._plan = plan
        self._info = info
        self._normal_count = mesh.struct.normals.count

    @overload
    def evaluate(
        self,
        positions: Rows,
        normals: Rows,
        *,
        threads: Threads = ...,
        out: Optional[numpy.ndarray] = ...,
        full: Literal[False] = ...,
    ) -> FloatArray:
        ...

    @overload
    def evaluate(
        self,
        positions: Rows,
        normals: Rows,
        *,
        threads: Threads = ...,
        out: Optional[numpy.ndarray] = ...,
        full: Literal[True],
    ) -> TangentResult:
        ...

    def evaluate(
        self,
        positions: Rows,
        normals: Rows,
        *,
        threads: Threads = 1,
        out: Optional[numpy.ndarray] = None,
        full: bool = False,
    ) -> Union[FloatArray, TangentResult]:
        """Computes the tangents of a pose with the plan's groups and splits: (corners, 4) float32.

        For the pose from which the plan was created, the result equals that of `tangents` bit for bit.

        positions: (vertices, 3), as many as in the plan
        normals:   unit normals of this pose, as many as in the plan
        threads, out, full: see `tangents`
        """
        positions = float_array("positions", positions, 3)
        normals = float_array("normals", normals, 3)
        counts = self._info.vertex_count, self._normal_count
        for name, array, count in zip(("positions", "normals"), (positions, normals), counts):
            if len(array) != count:
                raise InputError(f"{name} has {len(array)} entries, but the mesh of the plan has {count}", "planMismatch")
        positions_span, positions = read_span("positions", positions)
        normals_span, normals = read_span("normals", normals)
        pose = _abi.Pose(ctypes.sizeof(_abi.Pose), 0, positions_span, normals_span)
        output, arrays = _output(self._info.output_count, out, full)
        check_apart(out, (positions, normals))
        met = _new_report() if full else None
        error = _abi.Error()
        if _library.tspace_evaluateTangents(
            self._plan,
            byref(pose),
            byref(output),
            byref(execution(threads)),
            byref(met) if met is not None else None,
            byref(error),
        ):
            raise_error(error)
        return arrays[0] if met is None else _full(arrays, met)

    @property
    def method(self) -> str:
        """Name of the method."""
        return _METHOD_NAMES[self._info.method]

    @property
    def vertex_count(self) -> int:
        """Number of vertices of the mesh."""
        return self._info.vertex_count

    @property
    def corner_count(self) -> int:
        """Number of corners of the mesh."""
        return self._info.corner_count

    @property
    def memory_bytes(self) -> int:
        """Memory of the plan in bytes."""
        return self._info.memory_bytes

    def __reduce__(self) -> Any:
        raise TypeError("a Plan cannot be copied or pickled; create another one from the mesh")

    def __repr__(self) -> str:
        return f"<tspace.Plan: {self.method}, {self.vertex_count} vertices, {self.corner_count} corners>"
