# SPDX-License-Identifier: MIT
"""A plan as arrays for compute shaders."""

import ctypes
from ctypes import POINTER, byref, pointer
from inspect import signature
from typing import Any, Dict, Optional

import numpy

from . import _abi
from ._arrays import UINT32, copied, uint32_array
from ._errors import raise_error
from ._mesh import Mesh
from ._normals import normal_options
from ._normals import normals as make_normals
from ._options import execution
from ._tangents import Plan
from ._types import Numbers, Threads


class PlanBuffers:
    """Buffers of a plan for `shaders/tspace_evaluate.*`: upload `words`, and dispatch a thread per result.

    The other arrays are views of `words`. docs/guides/gpu.md describes them.
    """

    words: numpy.ndarray  #: (n,) uint32: a header of 12 words, then results, entries and triangles
    results: numpy.ndarray  #: (results, 3) uint32: first entry, count of entries with flags, own corner
    entries: numpy.ndarray  #: (n,) uint32: corners of triangles in the order of summation, with flags
    triangles: numpy.ndarray  #: (triangles, 5) uint32: three vertices, and UV coefficients as bits of float32; lengyel: 7

    def __init__(self, words: numpy.ndarray):
        """Wraps words returned by `plan_buffers`, for example after they were stored in a file."""
        if not isinstance(words, numpy.ndarray) or words.dtype != UINT32 or words.ndim != 1 or len(words) < 12:
            raise TypeError("words must be an array of uint32 that plan_buffers returned")
        results, entries, triangles, width = (int(words[i]) for i in (4, 5, 6, 7))
        first_result, first_entry, first_triangle = (int(words[i]) for i in (8, 9, 10))
        self.words = words
        self.results = words[first_result : first_result + 3 * results].reshape(results, 3)
        self.entries = words[first_entry : first_entry + entries]
        self.triangles = words[first_triangle : first_triangle + width * triangles].reshape(triangles, width)

    @property
    def makes_normals(self) -> bool:
        """True if the shader computes normals from positions."""
        return bool(self.words[2] & 1)

    def __repr__(self) -> str:
        return f"<tspace.PlanBuffers: {len(self.results)} results, {len(self.triangles)} triangles>"


def _mesh(given: Dict[str, Any]) -> Mesh:
    known = ("positions", "normals", "uvs", "indices", "face_sizes", "normal_indices", "uv_indices")
    _check_names("mesh", given, known)
    return Mesh(*(given.get(name) for name in known))


def _check_names(argument: str, given: Any, known: Any) -> None:
    if not isinstance(given, dict):
        raise TypeError(f"{argument} must be a dict, not {type(given).__name__}")
    for name in given:
        if name not in known:
            raise TypeError(f"{argument}[{name!r}] is not a known option; known options are {', '.join(known)}")


# Options of tspace.normals that describe the normals, and their defaults.
_NORMAL_DEFAULTS = {
    name: parameter.default
    for name, parameter in signature(make_normals).parameters.items()
    if name == "smoothing_groups" or name in signature(normal_options).parameters
}


def plan_buffers(
    plan: Plan,
    *,
    indices: Optional[Numbers] = None,
    source_corners: Optional[Numbers] = None,
    mesh: Optional[Dict[str, Any]] = None,
    normals: Optional[Dict[str, Any]] = None,
    threads: Threads = 1,
) -> PlanBuffers:
    """Exports a plan as arrays, with which a compute shader evaluates each pose on a GPU.

    plan:           a tspace.Plan: mikktspace, uniform, angle, area, lengyel or fast
    indices:        vertex of each corner in the arrays of a pose, such as `make_indexed_frames(...).indices`; None: those
                    of the plan's mesh
    source_corners: corner of each result, such as `make_indexed_frames(...).source_corners`; None: one result per corner
    mesh:           the plan's mesh as a dict of arguments of Plan (positions, indices, face_sizes): the shader then also
                    computes normals. None: normals are an input of each pose
    normals:        dict of options of `tspace.normals`, for `mesh`: any weighting except "best"
    threads:        number of threads, or "all". The results have the same bits for any number

    >>> buffers = tspace.plan_buffers(plan, mesh=dict(positions=positions, indices=indices))
    >>> len(buffers.results), buffers.triangles.shape, buffers.makes_normals
    (6, (2, 5), True)
    """
    if not isinstance(plan, Plan):
        raise TypeError(f"plan must be a tspace.Plan, not {type(plan).__name__}")
    lists = [
        None if array is None else uint32_array(name, array)
        for name, array in (("indices", indices), ("source_corners", source_corners))
    ]
    options = _abi.PlanBufferOptions(ctypes.sizeof(_abi.PlanBufferOptions))
    options.indices, options.index_count = _address(lists[0])
    options.source_corners, options.source_corner_count = _address(lists[1])
    shape = groups = None
    if mesh is not None:
        shape = _mesh(mesh)
        options.mesh = pointer(shape.struct)
    if normals is not None:
        _check_names("normals", normals, _NORMAL_DEFAULTS)
        given = {**_NORMAL_DEFAULTS, **normals}
        groups = given.pop("smoothing_groups")
        groups = None if groups is None else uint32_array("smoothing_groups", groups)
        options.normals = pointer(normal_options(groups=groups, **given))
    result = POINTER(_abi.PlanBuffers)()
    error = _abi.Error()
    if _abi.library.tspace_planBuffers(plan._plan, byref(options), byref(execution(threads)), byref(result), byref(error)):
        shape.fail(error) if shape is not None else raise_error(error)
    try:
        made = result.contents
        return PlanBuffers(copied(made.words, (made.word_count,), UINT32))
    finally:
        _abi.library.tspace_destroyPlanBuffers(result)


def _address(array: Optional[numpy.ndarray]) -> Any:
    return (None, 0) if array is None else (array.ctypes.data, array.size)
