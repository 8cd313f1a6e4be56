# SPDX-License-Identifier: MIT
"""Made by scripts/schema from docs/schema: reports on files, for type checkers and for people who read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import List, Optional, Tuple

from ._generate_report import GenerateReport
from ._report import Findings, Report


class CheckReport(Findings):
    #: Path of the input.
    input: str
    #: The file could be read; it may have findings.
    ok: bool
    #: Null when ok.
    error: None
    #: "glb", "gltf", "obj", or the extension of an imported file such as "fbx"; of an image "png", "jpeg", "webp",
    #: "exr", "ktx2", "dds" or "tga".
    format: str
    #: The program that wrote the file; may be empty.
    generator: str
    #: Primitives in the file.
    primitives: int
    #: Primitives whose tangents were examined.
    primitives_with_tangents: int
    #: Images whose channel contents were examined.
    normal_maps: int
    #: Images whose relief shows the direction of green.
    normal_maps_with_green: int
    #: Content of an image that was checked as a normal map without a model; null for a model.
    image: Optional[CheckedImage]
    #: One entry for each format of packed frames of each primitive, in file order.
    packed_frames: List[CheckedPackedFrames]
    #: Findings by severity.
    counts: FindingCounts
    #: Findings by severity, errors first, then in file order.
    findings: List[Finding]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class CheckedImage(Report):
    width: int
    height: int
    #: "normals" in tangent space as glTF reads them, "twoChannels", "unsignedZ", "xInAlpha", "exchanged", "encoded"
    #: (sRGB), "hemiOctahedral", "objectSpace", "height", "picture" or "constant".
    content: str
    #: Direction of green (or of the channel with y), assuming x is correct: "up", "down", "mixed" or "unknown".
    green: str
    #: Share of texel blocks that agree, beyond an even split, 0 to 1.
    green_confidence: float


class CheckedPackedFrames(Report):
    #: JSON pointer of the attribute.
    place: str
    #: Name of the attribute, such as "_FRAME32"; the first one if two attributes contain a frame.
    attribute: str
    #: Format name, such as "frame32".
    format: str
    #: Index of the mesh.
    mesh: int
    #: Index of the primitive in its mesh.
    primitive: int
    vertices: int
    #: False: a finding "packedFramesUnreadable" gives the reason.
    readable: bool
    #: NORMAL and TANGENT exist; if not, angles and signs here are 0.
    compared: bool
    #: The largest angle between N as decoded and NORMAL.
    worst_normal_degrees: float
    #: Largest angle between T as decoded and TANGENT, made orthogonal to NORMAL if necessary.
    worst_tangent_degrees: float
    #: Error bound that the format guarantees.
    promised_normal_degrees: float
    promised_tangent_degrees: float
    #: Vertices whose sign differs from TANGENT.
    differing_signs: int


class FindingCounts(Report):
    error: int
    warning: int
    note: int


@dataclass(frozen=True)
class Finding:
    #: Stable code of the finding.
    code: str
    severity: str
    #: JSON pointer of the primitive, morph target, attribute or texture; for OBJ "usemtl NAME"; empty: the whole file.
    place: str
    #: Index of the mesh.
    mesh: int
    #: Index of the primitive in its mesh.
    primitive: int
    #: May be empty.
    mesh_name: str
    #: May be empty.
    material_name: str
    #: Counted unit: "vertices", "triangles", "targets" (of a morph), "blocks" or "texels" (of an image), "images",
    #: "textures", "attributes", "primitives", "meshes" or "files".
    unit: str
    #: Number of elements that have the fault.
    count: int
    #: Number of candidates.
    total: int
    #: Share of the primitive's surface that is affected, 0 to 1; 0 if not applicable.
    surface_share: float
    #: The largest angle, for findings about angles; else 0.
    worst_degrees: float
    #: 0 to 1; below 1 for statistical findings.
    confidence: float
    #: The first affected vertices.
    vertices: Tuple[int, ...]
    #: The fault, in a sentence that is the same for all findings of the code.
    summary: str
    #: The visible symptom, in a sentence that is the same for all findings of the code.
    effect: str
    #: Human-readable summary in one sentence.
    message: str
    #: Human-readable fix.
    remedy: str
    #: View of "tspace render --show" that makes it visible; empty: none.
    show: str
    #: Commands that "remedy" names, in its order.
    commands: Tuple[RemedyCommand, ...]


@dataclass(frozen=True)
class RemedyCommand:
    #: Name of the command: "generate", "convert-map", ...
    verb: str
    #: Files; empty: the model that was checked.
    inputs: Tuple[str, ...]
    #: Options in the order of the command line.
    options: Tuple[RemedyOption, ...]
    #: Words among inputs and values that the user replaces, such as "OUT.png".
    placeholders: Tuple[str, ...]
    #: Command line, as in "remedy".
    line: str


@dataclass(frozen=True)
class RemedyOption:
    #: Name without dashes; "o" is the output.
    name: str
    #: Empty: the option is a flag.
    value: str


class InspectReport(Report):
    #: Path of the input.
    input: str
    #: The file could be read.
    ok: bool
    #: Null when ok.
    error: None
    #: "glb", "gltf", "obj", or the extension of an imported file such as "fbx".
    format: str
    #: The program that wrote the file; may be empty.
    generator: str
    #: The model file and the files that it loads, without images.
    file_bytes: int
    #: For OBJ: objects and groups with faces.
    meshes: int
    #: For OBJ: materials that faces use and an MTL file defines.
    materials: int
    nodes: int
    animations: int
    images: int
    extensions_used: List[str]
    extensions_required: List[str]
    #: Names of KHR_materials_variants.
    variants: List[str]
    #: Human-readable warnings about the file as a whole: data that were ignored or repaired while reading.
    warnings: List[str]
    #: Offset that "generate" would subtract from the coordinates of an OBJ, PLY or STL file far from the origin;
    #: zeros: none.
    coordinate_offset: List[float]
    #: One entry per primitive, in file order.
    primitives: List[InspectedPrimitive]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class InspectedPrimitive(Report):
    #: Index of the mesh.
    mesh: int
    #: Index of the primitive in its mesh.
    primitive: int
    #: May be empty.
    mesh_name: str
    #: May be empty.
    material_name: str
    #: "triangles", "triangle strip", "points", ...; for OBJ also "polygons".
    mode: str
    #: Number of triangles after triangulation of polygons.
    triangles: int
    vertices: int
    index_type: str
    compression: str
    #: Attribute and type, such as "POSITION float3".
    attributes: List[str]
    uv_sets: int
    morph_targets: int
    skinned: bool
    has_normals: bool
    has_tangents: bool
    #: "hasTangents" is false, but the file may have tangents that the importer cannot read.
    tangents_not_read: bool
    #: Names of the formats of packed frames in the primitive, such as "frame32".
    packed_frames: List[str]
    #: The material needs tangents.
    needs_tangents: bool
    #: User of the tangents: "normalTexture", "clearcoatNormalTexture", "anisotropy", or empty.
    needed_by: str
    #: The textures of its materials that need tangents; the tangents follow the first one.
    tangent_uses: List[TangentUse]
    #: Materials that KHR_materials_variants can assign to it.
    variant_materials: int
    #: Nodes that draw its mesh.
    nodes: int
    #: Number of times it is drawn; EXT_mesh_gpu_instancing counts each instance.
    instances: int
    #: The n of the "TEXCOORD_n" that tangents would follow, or -1.
    uv_set: int
    #: Triangles without UV area in that set.
    degenerate_uv_triangles: int
    #: Triangles with two corners at one position.
    degenerate_triangles: int
    #: Noise of the positions: standard deviation along the normal, in mean edge lengths; 0: less than 0.03, or fewer
    #: than 1,000 triangles, or not enough memory to measure it.
    position_noise: float
    #: Triangles that show the texture mirrored.
    mirrored_triangles: int
    #: Connected components of the UV map.
    uv_islands: int
    #: UV islands whose area is mostly mirrored.
    mirrored_uv_islands: int


class TangentUse(Report):
    #: User of the tangents.
    needed_by: str
    #: JSON pointer; empty for OBJ.
    place: str
    #: Index of the material.
    material: int
    #: May be empty.
    material_name: str
    #: The material is one of KHR_materials_variants, not the primitive's own.
    only_in_variant: bool
    #: The n of "TEXCOORD_n".
    uv_set: int
    #: Offset of KHR_texture_transform.
    uv_offset: List[float]
    #: Rotation in radians.
    uv_rotation: float
    #: Scale of the transform.
    uv_scale: List[float]
    #: Tangents made for the first texture fit this one too.
    follows_first: bool


class IdentifyReport(Report):
    #: Path of the input.
    input: str
    #: The file could be read.
    ok: bool
    #: Null when ok.
    error: None
    #: "glb", "gltf", "obj", or the extension of an imported file such as "fbx".
    format: str
    #: The program that wrote the file; may be empty.
    generator: str
    #: Human-readable warnings about the file as a whole.
    warnings: List[str]
    #: Human-readable summary of two or three sentences.
    verdict: str
    #: Over all primitives, along the texture's UV set, the best method first.
    explanations: List[Explanation]
    #: In file order.
    primitives: List[IdentifiedPrimitive]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class Explanation(Report):
    #: Name of the method.
    method: str
    #: "quads" where pairs of triangles explain clearly more (mikktspace only), else "triangles".
    faces: str
    #: N of the "TEXCOORD_n" that was used; -1 over several primitives.
    uv_set: int
    #: It is the UV set that the texture uses.
    is_textures_set: bool
    #: The UVs were used as rotated or mirrored by KHR_texture_transform.
    is_transformed: bool
    #: Corners compared.
    corners: int
    #: Corners of triangles without UV area, which are ignored.
    undecided_corners: int
    #: Compared corners within the tolerance of the method's tangent.
    near: int
    #: Compared corners that are within the tolerance at some corner of their vertex.
    near_at_vertex: int
    #: Mean angle to the method's tangent.
    mean_deg: float
    #: Corners whose sign is that of glTF.
    gltf_signs: int
    #: Corners whose sign is the opposite.
    inverted_signs: int
    #: The signs of most corners.
    signs: str


class IdentifiedPrimitive(Report):
    #: JSON pointer, or "usemtl NAME" for OBJ.
    place: str
    mesh: int
    #: Index of the primitive in its mesh.
    primitive: int
    #: May be empty.
    mesh_name: str
    #: May be empty.
    material_name: str
    #: Reason why it was not examined; empty: it was examined.
    skipped: str
    #: Every method along every UV set that has an area, the best first.
    explanations: List[Explanation]


class DiffReport(Report):
    """Differences between the frames of two models: diff."""

    schema: str
    #: Version of the tool.
    version: str
    #: Both files could be read.
    ok: bool
    #: Path of the first file.
    a: str
    #: Path of the second file.
    b: str
    #: Null when ok.
    error: None
    #: Tolerance of the run.
    tolerance_deg: float
    #: No angle exceeds the tolerance, no sign differs, every triangle has a match.
    is_within_tolerance: bool
    #: Pairs of corners that were examined.
    corners: int
    #: Pairs whose signs differ.
    sign_changes: int
    #: Triangles of both files without a match.
    unpaired_triangles: int
    #: Primitives with tangents in one file only.
    missing_tangents: int
    #: Upper ends of the bins of every histogram.
    histogram_upper_deg: List[float]
    #: Angles between T.
    tangents: AngleStatistics
    #: Angles between N.
    normals: AngleStatistics
    #: Angles between "sign * cross(N, T)".
    bitangents: AngleStatistics
    #: Human-readable warnings, each preceded by the name of its file.
    warnings: List[str]
    #: Corners with the largest differences, the largest angle first.
    worst: List[FrameDifference]
    #: Primitives of A in file order, then primitives of B without a match.
    primitives: List[DiffedPrimitive]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class AngleStatistics(Report):
    #: Pairs of corners with a direction in both.
    corners: int
    #: Pairs in which one vector has no direction (zero or not finite).
    unusable: int
    mean_deg: float
    #: Median.
    median_deg: float
    #: 95th percentile.
    p95_deg: float
    max_deg: float
    #: Pairs per bin, see "histogramUpperDeg".
    histogram: List[int]


class FrameDifference(Report):
    mesh_a: int
    primitive_a: int
    vertex_a: int
    mesh_b: int
    primitive_b: int
    vertex_b: int
    #: Location in A.
    position: List[float]
    tangent_deg: float
    normal_deg: float
    bitangent_deg: float
    sign_differs: bool


class DiffedPrimitive(Report):
    #: Null: only the other file has it.
    a: Optional[DiffedSide]
    #: Null: only the other file has it.
    b: Optional[DiffedSide]
    #: May be empty.
    mesh_name: str
    #: How the two were matched.
    paired_by: str
    paired_triangles: int
    sign_changes: int
    #: Angles between T.
    tangents: AngleStatistics
    #: Angles between N.
    normals: AngleStatistics
    #: Angles between "sign * cross(N, T)".
    bitangents: AngleStatistics


class DiffedSide(Report):
    #: JSON pointer, or "usemtl NAME" for OBJ.
    place: str
    mesh: int
    #: Index of the primitive in its mesh.
    primitive: int
    triangles: int
    has_tangents: bool
    #: "hasTangents" is false, but the file may have tangents that the importer cannot read.
    tangents_not_read: bool
    has_normals: bool


class BakeReport(Report):
    """Maps that were baked."""

    schema: str
    #: Version of the tool.
    version: str
    #: The bake succeeded; if no ray hit anything, it still counts as success, but nothing is written.
    ok: bool
    #: Path of the low poly.
    low: str
    #: Path of the high poly.
    high: str
    #: Path of the output, as it was given.
    output: str
    #: Time of the whole run.
    seconds: float
    #: Null when ok.
    error: None
    low_triangles: int
    high_triangles: int
    #: The low poly lacked normals or tangents, which were computed.
    frames_made: bool
    #: Each object of the low poly was baked only from its matching object of the high poly.
    matched_by_name: bool
    #: Normal maps of the high poly that were baked through.
    high_maps: List[HighMap]
    #: One entry per map.
    files: List[BakedMap]
    #: Paths of all written files.
    output_files: List[str]
    #: Faults that make a map unusable, with the cause if it was determined; if there are any, the exit code is 1.
    findings: List[str]
    #: Human-readable warnings.
    warnings: List[str]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class HighMap(Report):
    #: URI or name of the image in the high poly.
    image: str
    #: The first material that shows it; may be empty.
    material: str
    #: Factor of x and y (glTF's "normalTexture.scale").
    scale: float
    #: Direction of green.
    green: str
    #: Source of the direction: the format, "--high-green", the file, or the slopes of the map.
    green_is: str
    #: Triangles of the high poly that show it.
    triangles: int


class BakedMap(Report):
    #: Path of the normal map; empty if "--maps" does not include it.
    path: str
    #: Name of the material; may be empty.
    material: str
    #: UDIM tile number (1001, ...) with "--udim"; else 0.
    tile: int
    width: int
    height: int
    #: Bits per channel of the normal map.
    bits: int
    #: Triangles of the low poly.
    triangles: int
    #: Texel counts by state.
    texels: BakedTexels
    #: Mean angle between the normals that triangles need in conflicting texels; 0 without conflicts.
    conflict_mean_deg: float
    #: The largest of these angles.
    conflict_max_deg: float
    #: Triangles of the material outside the 0-1 UV range, which were ignored.
    outside_triangles: int
    #: Triangles without UV area, or whose UVs are not finite.
    degenerate_uvs: int
    #: Front face that was baked: "outermost" or "nearest"; "cage": the first one from the cage mesh.
    rays: str
    #: Ray directions: a value of "--directions", or "skew" (skew map) or "cage" (cage mesh).
    directions: str
    #: Ray distance from the low poly, in model units.
    reach: float
    #: Cage distance from the low poly's faces, in model units; 0 with a cage mesh.
    cage_offset: float
    #: Angles between the shaded normals of the map and the outermost front face of the high poly; null without a
    #: normal map.
    error: Optional[MapAngles]
    #: With "--rays nearest", the angles to the hits of these rays; else null.
    own_error: Optional[MapAngles]
    #: With "--heat", the value mapped to white; else 0.
    heat_top_deg: float
    #: The other maps of "--maps", in its order.
    maps: List[BakedLayer]


class BakedTexels(Report):
    #: Texels whose center lies in a triangle and whose ray hit the high poly.
    baked: int
    #: Texels whose ray hit nothing; they were filled from their neighbors.
    missed: int
    #: Padding texels.
    padding: int
    #: Texels whose center lies inside several triangles.
    overlapping: int
    #: Texels of these whose triangles need normals that differ by more than 2 degrees.
    conflicting: int


class MapAngles(Report):
    #: Samples that hit the high poly.
    points: int
    #: Samples whose ray hit no front face; each counts as 90 degrees.
    missed: int
    #: Samples whose ray hit another front face of the high poly outside the baked one.
    hidden: int
    #: Samples whose ray passed a back face of the high poly before the baked front face, or hit only back faces.
    backs: int
    #: Samples that hit a front face whose normal points inward.
    inward: int
    #: Mean angle between the shaded normal and the high poly, over all samples.
    mean_deg: float
    #: Mean over the samples that hit the high poly.
    met_mean_deg: float
    #: 99th percentile.
    p99_deg: float
    #: Maximum.
    max_deg: float
    #: Samples within one texel of a UV border.
    seam_points: int
    #: Mean over these samples.
    seam_mean_deg: float
    #: Mean over the other samples.
    inside_mean_deg: float


class BakedLayer(Report):
    #: Name of the map, as in "--maps".
    map: str
    #: Path of the map's file.
    path: str
    #: Bits per channel.
    bits: int
    #: The values are sRGB-encoded.
    srgb: bool
    #: Value that 0 represents, for each of the three channels: lengths in model units; for "curvature", 1/length.
    black: List[float]
    #: Value that the maximum of each channel represents.
    white: List[float]
    #: For "id", the number of materials, objects or shells of the high poly; else 0.
    id_count: int
    #: For "id", the first 256 entries; else empty.
    ids: List[BakedId]


class BakedId(Report):
    #: Name of the material or object; empty for shells.
    name: str
    #: Color in the map: "#rrggbb".
    color: str


class FinishReport(Report):
    """A finished model: "tspace finish" (finish)."""

    schema: str
    #: Version of the tool.
    version: str
    #: Nothing failed; if no ray of a bake hit anything, this still counts as success, but nothing is written.
    ok: bool
    #: Path of the input.
    input: str
    #: Path of the low poly; empty without one.
    low: str
    #: Path of the output, as it was given.
    output: str
    #: Time of the whole run.
    seconds: float
    #: Null when ok.
    error: None
    #: The input, and with "--low" the low poly.
    models: List[FinishedModel]
    #: Findings of "check" in the output; null if nothing was written.
    check: Optional[CheckReport]
    #: With "--low" the report of the bake, as tspace.bake/1; else null.
    bake: Optional[BakeReport]
    #: Paths of all written files except that of "--report", the model first.
    output_files: List[str]
    #: Size of the model file.
    output_bytes: int
    #: Human-readable sentences on what could not be done, and which tools do it.
    remarks: List[str]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class FinishedModel(Report):
    #: The winding, normals and tangents that were computed; its output path is empty.
    made: GenerateReport
    #: Findings of "check" in the input.
    before: CheckReport
    #: Human-readable sentences.
    done: List[str]
    #: Primitives with triangles and without UVs.
    without_uvs: int
    #: Triangles whose winding was kept, because the existing normals fit it.
    left_winding: int
