# SPDX-License-Identifier: MIT
"""Made by scripts/schema from docs/schema: the report of generate, for type checkers and for people who read."""

from __future__ import annotations

from typing import List, Optional

from ._report import Report


class GenerateReport(Report):
    #: Path of the input.
    input: str
    #: Path of the output; empty if there is none for this input.
    output: str
    #: The output was written.
    ok: bool
    #: Null when ok.
    error: None
    #: Time for this file.
    seconds: float
    #: The file was skipped, because it was processed before according to the manifest, and nothing has changed.
    skipped: bool
    #: False if the output is identical to the input.
    changed: bool
    #: Size of the model file and the files that it references.
    input_bytes: int
    #: Total size of all written files.
    output_bytes: int
    #: Paths of all written files, the model first.
    output_files: List[str]
    #: Human-readable warnings.
    warnings: List[str]
    #: Offset that was subtracted from the coordinates of an OBJ, PLY or STL file and is the translation of the nodes;
    #: zeros: none.
    coordinate_offset: List[float]
    #: Sums over the primitives.
    totals: GenerateTotals
    #: With "--fix-winding", one entry per mesh with triangles; for OBJ one entry for the file.
    windings: List[MendedWinding]
    #: With "--flip-green", "--flip-green-all" or "--fix-maps", one entry per image that is a normal map; for OBJ one
    #: entry per material whose height map was converted to a normal map.
    normal_maps: List[JudgedMap]
    #: With "--convert-maps", one entry for each normal map and the primitives that share it.
    converted_maps: List[ConvertedMap]
    #: One entry per primitive, in file order.
    primitives: List[GeneratedPrimitive]
    #: Exit code of the tool: 0, or 1 if there is a finding.
    exit_code: int


class GenerateTotals(Report):
    #: Primitives in the file.
    primitives: int
    #: Primitive counts by action.
    actions: ActionCounts
    #: Triangles of the primitives that were computed.
    triangles: int
    #: Vertices of these primitives in the input; shared vertices are counted once.
    vertices_before: int
    #: Vertices after splitting.
    vertices_after: int
    #: Corners whose tangents were repaired.
    mended: int
    #: Morph targets whose tangent deltas were computed.
    morph_deltas: int
    #: Primitives whose frames are packed ("--pack").
    packed: int


class MendedWinding(Report):
    #: Index of the mesh; for OBJ, whose objects are one surface, 0.
    mesh: int
    #: May be empty.
    mesh_name: str
    #: Faces with at least 3 corners; faces that several primitives draw are counted once.
    faces: int
    #: Faces that were flipped.
    turned: int
    #: Pairs of neighboring faces that traverse their common edge in the same direction.
    conflicts_before: int
    #: Conflicting edges afterwards.
    conflicts_after: int
    #: Components connected by edges.
    components: int
    #: Components with more than half of their faces flipped.
    turned_components: int
    #: Components oriented by the normals of the file.
    by_normals: int
    #: Closed components, oriented by their volume.
    by_volume: int
    #: Closed components inside another one: oriented like most of their area or, if that is undecided, as a cavity.
    by_nesting: int
    #: Open components with an inside.
    by_winding_number: int
    #: Open components without an inside, oriented like most of their area.
    by_majority: int
    #: Components of fewer than 4 faces, which are unchanged.
    small: int
    #: Non-orientable components, such as a Moebius strip, which are unchanged.
    one_sided: int


class JudgedMap(Report):
    #: Index of the image in the input; for OBJ a running number.
    image: int
    #: Name or URI of the image; may be empty.
    name: str
    #: The green channel was inverted.
    flipped: bool
    #: The image was rewritten, because its encoding was not that of glTF, or because it was a height map.
    mended: bool
    #: Human-readable reason why the map is unchanged, or its former encoding; empty if only green was inverted.
    reason: str


class ConvertedMap(Report):
    #: Index of the image in the input.
    image: int
    #: Name or URI of the image; may be empty.
    name: str
    #: The primitives show a new map.
    converted: bool
    #: Human-readable reason why the primitives show no new map; empty if they do.
    reason: str
    #: Index of the new image in the output; null if there is none.
    new_image: Optional[int]
    #: Indices of the materials of the input that use the map.
    materials: List[int]
    #: Number of primitives that use the map.
    primitives: int
    #: Bits per channel of the new map; 0 if there is none.
    bits: int
    #: Number of texels that changed.
    changed: int
    #: Remaining error: mean angle between the shaded normals before and after, over the texels of the primitives.
    mean_error_deg: float
    #: Mean angle with the old map.
    mean_error_unconverted_deg: float
    #: Human-readable warnings.
    notes: List[str]


class GeneratedPrimitive(Report):
    #: Index of the mesh.
    mesh: int
    #: Index of the primitive in its mesh.
    primitive: int
    #: May be empty.
    mesh_name: str
    #: May be empty.
    material_name: str
    #: Action on the primitive's tangents, as in "totals.actions".
    action: str
    #: Human-readable reason.
    reason: str
    #: Further remarks: textures that need different tangents, texture transforms, repairs.
    notes: List[str]
    #: The n of the "TEXCOORD_n" that the tangents follow, or -1.
    uv_set: int
    #: Faces used to compute the tangents: "triangles" or "quads".
    faces: str
    #: Number of those faces that are quads, or polygons with more corners (OBJ).
    quads: int
    triangles: int
    vertices_before: int
    #: Vertices in the output; more than in the input if vertices were split.
    vertices_after: int
    #: With "--repair": vertices of "verticesBefore" whose tangents were repaired; all others are unchanged.
    mended_vertices: int
    #: Normals were computed, because the input had none or because recomputing them was requested.
    normals_generated: bool
    #: Existing normals were recomputed.
    normals_replaced: bool
    #: Positions whose normals were also computed from triangles of other primitives.
    normals_joined: int
    #: Corners whose new normal points to the back of their triangle.
    normals_behind: int
    #: Triangles whose winding is opposite to most of the connected triangles. Counted if normals were computed, or if
    #: vertices were split for at least one triangle in twenty; else 0, like "twoSidedTriangles".
    turned_triangles: int
    #: Triangles of two-sided sheets: other triangles have the same positions and the opposite winding.
    two_sided_triangles: int
    #: Faces that were flipped ("--fix-winding").
    winding_mended: int
    #: The flipped faces in ascending order: the first 256 ranges of triangles of the primitive; for OBJ, ranges of
    #: faces, numbered within the file.
    winding_mended_ranges: List[FaceRange]
    #: "_BITANGENT" was computed ("--bitangents").
    bitangents_generated: bool
    #: With "--pack": the frames are packed; if not, a note gives the reason.
    packed: bool
    #: Vertices whose frame was repaired before it was packed.
    packed_mended: int
    #: NORMAL was removed ("--pack-drop all").
    normals_dropped: bool
    #: TANGENT was removed ("--pack-drop").
    tangents_dropped: bool
    #: Number of morph targets of the primitive.
    morph_targets: int
    #: Morph targets whose tangent deltas were computed.
    morph_deltas: int
    #: Morph targets whose normal deltas were computed ("--morph-normals").
    morph_normals: int
    #: Corners, over all targets, whose frame changes its sign in the morphed shape, which glTF cannot express.
    morph_sign_flips: int
    #: Counts of generated normals; zeros if there are none. For OBJ, the first primitive with generated normals
    #: contains the counts of the whole file.
    normals: GeneratedNormals
    #: Zeros if nothing was computed.
    tangents: GeneratedTangents
    #: Corners that were repaired.
    sanitize: MendedTangents


class ActionCounts(Report):
    #: Tangents were added.
    generated: int
    #: Existing tangents were recomputed.
    replaced: int
    #: Tangents were recomputed and are bit-identical to those in the file.
    unchanged: int
    #: Existing tangents were kept.
    kept: int
    #: The material needs no tangents.
    not_needed: int
    #: Points or lines.
    not_triangles: int
    #: No UVs, no positions, or nothing to compute.
    impossible: int
    #: Tangents were removed, because no material needs them.
    removed: int


class FaceRange(Report):
    #: Number of the first face, from 0.
    first: int
    #: Number of consecutive triangles.
    count: int


class GeneratedNormals(Report):
    #: Faces with at least 3 corners.
    faces: int
    #: Faces without a face normal.
    degenerate_faces: int
    #: Corners whose weighted mean is zero.
    fallback_corners: int
    #: Position noise that --denoise removed: standard deviation in mean edge lengths; 0: none.
    noise: float
    #: Edges sharper than this are hard, in degrees; 180: no hard edges.
    crease_deg: float


class GeneratedTangents(Report):
    #: Triangles that tangents were computed on.
    triangles: int
    #: Triangles with two corners at the same position.
    degenerate_triangles: int
    #: Triangles without UV area.
    degenerate_uv_triangles: int
    #: Triangles with negative UV area in the stored values. This is the usual case in glTF, where V points down;
    #: "tspace inspect" reports mirrored triangles.
    negative_uv_triangles: int
    #: Faces for which nothing was computed.
    skipped_faces: int
    #: Sets of corners that share one tangent.
    groups: int
    #: Corners without a tangent from any face.
    default_corners: int
    #: Corners whose tangent was NaN or infinite before the repair.
    not_finite_corners: int
    #: The last step of the reference was skipped, because it would have taken quadratic time: when.
    reference_order_abandoned: bool


class MendedTangents(Report):
    #: Number of repaired corners.
    mended: int
    #: Corners by cause; the first applicable cause counts.
    causes: MendCauses
    #: Corners by kind of repair.
    cures: MendCures
    #: Corners whose normal is zero or not finite.
    bad_normals: int


class MendCauses(Report):
    #: NaN or infinity.
    not_finite: int
    #: Zero length.
    zero: int
    #: Length deviates from 1 by more than 0.0005.
    not_unit: int
    #: Within 1 degree of the normal or its opposite.
    parallel: int
    #: The default (1, 0, 0) of corners without UV area, if not perpendicular to the normal.
    placeholder: int
    #: Sign not +1 or -1.
    bad_sign: int
    #: Corners of one face have different signs.
    mixed_sign: int
    #: Valid, but changed by "--orthogonalize".
    orthogonalized: int


class MendCures(Report):
    #: The original direction, made unit and orthogonal.
    normalized: int
    #: Direction of a nearby valid corner.
    from_neighbor: int
    #: Tangents computed from the normal alone.
    from_basis: int
