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
    #: Nothing was done, because the manifest says that it was done before and nothing has changed.
    skipped: bool
    #: False when the output is byte for byte the input.
    changed: bool
    #: The model file and the files that it loads.
    input_bytes: int
    #: All written files.
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
    #: With "--fix-winding", one entry per mesh with triangles; from OBJ one for the file.
    windings: List[MendedWinding]
    #: With "--flip-green", "--flip-green-all" or "--fix-maps", one entry per image that is a normal map; from OBJ one
    #: for each material whose height map became a normal map.
    normal_maps: List[JudgedMap]
    #: With "--convert-maps", one entry for each normal map and the primitives that share it.
    converted_maps: List[ConvertedMap]
    #: One entry per primitive, in file order.
    primitives: List[GeneratedPrimitive]
    #: That of the tool: 0, or 1 where something was found.
    exit_code: int


class GenerateTotals(Report):
    #: Primitives in the file.
    primitives: int
    #: Primitive counts by action.
    actions: ActionCounts
    #: Triangles of the primitives that were computed.
    triangles: int
    #: Their vertices in the input; vertices that several of them share count once.
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
    #: Faces with at least 3 corners; faces that several primitives draw count once.
    faces: int
    #: Faces that were turned.
    turned: int
    #: Neighboring faces that traverse their common edge in the same direction.
    conflicts_before: int
    #: Conflicting edges afterwards.
    conflicts_after: int
    #: Components connected by edges.
    components: int
    #: Components with more than half of their faces turned.
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
    #: Its green channel was inverted.
    flipped: bool
    #: It was rewritten: its encoding was not that of glTF, or it was a height map.
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
    #: Human-readable reason; empty where they do.
    reason: str
    #: Index of the new image in the output; null where there is none.
    new_image: Optional[int]
    #: Indices of the input's materials that use it.
    materials: List[int]
    #: Number of primitives that use it.
    primitives: int
    #: Bits per channel of the new map; 0 if there is none.
    bits: int
    #: Texels that changed.
    changed: int
    #: Remaining error: mean angle between the shaded normals before and after, over the texels of the primitives.
    mean_error_deg: float
    #: That error with the old map.
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
    #: What was done with its tangents, as in "totals.actions".
    action: str
    #: Human-readable reason.
    reason: str
    #: Further remarks: textures that need different tangents, texture transforms, repairs.
    notes: List[str]
    #: The n of the "TEXCOORD_n" that the tangents follow, or -1.
    uv_set: int
    #: Faces that its tangents were computed on: "triangles" or "quads".
    faces: str
    #: Number of those faces that are quads, or polygons with more corners (OBJ).
    quads: int
    triangles: int
    vertices_before: int
    #: Vertices in the output; more than in the input if vertices were split.
    vertices_after: int
    #: "--repair": vertices of "verticesBefore" whose tangents were wrong; all others keep theirs.
    mended_vertices: int
    #: Normals were computed: the input had none, or they were to be recomputed.
    normals_generated: bool
    #: It had normals, and they were recomputed.
    normals_replaced: bool
    #: Positions whose normals were also computed from triangles of other primitives.
    normals_joined: int
    #: Corners whose new normal points behind their own triangle.
    normals_behind: int
    #: Triangles whose winding is opposite to most of the connected triangles. Counted if normals were computed, or if
    #: vertices were split for at least one triangle in twenty; else 0, like "twoSidedTriangles".
    turned_triangles: int
    #: Triangles of two-sided sheets: other triangles have the same positions and the opposite winding.
    two_sided_triangles: int
    #: Faces that were turned ("--fix-winding").
    winding_mended: int
    #: Which these are, in ascending order: the first 256 ranges of triangles of the primitive; from OBJ of faces,
    #: numbered through the file.
    winding_mended_ranges: List[FaceRange]
    #: "_BITANGENT" was computed ("--bitangents").
    bitangents_generated: bool
    #: "--pack": its frames are packed; if they are not, a note gives the reason.
    packed: bool
    #: Vertices whose frame was repaired before it was packed.
    packed_mended: int
    #: NORMAL was removed ("--pack-drop all").
    normals_dropped: bool
    #: TANGENT was removed ("--pack-drop").
    tangents_dropped: bool
    #: Morph targets that the primitive has.
    morph_targets: int
    #: Morph targets whose tangent deltas were computed.
    morph_deltas: int
    #: Morph targets whose normal deltas were computed ("--morph-normals").
    morph_normals: int
    #: Corners, over all targets, whose frame changes its sign in the morphed shape, which glTF cannot express.
    morph_sign_flips: int
    #: About generated normals; zeros when there are none. For OBJ the counts cover the whole file and stand with the
    #: first primitive that got normals.
    normals: GeneratedNormals
    #: Zeros where nothing was computed.
    tangents: GeneratedTangents
    #: Corners that were repaired.
    sanitize: MendedTangents


class ActionCounts(Report):
    #: Tangents were added.
    generated: int
    #: Existing tangents were recomputed.
    replaced: int
    #: Computed anew with the same bits as those in the file.
    unchanged: int
    #: Existing tangents were kept.
    kept: int
    #: The material needs no tangents.
    not_needed: int
    #: Points or lines.
    not_triangles: int
    #: No UVs, no positions, or nothing to compute.
    impossible: int
    #: No material needs the tangents, and they were removed.
    removed: int


class FaceRange(Report):
    #: Number of the first face, from 0.
    first: int
    #: Number of consecutive triangles.
    count: int


class GeneratedNormals(Report):
    #: Faces with at least 3 corners.
    faces: int
    #: Faces without a normal of their own.
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
    #: Two corners at the same position.
    degenerate_triangles: int
    #: No UV area.
    degenerate_uv_triangles: int
    #: Negative UV area in the stored values. In glTF, where V runs down, that is the usual case; "tspace inspect"
    #: reports what looks mirrored.
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
    #: No length.
    zero: int
    #: Length off by more than 0.0005.
    not_unit: int
    #: Within 1 degree of the normal or its opposite.
    parallel: int
    #: The (1, 0, 0) that corners without UV area get, out of the surface.
    placeholder: int
    #: Sign not +1 or -1.
    bad_sign: int
    #: Corners of one face disagreed about the sign.
    mixed_sign: int
    #: Valid, but changed by "--orthogonalize".
    orthogonalized: int


class MendCures(Report):
    #: Own direction, made unit and orthogonal.
    normalized: int
    #: Direction of a sound corner nearby.
    from_neighbor: int
    #: Tangents computed from the normal alone.
    from_basis: int
