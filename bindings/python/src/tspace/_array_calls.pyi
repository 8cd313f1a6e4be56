# SPDX-License-Identifier: MIT
"""Types of _array_calls.py: what the functions return depends on `full`."""

from typing import Literal, Optional, overload

import numpy

from ._normals import NormalResult
from ._options import ConventionLike
from ._pack import PackResult
from ._sanitize import SanitizeResult
from ._tangents import TangentResult
from ._types import (
    AttributeIndices,
    ByteArray,
    DegreesOrAuto,
    FaceSizes,
    FloatArray,
    FrameFormatName,
    FrameShapeName,
    MethodName,
    NgonsName,
    NormalWeightingName,
    Numbers,
    OutputDomainName,
    PairingName,
    Rows,
    Threads,
)

# Everything below is written by scripts/api.


@overload
def normals(
    positions: Rows,
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    weighting: NormalWeightingName = ...,
    crease_angle: DegreesOrAuto = ...,
    smoothing_groups: Optional[Numbers] = ...,
    smoothing_groups_are_masks: bool = ...,
    weld_positions: bool = ...,
    convention: Optional[ConventionLike] = ...,
    refine: int = ...,
    denoise: DegreesOrAuto = ...,
    weld_distance: DegreesOrAuto = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[False] = ...,
) -> FloatArray: ...


@overload
def normals(
    positions: Rows,
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    weighting: NormalWeightingName = ...,
    crease_angle: DegreesOrAuto = ...,
    smoothing_groups: Optional[Numbers] = ...,
    smoothing_groups_are_masks: bool = ...,
    weld_positions: bool = ...,
    convention: Optional[ConventionLike] = ...,
    refine: int = ...,
    denoise: DegreesOrAuto = ...,
    weld_distance: DegreesOrAuto = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[True],
) -> NormalResult: ...


@overload
def pack_frames(
    normals: Rows,
    tangents: Rows,
    format: FrameFormatName = ...,
    *,
    full: Literal[False] = ...,
) -> ByteArray: ...


@overload
def pack_frames(
    normals: Rows,
    tangents: Rows,
    format: FrameFormatName = ...,
    *,
    full: Literal[True],
) -> PackResult: ...


@overload
def sanitize(
    tangents: Rows,
    positions: Rows,
    normals: Rows,
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    normal_indices: AttributeIndices = ...,
    orthogonalize_all: bool = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[False] = ...,
) -> FloatArray: ...


@overload
def sanitize(
    tangents: Rows,
    positions: Rows,
    normals: Rows,
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    normal_indices: AttributeIndices = ...,
    orthogonalize_all: bool = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[True],
) -> SanitizeResult: ...


@overload
def tangents(
    positions: Rows,
    normals: Rows,
    uvs: Optional[Rows],
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    normal_indices: AttributeIndices = ...,
    uv_indices: AttributeIndices = ...,
    method: MethodName = ...,
    convention: ConventionLike,
    threshold: float = ...,
    pairing: PairingName = ...,
    ngons: NgonsName = ...,
    domain: OutputDomainName = ...,
    frame: FrameShapeName = ...,
    refine: int = ...,
    normalize_normals: bool = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[False] = ...,
) -> FloatArray: ...


@overload
def tangents(
    positions: Rows,
    normals: Rows,
    uvs: Optional[Rows],
    indices: Optional[Numbers] = ...,
    *,
    face_sizes: FaceSizes = ...,
    normal_indices: AttributeIndices = ...,
    uv_indices: AttributeIndices = ...,
    method: MethodName = ...,
    convention: ConventionLike,
    threshold: float = ...,
    pairing: PairingName = ...,
    ngons: NgonsName = ...,
    domain: OutputDomainName = ...,
    frame: FrameShapeName = ...,
    refine: int = ...,
    normalize_normals: bool = ...,
    threads: Threads = ...,
    out: Optional[numpy.ndarray] = ...,
    full: Literal[True],
) -> TangentResult: ...
