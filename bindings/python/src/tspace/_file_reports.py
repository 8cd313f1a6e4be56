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
    #: Those of them whose tangents were examined.
    primitives_with_tangents: int
    #: Images that were looked at: what their channels hold.
    normal_maps: int
    #: Those of them whose relief says which way green points.
    normal_maps_with_green: int
    #: What an image holds as a normal map that was checked without a model; null for a model.
    image: Optional[CheckedImage]
    #: One entry for each format of packed frames of each primitive, in file order.
    packed_frames: List[CheckedPackedFrames]
    #: Findings by severity.
    counts: FindingCounts
    #: Errors first; among equals in file order.
    findings: List[Finding]
    #: That of the tool: 0, or 1 where something was found.
    exit_code: int


class CheckedImage(Report):
    width: int
    height: int
    #: "normals" in tangent space as glTF reads them, "twoChannels", "unsignedZ", "xInAlpha", "exchanged", "encoded"
    #: (sRGB), "hemiOctahedral", "objectSpace", "height", "picture" or "constant".
    content: str
    #: Direction of green, or of y where that is in another channel, if x is right: "up", "down", "mixed" or "unknown".
    green: str
    #: How many blocks of texels agree beyond an even split, 0 to 1.
    green_confidence: float


class CheckedPackedFrames(Report):
    #: JSON pointer of the attribute.
    place: str
    #: Its name, such as "_FRAME32"; of two that hold one frame the first.
    attribute: str
    #: Such as "frame32".
    format: str
    #: Index of the mesh.
    mesh: int
    #: Index of the primitive in its mesh.
    primitive: int
    vertices: int
    #: False: a finding "packedFramesUnreadable" says why.
    readable: bool
    #: NORMAL and TANGENT are there; if not, angles and signs here are 0.
    compared: bool
    #: The largest angle between N as decoded and NORMAL.
    worst_normal_degrees: float
    #: The same of T and TANGENT, made orthogonal to NORMAL where it is not.
    worst_tangent_degrees: float
    #: What the format promises.
    promised_normal_degrees: float
    promised_tangent_degrees: float
    #: Vertices with another sign than TANGENT.
    differing_signs: int


class FindingCounts(Report):
    error: int
    warning: int
    note: int


@dataclass(frozen=True)
class Finding:
    #: Stable name of what was found.
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
    #: What is counted: "vertices", "triangles", "targets" (of a morph), "blocks" or "texels" (of an image), "images",
    #: "textures", "attributes", "primitives", "meshes" or "files".
    unit: str
    #: How many have it.
    count: int
    #: Of how many that could have it.
    total: int
    #: Their part of the primitive's surface, 0 to 1; 0 where that says nothing.
    surface_share: float
    #: The largest angle, for findings about angles; else 0.
    worst_degrees: float
    #: 0 to 1; below 1 for findings that rest on statistics.
    confidence: float
    #: The first of them.
    vertices: Tuple[int, ...]
    #: One sentence for a person.
    message: str
    #: How to mend it, for a person.
    remedy: str
    #: The view of tspace render --show that shows it; empty: none does.
    show: str
    #: Commands that "remedy" names, in its order.
    commands: Tuple[RemedyCommand, ...]


@dataclass(frozen=True)
class RemedyCommand:
    #: Name of the command: "generate", "convert-map", ...
    verb: str
    #: Files; empty: the model that was checked.
    inputs: Tuple[str, ...]
    #: In the order of the command line.
    options: Tuple[RemedyOption, ...]
    #: Words among inputs and values that the user replaces, such as "OUT.png".
    placeholders: Tuple[str, ...]
    #: The command line, as it stands in "remedy".
    line: str


@dataclass(frozen=True)
class RemedyOption:
    #: Without dashes; "o": where the result goes.
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
    #: The model file and what it loads, without images.
    file_bytes: int
    #: For OBJ: objects and groups with faces.
    meshes: int
    #: For OBJ: those that faces use and an MTL file has.
    materials: int
    nodes: int
    animations: int
    images: int
    extensions_used: List[str]
    extensions_required: List[str]
    #: Names of KHR_materials_variants.
    variants: List[str]
    #: Sentences for a person about the file as a whole: what was left out or mended as it was read.
    warnings: List[str]
    #: What "generate" would take out of the coordinates of an OBJ, PLY or STL file far from the origin; zeros:
    #: nothing.
    coordinate_offset: List[float]
    #: One entry per primitive, in file order.
    primitives: List[InspectedPrimitive]
    #: That of the tool: 0, or 1 where something was found.
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
    #: After cutting polygons.
    triangles: int
    vertices: int
    index_type: str
    compression: str
    #: Such as "POSITION float3".
    attributes: List[str]
    uv_sets: int
    morph_targets: int
    skinned: bool
    has_normals: bool
    has_tangents: bool
    #: "hasTangents" is false, but the file may have some: the importer cannot give them.
    tangents_not_read: bool
    #: Names of the formats of packed frames that it has, such as "frame32".
    packed_frames: List[str]
    #: The material needs them.
    needs_tangents: bool
    #: What reads the tangents: "normalTexture", "clearcoatNormalTexture", "anisotropy", or empty.
    needed_by: str
    #: Everything in its materials that needs tangents; they follow the first.
    tangent_uses: List[TangentUse]
    #: Materials that KHR_materials_variants can put on it.
    variant_materials: int
    #: Nodes that draw its mesh.
    nodes: int
    #: How often they draw it; EXT_mesh_gpu_instancing counts each.
    instances: int
    #: The n of the "TEXCOORD_n" that tangents would follow, or -1.
    uv_set: int
    #: Triangles without UV area in that set.
    degenerate_uv_triangles: int
    #: Triangles with two corners at one position.
    degenerate_triangles: int
    #: Random offsets of positions, as a standard deviation along the normal in mean edge lengths; 0: less than .03, or
    #: less than 1,000 triangles, or no memory to measure.
    position_noise: float
    #: Triangles that show the texture mirrored.
    mirrored_triangles: int
    #: Connected pieces of the UV map.
    uv_islands: int
    #: Those of which most of the area is mirrored.
    mirrored_uv_islands: int


class TangentUse(Report):
    #: What reads the tangents.
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
    #: Of KHR_texture_transform.
    uv_offset: List[float]
    #: Of the same, in radians.
    uv_rotation: float
    #: Of the same.
    uv_scale: List[float]
    #: Tangents made for the first entry fit this one too.
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
    #: Sentences for a person about the file as a whole.
    warnings: List[str]
    #: Two or three sentences for a person.
    verdict: str
    #: Over all primitives, along the texture's UV set, the best method first.
    explanations: List[Explanation]
    #: In file order.
    primitives: List[IdentifiedPrimitive]
    #: That of the tool: 0, or 1 where something was found.
    exit_code: int


class Explanation(Report):
    #: Name of the method.
    method: str
    #: "quads" where pairs of triangles explain clearly more (mikktspace only), else "triangles".
    faces: str
    #: The n of the "TEXCOORD_n" that was followed; -1 over several primitives.
    uv_set: int
    #: It is the set that the texture reads.
    is_textures_set: bool
    #: The UVs were taken as KHR_texture_transform turns or mirrors them.
    is_transformed: bool
    #: Corners compared.
    corners: int
    #: Corners of triangles whose UVs have no area: they vote in nothing.
    undecided_corners: int
    #: Of those, within the tolerance of the method's tangent.
    near: int
    #: Within the tolerance at some corner of the same vertex.
    near_at_vertex: int
    #: Mean angle to the method's tangent.
    mean_deg: float
    #: Corners whose sign is the one that glTF wants.
    gltf_signs: int
    #: Corners whose sign is the opposite.
    inverted_signs: int
    #: The signs of most corners.
    signs: str


class IdentifiedPrimitive(Report):
    #: JSON pointer, or "usemtl NAME" for OBJ.
    place: str
    mesh: int
    #: Its index in the mesh.
    primitive: int
    #: May be empty.
    mesh_name: str
    #: May be empty.
    material_name: str
    #: Why it was not looked at; empty: it was.
    skipped: str
    #: Every method along every UV set that has an area, the best first.
    explanations: List[Explanation]


class DiffReport(Report):
    """How the frames of two models differ: diff."""

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
    #: The tolerance of the run.
    tolerance_deg: float
    #: No angle above the tolerance, no sign differs, every triangle has a partner.
    is_within_tolerance: bool
    #: Pairs of corners that were looked at.
    corners: int
    #: Pairs whose signs differ.
    sign_changes: int
    #: Triangles of both files without a partner.
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
    #: Sentences for a person about the files, each behind the name of its file.
    warnings: List[str]
    #: The worst places, the largest angle first.
    worst: List[FrameDifference]
    #: Those of A in file order, then those of B without a partner.
    primitives: List[DiffedPrimitive]
    #: That of the tool: 0, or 1 where something was found.
    exit_code: int


class AngleStatistics(Report):
    #: Pairs of corners with a direction in both.
    corners: int
    #: Pairs of which one has no direction (zero or not finite).
    unusable: int
    mean_deg: float
    #: Half of the pairs differ by this or less.
    median_deg: float
    #: 95 % of the pairs.
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
    #: Where, in A.
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
    #: How the two were found to belong together.
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
    #: Its index in the mesh.
    primitive: int
    triangles: int
    has_tangents: bool
    #: "hasTangents" is false, but the file may have some: the importer cannot give them.
    tangents_not_read: bool
    has_normals: bool


class BakeReport(Report):
    """Maps that were baked."""

    schema: str
    #: Version of the tool.
    version: str
    #: The bake was done; where no ray met anything nothing is written all the same.
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
    #: The low poly lacked normals or tangents, which were made.
    frames_made: bool
    #: Objects of the low poly saw their own of the high poly alone.
    matched_by_name: bool
    #: Normal maps of the high poly that were baked through.
    high_maps: List[HighMap]
    #: One entry per map.
    files: List[BakedMap]
    #: Paths of everything that was written.
    output_files: List[str]
    #: What makes maps useless, with the cause where it was found; the exit code is 1 where there is one.
    findings: List[str]
    #: Sentences for a person.
    warnings: List[str]
    #: That of the tool: 0, or 1 where something was found.
    exit_code: int


class HighMap(Report):
    #: Its URI or name in the high poly.
    image: str
    #: The first material that shows it; may be empty.
    material: str
    #: Of x and y.
    scale: float
    #: Which way green points.
    green: str
    #: How that is known: as the format has it, by "--high-green", by the file, or by the slopes of the map.
    green_is: str
    #: Triangles of the high poly that show it.
    triangles: int


class BakedMap(Report):
    #: Path of the normal map; empty where "--maps" does not ask for it.
    path: str
    #: Its material's name; may be empty.
    material: str
    #: With "--udim" 1001 and on; else 0.
    tile: int
    width: int
    height: int
    #: Of a channel of the normal map.
    bits: int
    #: Of the low poly.
    triangles: int
    #: Texels by what became of them.
    texels: BakedTexels
    #: How far apart the normals are that triangles want in conflicting texels, in the mean; 0 without.
    conflict_mean_deg: float
    #: The largest of these angles.
    conflict_max_deg: float
    #: Triangles of the material with UVs outside of 0 to 1, which have no say.
    outside_triangles: int
    #: Triangles without UV area, or whose UVs are not finite.
    degenerate_uvs: int
    #: Which front counted: "outermost" or "nearest"; "cage": the first from the cage of its own.
    rays: str
    #: Where rays pointed: as "--directions", or by the image ("skew") or the cage ("cage").
    directions: str
    #: How far rays went from the low poly, in units of the models.
    reach: float
    #: How far from the low poly's faces rays began; 0 with a cage of its own.
    cage_offset: float
    #: The angles between what the map shows and the outermost front of the high poly; null without a normal map.
    error: Optional[MapAngles]
    #: With "--rays nearest" the angles to what its own rays met; else null.
    own_error: Optional[MapAngles]
    #: With "--heat": what white stands for; else 0.
    heat_top_deg: float
    #: The other maps that "--maps" asks for, in its order.
    maps: List[BakedLayer]


class BakedTexels(Report):
    #: Texels whose centre lies in a triangle and whose line met the high poly.
    baked: int
    #: Those whose line met nothing; filled from around.
    missed: int
    #: Texels that continue the nearest triangle.
    padding: int
    #: Texels whose centre lies inside of several triangles.
    overlapping: int
    #: Those of them whose triangles want normals over 2 degrees apart.
    conflicting: int


class MapAngles(Report):
    #: Points that met the high poly.
    points: int
    #: Points whose ray met no front of it; each counts as 90 degrees.
    missed: int
    #: Points whose ray met another front of the high poly further out than the one that counts.
    hidden: int
    #: Points whose ray went through a back of the high poly before the front that counts, or met backs alone.
    backs: int
    #: Points that met a front whose normal points inwards.
    inward: int
    #: The mean of the angles between shaded normal and high poly, of all points.
    mean_deg: float
    #: The mean of the points that met the high poly.
    met_mean_deg: float
    #: What 99 % of them are below.
    p99_deg: float
    #: The largest.
    max_deg: float
    #: Points within a texel of a border of the UV map.
    seam_points: int
    #: Their mean.
    seam_mean_deg: float
    #: That of the others.
    inside_mean_deg: float


class BakedLayer(Report):
    #: Which map: its name in "--maps".
    map: str
    #: Path of its file.
    path: str
    #: Of a channel.
    bits: int
    #: Its numbers have the sRGB curve.
    srgb: bool
    #: What 0 of each of the three channels stands for: lengths in units of the models, of "curvature" 1 / length.
    black: List[float]
    #: What the largest number of each channel stands for.
    white: List[float]
    #: Of "id": how many materials, objects or shells the high poly has; else 0.
    id_count: int
    #: Of "id": the first 256 of them; else empty.
    ids: List[BakedId]


class BakedId(Report):
    #: Of the material or object; empty for shells.
    name: str
    #: Its colour in the map: "#rrggbb".
    color: str


class FinishReport(Report):
    """A model that was made ready: "tspace finish" (finish)."""

    schema: str
    #: Version of the tool.
    version: str
    #: Nothing failed; where no ray of a bake met anything nothing is written all the same.
    ok: bool
    #: Path of the input.
    input: str
    #: Path of the low poly; empty without.
    low: str
    #: Path of the output, as it was given.
    output: str
    #: Time of the whole run.
    seconds: float
    #: Null when ok.
    error: None
    #: The input, and with "--low" the low poly.
    models: List[FinishedModel]
    #: What "check" finds in the output; null where nothing was written.
    check: Optional[CheckReport]
    #: With "--low" the report of the bake, as tspace.bake/1; else null.
    bake: Optional[BakeReport]
    #: Paths of everything that was written, the model first, but for the file of "--report".
    output_files: List[str]
    #: Of the model.
    output_bytes: int
    #: What could not be done, and what does it: sentences for a person.
    remarks: List[str]
    #: That of the tool: 0, or 1 where something was found.
    exit_code: int


class FinishedModel(Report):
    #: Winding, normals and tangents that were made; names no output.
    made: GenerateReport
    #: What "check" finds in the file as it was.
    before: CheckReport
    #: The same in sentences for a person.
    done: List[str]
    #: Primitives with triangles and without UVs.
    without_uvs: int
    #: Triangles that stay as they are wound, because the normals that are there fit them so.
    left_winding: int
