# SPDX-License-Identifier: MIT
"""Made by scripts/schema from docs/schema: reports on normal maps, for type checkers and for people who read."""

from __future__ import annotations

from typing import List, Optional

from ._report import Report


class FlipGreenReport(Report):
    """An image whose green was inverted: flip-green."""

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
    #: Of the output.
    format: str
    width: int
    height: int
    #: Of a channel: 8 or 16, 32 of a texture of floats.
    bits: int
    #: False where a JPEG was compressed once more, or a texture rounded to a PNG.
    exact: bool
    #: Sentences for a person.
    warnings: List[str]
    #: That of the tool: 0, or 1 where something was found.
    exit_code: int


class ConvertMapReport(Report):
    """A normal map that was converted."""

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
    #: Of a channel of the input, 8 or 16.
    bits_before: int
    #: Of the output.
    bits: int
    #: What was taken of the model that the map was made for; null without one.
    from_: Optional[MapMesh]
    #: The same of the model that it is shown on; null where that is the same file.
    to: Optional[MapMesh]
    #: Texels that triangles or their padding show.
    converted: int
    #: Those of them with another value than before.
    changed: int
    #: Texels that no triangle shows; they stay.
    background: int
    #: Texels that stay since their frames or values are broken.
    without_frame: int
    #: Texels that two channels cannot say; they get z = 0.
    below_horizon: int
    #: Texels that several triangles show; the first decides.
    overlapping: int
    #: Those of them whose triangles want directions in object space that are over 2 degrees apart.
    conflicting: int
    #: Texels that stay since the other model has no triangle there.
    unmatched: int
    #: Texels that lie elsewhere in space on the other model.
    apart: int
    #: Triangles without UV area.
    degenerate_uvs: int
    #: Triangles whose UVs are not finite, or show the image more than 64 times.
    bad_uvs: int
    #: Between what texels show and what they would show unconverted.
    mean_change_deg: float
    max_change_deg: float
    #: Half a step of the output's integers, as an angle.
    half_step_deg: float
    #: The mean change is smaller, so rounding undoes it.
    below_half_step: bool
    #: Sentences for a person.
    warnings: List[str]
    #: That of the tool: 0, or 1 where something was found.
    exit_code: int


class MapMesh(Report):
    #: How many primitives show the map.
    primitives: int
    #: Their triangles.
    triangles: int
    #: Their names, each once.
    materials: List[str]
    #: Some had no tangents, which were made.
    tangents_made: bool
    #: What its materials multiply x and y of the map by (glTF's "normalTexture.scale").
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
    #: Of a channel of the input.
    bits_before: int
    #: Of the output, 8 or 16.
    bits: int
    #: What was taken of the model; null without one.
    mesh: Optional[MapMesh]
    #: Texels whose size was taken from the triangle that shows them.
    texels_on_mesh: int
    #: The mean width of those, in units of the model; without a model the option texelSize, which is 1 by default.
    texel_size: float
    #: Between the normals and the surface's, over all texels.
    mean_lean_deg: float
    max_lean_deg: float
    #: Sentences for a person.
    warnings: List[str]
    #: That of the tool: 0, or 1 where something was found.
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
    #: Of a channel of the input.
    bits_before: int
    #: What was written: BC5, EAC RG11 signed, ASTC 4x4, PNG of 16 bits.
    format: str
    #: In the output.
    levels: int
    #: Size of the output.
    output_bytes: int
    #: Size of the roughness texture; 0: none was asked for.
    roughness_bytes: int
    #: Of the first level, filtered: between the map with three channels and the texture.
    mean_error_deg: float
    #: 99 % of the points are nearer.
    p99_error_deg: float
    max_error_deg: float
    #: Where that is, in texels from the left.
    max_error_x: float
    #: And from the top.
    max_error_y: float
    #: Texels whose z is below 0.
    below_horizon: int
    #: Texels that are a tenth or more longer or shorter than unit vectors.
    not_unit: int
    #: Of the roughness texture, with the factor; 0: none was asked for.
    mean_roughness: float
    #: Of its last level as it was written.
    mean_widened_roughness: float
    #: Sentences for a person.
    warnings: List[str]
    #: That of the tool: 0, or 1 where something was found.
    exit_code: int
