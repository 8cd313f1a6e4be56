# SPDX-License-Identifier: MIT
"""Functions for model files and normal maps: generate, check, identify, diff, inspect, finish etc. Each calls one C API
function."""

import ctypes
import json
import os
import re
from ctypes import byref
from typing import Any, Callable, Dict, Generic, List, Mapping, Optional, TypeVar, Union

import numpy

from . import _abi, _file_reports, _files_abi
from ._errors import InputError, UnknownOptionError, raise_error, shown
from ._file_options import OPTIONS
from ._file_reports import (
    BakeReport,
    CheckReport,
    DiffReport,
    FinishReport,
    Finding,
    InspectReport,
)
from ._generate_report import GenerateReport
from ._map_reports import CompressMapReport, ConvertMapReport, FlipGreenReport, HeightToNormalReport
from ._report import Report

PathLike = Union[str, "os.PathLike[str]"]
BytesLike = Union[bytes, bytearray, memoryview]
AnyReport = TypeVar("AnyReport", bound=Report)
FindFile = Union[Callable[[str], Optional[bytes]], Mapping[str, bytes]]

_INTERNAL, _INVALID_FILE, _CANNOT_READ = 11, 100, 103
_OBJ_LINE = re.compile(rb"(?m)^(v|vn|vt|f|usemtl) +[-0-9.\w]")
_NAME_IT = b'. An OBJ is told by its name: name="model.obj"'


class IdentifyReport(_file_reports.IdentifyReport):
    """Report of `identify`."""

    @property
    def method(self) -> Optional[str]:
        """Name of the method that explains the tangents best; None if there are no tangents."""
        return self.explanations[0].method if self.explanations else None


class Generated(bytes, Generic[AnyReport]):
    """A file in memory: bytes with a report."""

    report: AnyReport

    @classmethod
    def of(cls, content: bytes, report: AnyReport) -> "Generated[AnyReport]":
        """Creates the bytes of a file with its report."""
        made: "Generated[AnyReport]" = cls(content)
        made.report = report
        return made


class _Call:
    """One C API call: keeps its arguments alive, and converts its results."""

    def __init__(self) -> None:
        self.library = _files_abi.library()
        self.keep: List[Any] = []
        self.raised: Optional[BaseException] = None
        self.looks_like_obj = False
        self.paths: List[bytes] = []
        self.outputs: List[bytes] = []

    def path(self, name: str, value: Any) -> bytes:
        try:
            path = os.fsencode(value)
        except TypeError:
            raise TypeError(f"{name} must be a path, not {type(value).__name__}") from None
        if b"\0" in path:
            raise InputError(f"{name} must not contain a null character")
        (self.outputs if name == "output" else self.paths).append(path)
        return path

    def buffer(self, name: str, value: Any) -> numpy.ndarray:
        """Returns a view of the bytes without a copy; a bytearray cannot be resized while it exists."""
        try:
            view = numpy.frombuffer(value, numpy.uint8)
        except (TypeError, ValueError, AttributeError, BufferError) as error:
            # numpy cannot create an array over an empty buffer.
            if isinstance(value, (bytes, bytearray, memoryview)) and len(value) == 0:
                return numpy.empty(0, numpy.uint8)
            raise TypeError(f"{name} must be bytes, not {type(value).__name__}: {error}") from None
        self.keep.append(view)
        return view

    def model(self, name: str, value: Any, file_name: Optional[str], find_file: Optional[FindFile]) -> _abi.Model:
        data = self.buffer(name, value)
        if file_name is not None and (not isinstance(file_name, str) or "\0" in file_name):
            raise TypeError(f"name must be text, not {shown(file_name)}")
        encoded = None if file_name is None else os.fsencode(file_name)
        if not (file_name or "").lower().endswith(".obj") and _OBJ_LINE.search(data[:65536].tobytes()):
            self.looks_like_obj = True
        callback = _abi.FindFile(0) if find_file is None else self.callback(find_file)
        self.keep += [encoded, callback]
        return _abi.Model(
            ctypes.sizeof(_abi.Model), 0, data.ctypes.data, data.size, encoded, callback, None
        )

    def hint(self, code: int) -> bytes:
        """Returns a hint for bytes that are not glTF but look like an OBJ, which is recognized by its name only."""
        return _NAME_IT if code == _INVALID_FILE and self.looks_like_obj else b""

    def callback(self, find_file: FindFile) -> Any:
        """Returns the C callback that calls `find_file`. An exception that it raises is raised again after the call."""
        find = find_file.get if isinstance(find_file, Mapping) else find_file
        if not callable(find):
            raise TypeError(f"find_file must be a function or a dict, not {type(find_file).__name__}")

        def found(_: Any, path: bytes, data: Any, size: Any) -> int:
            try:
                content = find(os.fsdecode(path))
                if content is None:
                    return _CANNOT_READ
                view = self.buffer(f"the result of find_file({os.fsdecode(path)!r})", content)
            except (FileNotFoundError, KeyError):
                return _CANNOT_READ
            except BaseException as error:  # pylint: disable=broad-except
                self.raised = error
                return _INTERNAL
            data[0], size[0] = view.ctypes.data, view.size
            return 0

        return _abi.FindFile(found)

    def run(self, function: str, *arguments: Any, options: Mapping[str, Any], has_output: bool = False) -> Any:
        """Runs a function; returns the report as a dict, and the output if there is one."""
        _check_names(function, options)
        text = json.dumps({name.rstrip("_").replace("_", "-"): value for name, value in options.items()}, default=_plain)
        backs = [_abi.Bytes() for _ in range(2 if has_output else 1)]
        error = _abi.Error()
        failed = getattr(self.library, function)(*arguments, text.encode(), *map(byref, backs), byref(error))
        try:
            if self.raised is not None:
                raise self.raised
            if failed:
                error.message = (error.message + self.hint(error.code))[:239]
                raise_error(error, self.paths, self.outputs)
            values = [ctypes.string_at(back.data, back.size) if back.size else b"" for back in backs]
        finally:
            for back in backs:
                self.library.tspace_destroyBytes(byref(back))
            self.keep.clear()  # the callback refers to this object: without clear(), buffers would stay locked
        document = json.loads(values[-1])
        return (values[0], document) if has_output else document


def _check_names(function: str, options: Mapping[str, Any]) -> None:
    verb = re.sub("^tspace_|(File|Bytes)s?$", "", function)
    known = OPTIONS[verb]
    for name in options:
        if name not in known:
            raise UnknownOptionError(f"unknown option {name!r}; known options are {', '.join(known)}", "invalidOption")


def _plain(value: Any) -> Any:
    if isinstance(value, numpy.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"the values of options must be numbers, text, True or False, not {type(value).__name__}")


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, os.PathLike))


def _ask(
    verb: str, model: Any, name: Optional[str], find_file: Optional[FindFile], options: Mapping[str, Any]
) -> Dict[str, Any]:
    """Calls a report function for one model, given as path or bytes."""
    call = _Call()
    if _is_path(model):
        if find_file is not None or name is not None:
            raise TypeError("name and find_file can only be used with a model in memory")
        document = call.run(f"tspace_{verb}File", call.path("model", model), options=options)
    else:
        struct = call.model("model", model, name, find_file)
        document = call.run(f"tspace_{verb}Bytes", byref(struct), options=options)
    return _of_file(document)


def _of_file(document: Dict[str, Any]) -> Dict[str, Any]:
    """Returns the entry of the only file, with the exit code of the run."""
    return {**document["files"][0], "exitCode": document["exitCode"]}


def generate_file(input: PathLike, output: PathLike, **options: Any) -> GenerateReport:
    """Adds normals and tangents to a model where its materials need them, and writes a .glb or .gltf.

    input:   path of a GLB, glTF or OBJ
    output:  path of the result; may equal the input. It is written atomically
    options: options of `tspace generate` (docs/reference/tool.md), with underscores: method="best", crease=60, all=True,
             overwrite=True, only_missing=True, repair=True, no_sanitize=True, dry_run=True, pack="frame32", threads=4
             (default: 1)

    Everything else in the file is preserved. Returns a report per primitive (docs/reference/json.md). Raises FileError for a
    corrupt model; ReadWriteError (an OSError) if a file cannot be read or written; InputError for invalid options.
    """
    call = _Call()
    paths = call.path("input", input), call.path("output", output)
    return GenerateReport(_of_file(call.run("tspace_generateFile", *paths, options=options)))


def generate_bytes(
    data: BytesLike, *, name: Optional[str] = None, find_file: Optional[FindFile] = None, **options: Any
) -> Generated[GenerateReport]:
    """Like `generate_file`, in memory: takes the bytes of a model, and returns the bytes of a GLB with all data embedded.

    The result is a `bytes` object with the attribute `report`.

    data:      bytes of a GLB, glTF or OBJ
    name:      name in reports; an OBJ is recognized by its extension: name="chair.obj"
    find_file: provides files that the model references: a dict from path to bytes, or a function that maps a path to
               bytes or None. Paths are relative to the model; paths that leave its folder are never requested
    options:   see `generate_file`
    """
    call = _Call()
    struct = call.model("data", data, name, find_file)
    output, document = call.run("tspace_generateBytes", byref(struct), options=options, has_output=True)
    return Generated.of(output, GenerateReport(_of_file(document)))


def check(
    model: Union[PathLike, BytesLike],
    *,
    name: Optional[str] = None,
    find_file: Optional[FindFile] = None,
    **options: Any,
) -> CheckReport:
    """Finds errors in the frames of a model: inverted signs, averaged seams, a wrong UV set, and more.

    model:     a path, or bytes of a GLB, glTF or OBJ
    name, find_file: for bytes, see `generate_bytes`
    options:   options of `tspace check` (docs/reference/check.md), with underscores: fail_on="error",
               ignore=["tangentsUnused"]

    >>> for finding in tspace.check("chair.glb"):
    ...     print(finding.severity, finding.code, finding.place, finding.message, tspace.remedy_text(finding))
    """
    return CheckReport(_ask("check", model, name, find_file, options))


def identify(
    model: Union[PathLike, BytesLike],
    *,
    name: Optional[str] = None,
    find_file: Optional[FindFile] = None,
    **options: Any,
) -> IdentifyReport:
    """Identifies the method and convention that computed the tangents of a model.

    model:     a path, or bytes of a GLB, glTF or OBJ
    name, find_file: for bytes, see `generate_bytes`
    options:   options of `tspace identify` (docs/reference/identify.md), with underscores

    `verdict` is one or two sentences; `method` is the best matching method, `explanations` lists all methods.
    """
    return IdentifyReport(_ask("identify", model, name, find_file, options))


def inspect(
    model: Union[PathLike, BytesLike],
    *,
    name: Optional[str] = None,
    find_file: Optional[FindFile] = None,
    **options: Any,
) -> InspectReport:
    """Describes the contents of a model: meshes, attributes, materials that need tangents.

    model:     a path, or bytes of a GLB, glTF or OBJ
    name, find_file: for bytes, see `generate_bytes`
    options:   options of `tspace inspect`, with underscores
    """
    return InspectReport(_ask("inspect", model, name, find_file, options))


def diff(
    a: Union[PathLike, BytesLike],
    b: Union[PathLike, BytesLike],
    *,
    find_file: Optional[FindFile] = None,
    **options: Any,
) -> DiffReport:
    """Compares the tangent frames of two models of the same surface.

    a, b:      two paths, or bytes of two models (GLB or glTF)
    find_file: for bytes, see `generate_bytes`
    options:   options of `tspace diff` (docs/reference/diff.md), with underscores: tolerance=0.1

    `tangents.max_deg` is the largest angle, `sign_changes` the number of different signs, `is_within_tolerance` the verdict.
    """
    call = _Call()
    if _is_path(a) != _is_path(b):
        raise TypeError("a and b must both be paths or both be bytes")
    if _is_path(a):
        if find_file is not None:
            raise TypeError("find_file can only be used with models in memory")
        return DiffReport(call.run("tspace_diffFiles", call.path("a", a), call.path("b", b), options=options))
    models = call.model("a", a, "a", find_file), call.model("b", b, "b", find_file)
    return DiffReport(call.run("tspace_diffBytes", *map(byref, models), options=options))


def flip_green_file(input: PathLike, output: PathLike, **options: Any) -> FlipGreenReport:
    """Inverts the green channel of a normal map: PNG, JPEG or WebP.

    input, output: paths, which may be equal; the extension of `output` selects its format
    options: options of `tspace flip-green` (docs/guides/flip-green.md), with underscores
    """
    call = _Call()
    paths = call.path("input", input), call.path("output", output)
    return FlipGreenReport(call.run("tspace_flipGreenFile", *paths, options=options))


def convert_map_file(input: PathLike, output: PathLike, **options: Any) -> ConvertMapReport:
    """Converts a normal map for other tangents, another space or another program.

    input:   path of the map: PNG, JPEG, WebP, EXR, KTX2, DDS or TGA
    output:  path of the converted map, .png or .exr
    options: options of `tspace convert-map` (docs/guides/convert-map.md), with underscores:
             mesh="chair.glb", to_mesh="fixed.glb", from_="object", to_convention="directx"
    """
    call = _Call()
    paths = call.path("input", input), call.path("output", output)
    return ConvertMapReport(call.run("tspace_convertMapFile", *paths, options=options))


def height_to_normal_file(input: PathLike, output: PathLike, **options: Any) -> HeightToNormalReport:
    """Converts a height map to a normal map.

    input:   path of the height map: PNG, JPEG, WebP or EXR; white is high
    output:  path of the normal map, .png
    options: options of `tspace height-to-normal` (docs/guides/height-to-normal.md), with underscores:
             strength=0.02, mesh="wall.glb", convention="directx"
    """
    call = _Call()
    paths = call.path("input", input), call.path("output", output)
    return HeightToNormalReport(call.run("tspace_heightToNormalFile", *paths, options=options))


def flip_green_bytes(data: BytesLike, **options: Any) -> Generated[FlipGreenReport]:
    """Like `flip_green_file`, in memory.

    data:    bytes of a PNG, JPEG or WebP; the result has the same format
    options: see `flip_green_file`
    """
    call = _Call()
    view = call.buffer("data", data)
    output, document = call.run("tspace_flipGreenBytes", view.ctypes.data, view.size, options=options, has_output=True)
    return Generated.of(output, FlipGreenReport(document))


def compress_map_file(input: PathLike, output: PathLike, **options: Any) -> CompressMapReport:
    """Compresses a normal map to a texture for engines: BC5, EAC RG11, ASTC or RG8, with all mip levels.

    input:   path of a normal map in tangent space: PNG, JPEG, WebP, EXR, KTX2, DDS or TGA; 16 bits give better results than 8
    output:  path of the texture, .ktx2 or .dds; or a folder for PNGs, with / at its end
    options: options of `tspace compress-map` (docs/guides/compress-map.md), with underscores:
             format="eac-rg11", quality="best", roughness="orm.png", roughness_output="orm.ktx2"

    `mean_error_deg` and `p99_error_deg` of the report are the errors of the filtered texture.
    """
    call = _Call()
    paths = call.path("input", input), call.path("output", output)
    return CompressMapReport(call.run("tspace_compressMapFile", *paths, options=options))


def compress_map_bytes(data: BytesLike, **options: Any) -> Generated[CompressMapReport]:
    """Like `compress_map_file`, in memory: takes the bytes of an image, and returns the bytes of a KTX2.

    data:    bytes of a normal map
    options: see `compress_map_file`, except the roughness options
    """
    call = _Call()
    view = call.buffer("data", data)
    output, document = call.run("tspace_compressMapBytes", view.ctypes.data, view.size, options=options, has_output=True)
    return Generated.of(output, CompressMapReport(document))


def bake_file(low: PathLike, high: PathLike, output: PathLike, **options: Any) -> BakeReport:
    """Bakes the normal map of a low poly from a high poly, and other maps with it.

    low:     path of the model that will use the map; it must have UVs
    high:    path of the model with the detail, at the same position
    output:  path of the normal map, .png; other maps are written next to it
    options: options of `tspace bake` (docs/guides/bake.md), with underscores:
             size=2048, maps=["normal", "ao"], samples=256, convention="unreal", out_mesh="low_with_maps.glb"

    `files` of the report contains the error of each map in degrees. A bake without any hit writes nothing and raises no
    error: `findings` contains the reason, and `exit_code` is 1.
    """
    call = _Call()
    paths = call.path("low", low), call.path("high", high), call.path("output", output)
    return BakeReport(call.run("tspace_bakeFile", *paths, options=options))


def finish_file(input: PathLike, output: PathLike, **options: Any) -> FinishReport:
    """Prepares a generated or scanned mesh for use: winding, normals, tangents, and with a low poly all maps.

    input:   path of a GLB, glTF or OBJ
    output:  path of the result, .glb; must differ from the input
    options: options of `tspace finish` (docs/guides/finish.md), with underscores:
             low="retopo.glb", size=2048, normals="all", html="page.html"

    `check` of the report contains the findings of `tspace.check` in the output, `models[0].before` those in the input, and
    `remarks` lists steps that were not possible.
    """
    call = _Call()
    paths = call.path("input", input), call.path("output", output)
    return FinishReport(_with_exit_codes(call.run("tspace_finishFile", *paths, options=options)))


def _with_exit_codes(document: Dict[str, Any]) -> Dict[str, Any]:
    """Adds to the report of each step of finish the exit code that a separate call would return."""

    def checked(report: Optional[Dict[str, Any]]) -> Optional[Dict[str, Any]]:
        return report and {**report, "exitCode": 1 if report["counts"]["error"] else 0}

    models = [
        {**model, "made": {**model["made"], "exitCode": 0}, "before": checked(model["before"])}
        for model in document["models"]
    ]
    return {**document, "models": models, "check": checked(document["check"])}
