# SPDX-License-Identifier: MIT
"""Made by scripts/schema from docs/schema: reports on normal maps, for type checkers and for people who read."""

from __future__ import annotations

from typing import List, Optional

from ._report import Report


class FlipGreenReport(Report):
    """An image with inverted green: flip-green."""

    schema: str
    #: Version of the tool.
    version: str
    #: The output was written.
    ok: bool
    #: Path of the input.
    input: str
    #: Path of the output.
    output: str
    #: Nothing was written.
    dry_run: bool
    #: Null when ok.
    error: None
    #: Format of the output.
    format: str
    width: int
    height: int
    #: Bits per channel: 8 or 16, 32 for a float texture.
    bits: int
    #: False if a JPEG was recompressed, or a texture was rounded to a PNG.
    exact: bool
    #: Human-readable warnings.
    warnings: List[str]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class ConvertMapReport(Report):
    """A converted normal map."""

    schema: str
    #: Version of the tool.
    version: str
    #: The output was written.
    ok: bool
    #: Path of the input.
    input: str
    #: Path of the output.
    output: str
    #: Nothing was written.
    dry_run: bool
    #: Null when ok.
    error: None
    width: int
    height: int
    #: Bits per channel of the input, 8 or 16.
    bits_before: int
    #: Bits per channel of the output.
    bits: int
    #: The part that was used of the model that the map was made for; null without a model.
    from_: Optional[MapMesh]
    #: The part that was used of the model that will show the map; null if it is the same file.
    to: Optional[MapMesh]
    #: Texels inside triangles or their padding.
    converted: int
    #: Converted texels whose value changed.
    changed: int
    #: Texels in no triangle; they are unchanged.
    background: int
    #: Texels that are unchanged because their frames or values are invalid.
    without_frame: int
    #: Texels that two channels cannot represent; they get z = 0.
    below_horizon: int
    #: Texels shared by several triangles; the first one is used.
    overlapping: int
    #: Texels of these whose triangles need object-space directions that differ by more than 2 degrees.
    conflicting: int
    #: Texels that are unchanged because the other model has no triangle there.
    unmatched: int
    #: Texels with a different position on the other model.
    apart: int
    #: Triangles without UV area.
    degenerate_uvs: int
    #: Triangles whose UVs are not finite, or show the image more than 64 times.
    bad_uvs: int
    #: Angles between the converted and the unconverted texels.
    mean_change_deg: float
    max_change_deg: float
    #: Half a quantization step of the output, as an angle.
    half_step_deg: float
    #: The mean change is smaller than that, so rounding cancels it.
    below_half_step: bool
    #: Human-readable warnings.
    warnings: List[str]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class MapMesh(Report):
    #: Number of primitives that use the map.
    primitives: int
    #: Number of triangles of these primitives.
    triangles: int
    #: Names of their materials, without duplicates.
    materials: List[str]
    #: Some primitives had no tangents, which were computed.
    tangents_made: bool
    #: Factor that its materials apply to x and y of the map (glTF's "normalTexture.scale").
    scale: float


class HeightToNormalReport(Report):
    """A height map that became a normal map."""

    schema: str
    #: Version of the tool.
    version: str
    #: The output was written.
    ok: bool
    #: Path of the input.
    input: str
    #: Path of the output.
    output: str
    #: Nothing was written.
    dry_run: bool
    #: Null when ok.
    error: None
    width: int
    height: int
    #: Bits per channel of the input.
    bits_before: int
    #: Bits per channel of the output, 8 or 16.
    bits: int
    #: The part of the model that was used; null without a model.
    mesh: Optional[MapMesh]
    #: Texels whose size was taken from the triangle that shows them.
    texels_on_mesh: int
    #: Mean width of these texels, in model units; without a model the option texelSize, which is 1 by default.
    texel_size: float
    #: Angles between the normals and those of the surface, over all texels.
    mean_lean_deg: float
    max_lean_deg: float
    #: Human-readable warnings.
    warnings: List[str]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class CompressMapReport(Report):
    """A normal map that became a texture."""

    schema: str
    #: Version of the tool.
    version: str
    #: The output was written.
    ok: bool
    #: Path of the input.
    input: str
    #: Path of the output.
    output: str
    #: Nothing was written.
    dry_run: bool
    #: Null when ok.
    error: None
    width: int
    height: int
    #: Bits per channel of the input.
    bits_before: int
    #: Format of the output: BC5, EAC RG11 signed, ASTC 4x4, PNG of 16 bits.
    format: str
    #: Number of mip levels in the output.
    levels: int
    #: Size of the output.
    output_bytes: int
    #: Size of the roughness texture; 0: not requested.
    roughness_bytes: int
    #: Error of the first level, filtered: angle between the three-channel map and the texture.
    mean_error_deg: float
    #: 99th percentile.
    p99_error_deg: float
    max_error_deg: float
    #: X coordinate of the maximum, in texels from the left.
    max_error_x: float
    #: Y coordinate of the maximum, in texels from the top.
    max_error_y: float
    #: Texels whose z is below 0.
    below_horizon: int
    #: Texels whose length deviates from 1 by 0.1 or more.
    not_unit: int
    #: Mean roughness of the texture, with the factor; 0: not requested.
    mean_roughness: float
    #: Mean roughness of the last written mip level.
    mean_widened_roughness: float
    #: Human-readable warnings.
    warnings: List[str]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int
