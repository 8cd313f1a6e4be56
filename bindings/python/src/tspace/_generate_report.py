# SPDX-License-Identifier: MIT
"""Made by scripts/schema from docs/schema: the report of generate, for type checkers and for people who read."""

from __future__ import annotations

from typing import List, Optional

from ._report import Report


class GenerateReport(Report):
    #: Path of the input.
    input: str
    #: Path of the output; empty when the input led to none.
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
    #: The model file and what it loads.
    input_bytes: int
    #: Everything that was written.
    output_bytes: int
    #: Paths of everything that was written, the model first.
    output_files: List[str]
    #: Sentences for a person.
    warnings: List[str]
    #: What was taken out of the coordinates of an OBJ, PLY or STL file, and is the translation of the nodes; zeros:
    #: nothing was.
    coordinate_offset: List[float]
    #: Sums over the primitives.
    totals: GenerateTotals
    #: With "--mend-winding", one entry per mesh with triangles; from OBJ one for the file.
    windings: List[MendedWinding]
    #: With "--flip-green", "--flip-green-all" or "--mend-maps", one entry per image that is a normal map; from OBJ one
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
    #: Primitives by what was done with them.
    actions: ActionCounts
    #: Triangles of the primitives that were computed.
    triangles: int
    #: Their vertices in the input; vertices that several of them share count once.
    vertices_before: int
    #: The same after vertices were split.
    vertices_after: int
    #: Corners whose tangents were mended.
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
    #: Faces with at least 3 corners; what several primitives draw counts once.
    faces: int
    #: Faces that were turned.
    turned: int
    #: Pairs of neighbours that run through their edge in the same direction.
    conflicts_before: int
    #: The same afterwards.
    conflicts_after: int
    #: Parts that hang together over edges.
    components: int
    #: Those of which more than half of the faces were turned.
    turned_components: int
    #: Components whose outside the normals of the file decided.
    by_normals: int
    #: Closed ones: their volume did.
    by_volume: int
    #: Closed ones that lie in another: as they mostly were, or, where that said nothing, a cavity.
    by_nesting: int
    #: Open ones with an inside.
    by_winding_number: int
    #: Open ones without: as most of the area was wound.
    by_majority: int
    #: Components of fewer than 4 faces, which stay.
    small: int
    #: Components with one side only, as a Moebius band, which stay.
    one_sided: int


class JudgedMap(Report):
    #: Index of the image in the input; for OBJ a running number.
    image: int
    #: Name or URI of the image; may be empty.
    name: str
    #: Its green channel was inverted.
    flipped: bool
    #: It was written anew: it held something else than glTF reads, or heights.
    mended: bool
    #: Why nothing was done, or what it held, for a person; empty where green alone was inverted.
    reason: str


class ConvertedMap(Report):
    #: Index of the image in the input.
    image: int
    #: Name or URI of the image; may be empty.
    name: str
    #: These primitives show a new map.
    converted: bool
    #: Why not, for a person; empty where they do.
    reason: str
    #: Index of the new image in the output; null where there is none.
    new_image: Optional[int]
    #: Indices of the input's materials that show it.
    materials: List[int]
    #: How many primitives show it.
    primitives: int
    #: Of a channel of the new map; 0 where there is none.
    bits: int
    #: Texels that changed.
    changed: int
    #: What is left of the change: between what the primitives show after and before, in the mean over their texels.
    mean_error_deg: float
    #: The same with the old map.
    mean_error_unconverted_deg: float
    #: Sentences for a person.
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
    #: Why, for a person.
    reason: str
    #: Further sentences: textures that want other tangents, texture transforms, repairs.
    notes: List[str]
    #: The n of the "TEXCOORD_n" that the tangents follow, or -1.
    uv_set: int
    #: What its tangents were computed on: "triangles" or "quads".
    faces: str
    #: How many of those faces are quads, or polygons with more corners (OBJ).
    quads: int
    triangles: int
    vertices_before: int
    #: More than before where vertices were split.
    vertices_after: int
    #: "--repair": those of "verticesBefore" whose tangents were wrong; all others keep theirs.
    mended_vertices: int
    #: Normals were made: the input had none, or they were to be made anew.
    normals_generated: bool
    #: It had normals, and they were made anew.
    normals_replaced: bool
    #: Positions at which its normals were made with triangles of other primitives too.
    normals_joined: int
    #: Corners whose new normal points behind their own triangle.
    normals_behind: int
    #: Triangles that are wound against most of those that they are connected with. Counted where normals were made,
    #: and where vertices were split for one in twenty or more; else 0, as "twoSidedTriangles".
    turned_triangles: int
    #: Triangles of sheets with two sides: others with the same positions are wound the other way.
    two_sided_triangles: int
    #: Faces that were turned ("--mend-winding").
    winding_mended: int
    #: Which these are, in ascending order: the first 256 ranges of triangles of the primitive; from OBJ of faces,
    #: numbered through the file.
    winding_mended_ranges: List[FaceRange]
    #: "_BITANGENT" was computed ("--bitangents").
    bitangents_generated: bool
    #: "--pack": its frames are packed; where they are not, a note says why.
    packed: bool
    #: Vertices whose frame was mended before it was packed.
    packed_mended: int
    #: NORMAL was taken away ("--pack-drop all").
    normals_dropped: bool
    #: TANGENT was taken away ("--pack-drop").
    tangents_dropped: bool
    #: Morph targets that the primitive has.
    morph_targets: int
    #: Those whose tangent deltas were computed.
    morph_deltas: int
    #: Those whose normal deltas were computed ("--morph-normals").
    morph_normals: int
    #: Corners, over all targets, whose frame in the moved shape has the other sign, which glTF cannot express.
    morph_sign_flips: int
    #: About generated normals; zeros when there are none. For OBJ the counts cover the whole file and stand with the
    #: first primitive that got normals.
    normals: GeneratedNormals
    #: Zeros where nothing was computed.
    tangents: GeneratedTangents
    #: Corners that were mended.
    sanitize: MendedTangents


class ActionCounts(Report):
    #: Tangents were added.
    generated: int
    #: Tangents were there and were computed anew.
    replaced: int
    #: Computed anew with the same bits as those in the file.
    unchanged: int
    #: Tangents were there and stay.
    kept: int
    #: The material needs no tangents.
    not_needed: int
    #: Points or lines.
    not_triangles: int
    #: No UVs, no positions, or nothing to compute.
    impossible: int
    #: No material needs the tangents, and they were taken away.
    removed: int


class FaceRange(Report):
    #: Number of the first face, from 0.
    first: int
    #: How many follow one another.
    count: int


class GeneratedNormals(Report):
    #: Faces with at least 3 corners.
    faces: int
    #: Faces without a normal of their own.
    degenerate_faces: int
    #: Corners whose mean vanished.
    fallback_corners: int
    #: Noise of positions that --denoise removed, as a standard deviation in mean edge lengths; 0: none.
    noise: float
    #: Edges sharper than this are hard; 180: none is by its angle.
    crease_deg: float


class GeneratedTangents(Report):
    #: Triangles computed with.
    triangles: int
    #: Two corners at the same position.
    degenerate_triangles: int
    #: No UV area.
    degenerate_uv_triangles: int
    #: Negative UV area in the numbers of the file. In glTF, where V runs down, that is the ordinary case; "tspace
    #: inspect" says what is mirrored to the eye.
    negative_uv_triangles: int
    #: Faces for which nothing was computed.
    skipped_faces: int
    #: Sets of corners that share one tangent.
    groups: int
    #: Corners that no face gives a tangent.
    default_corners: int
    #: Corners whose tangent was NaN or infinite before mending.
    not_finite_corners: int
    #: The last step of the reference was left out, because it would have taken quadratic time: when.
    reference_order_abandoned: bool


class MendedTangents(Report):
    #: All of them.
    mended: int
    #: By cause, the first that applies.
    causes: MendCauses
    #: By cure.
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
    #: Sound, but changed by "--orthogonalize".
    orthogonalized: int


class MendCures(Report):
    #: Own direction, made unit and orthogonal.
    normalized: int
    #: Direction of a sound corner nearby.
    from_neighbor: int
    #: Made from the normal alone.
    from_basis: int
