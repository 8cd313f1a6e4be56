// SPDX-License-Identifier: MIT
// Made by scripts/schema from docs/schema: the report of generate.

export interface GenerateReport {
  /** Path of the input. */
  input: string;
  /** Path of the output; empty if there is none for this input. */
  output: string;
  /** The output was written. */
  ok: true;
  /** Null when ok. */
  error: null;
  /** Time for this file. */
  seconds: number;
  /** The file was skipped, because it was processed before according to the manifest, and nothing has changed. */
  skipped: boolean;
  /** False if the output is identical to the input. */
  changed: boolean;
  /** Size of the model file and the files that it references. */
  inputBytes: number;
  /** Total size of all written files. */
  outputBytes: number;
  /** Paths of all written files, the model first. */
  outputFiles: string[];
  /** Human-readable warnings. */
  warnings: string[];
  /** Offset that was subtracted from the coordinates of an OBJ, PLY or STL file and is the translation of the nodes; zeros:
   * none. */
  coordinateOffset: [number, number, number];
  /** Sums over the primitives. */
  totals: GenerateTotals;
  /** With "--fix-winding", one entry per mesh with triangles; for OBJ one entry for the file. */
  windings: MendedWinding[];
  /** With "--flip-green", "--flip-green-all" or "--fix-maps", one entry per image that is a normal map; for OBJ one entry per
   * material whose height map was converted to a normal map. */
  normalMaps: JudgedMap[];
  /** With "--convert-maps", one entry for each normal map and the primitives that share it. */
  convertedMaps: ConvertedMap[];
  /** One entry per primitive, in file order. */
  primitives: GeneratedPrimitive[];
  /** Exit code of the tool: 0, or 1 if there is a finding. */
  exitCode: 0 | 1;
}

export interface GenerateTotals {
  /** Primitives in the file. */
  primitives: number;
  /** Primitive counts by action. */
  actions: ActionCounts;
  /** Triangles of the primitives that were computed. */
  triangles: number;
  /** Vertices of these primitives in the input; shared vertices are counted once. */
  verticesBefore: number;
  /** Vertices after splitting. */
  verticesAfter: number;
  /** Corners whose tangents were repaired. */
  mended: number;
  /** Morph targets whose tangent deltas were computed. */
  morphDeltas: number;
  /** Primitives whose frames are packed ("--pack"). */
  packed: number;
}

export interface MendedWinding {
  /** Index of the mesh; for OBJ, whose objects are one surface, 0. */
  mesh: number;
  /** May be empty. */
  meshName: string;
  /** Faces with at least 3 corners; faces that several primitives draw are counted once. */
  faces: number;
  /** Faces that were flipped. */
  turned: number;
  /** Pairs of neighboring faces that traverse their common edge in the same direction. */
  conflictsBefore: number;
  /** Conflicting edges afterwards. */
  conflictsAfter: number;
  /** Components connected by edges. */
  components: number;
  /** Components with more than half of their faces flipped. */
  turnedComponents: number;
  /** Components oriented by the normals of the file. */
  byNormals: number;
  /** Closed components, oriented by their volume. */
  byVolume: number;
  /** Closed components inside another one: oriented like most of their area or, if that is undecided, as a cavity. */
  byNesting: number;
  /** Open components with an inside. */
  byWindingNumber: number;
  /** Open components without an inside, oriented like most of their area. */
  byMajority: number;
  /** Components of fewer than 4 faces, which are unchanged. */
  small: number;
  /** Non-orientable components, such as a Moebius strip, which are unchanged. */
  oneSided: number;
}

export interface JudgedMap {
  /** Index of the image in the input; for OBJ a running number. */
  image: number;
  /** Name or URI of the image; may be empty. */
  name: string;
  /** The green channel was inverted. */
  flipped: boolean;
  /** The image was rewritten, because its encoding was not that of glTF, or because it was a height map. */
  mended: boolean;
  /** Human-readable reason why the map is unchanged, or its former encoding; empty if only green was inverted. */
  reason: string;
}

export interface ConvertedMap {
  /** Index of the image in the input. */
  image: number;
  /** Name or URI of the image; may be empty. */
  name: string;
  /** The primitives show a new map. */
  converted: boolean;
  /** Human-readable reason why the primitives show no new map; empty if they do. */
  reason: string;
  /** Index of the new image in the output; null if there is none. */
  newImage: number | null;
  /** Indices of the materials of the input that use the map. */
  materials: number[];
  /** Number of primitives that use the map. */
  primitives: number;
  /** Bits per channel of the new map; 0 if there is none. */
  bits: number;
  /** Number of texels that changed. */
  changed: number;
  /** Remaining error: mean angle between the shaded normals before and after, over the texels of the primitives. */
  meanErrorDeg: number;
  /** Mean angle with the old map. */
  meanErrorUnconvertedDeg: number;
  /** Human-readable warnings. */
  notes: string[];
}

export interface GeneratedPrimitive {
  /** Index of the mesh. */
  mesh: number;
  /** Index of the primitive in its mesh. */
  primitive: number;
  /** May be empty. */
  meshName: string;
  /** May be empty. */
  materialName: string;
  /** Action on the primitive's tangents, as in "totals.actions". */
  action: "generated" | "replaced" | "unchanged" | "kept" | "notNeeded" | "notTriangles" | "impossible" | "removed";
  /** Human-readable reason. */
  reason: string;
  /** Further remarks: textures that need different tangents, texture transforms, repairs. */
  notes: string[];
  /** The n of the "TEXCOORD_n" that the tangents follow, or -1. */
  uvSet: number;
  /** Faces used to compute the tangents: "triangles" or "quads". */
  faces: "triangles" | "quads";
  /** Number of those faces that are quads, or polygons with more corners (OBJ). */
  quads: number;
  triangles: number;
  verticesBefore: number;
  /** Vertices in the output; more than in the input if vertices were split. */
  verticesAfter: number;
  /** With "--repair": vertices of "verticesBefore" whose tangents were repaired; all others are unchanged. */
  mendedVertices: number;
  /** Normals were computed, because the input had none or because recomputing them was requested. */
  normalsGenerated: boolean;
  /** Existing normals were recomputed. */
  normalsReplaced: boolean;
  /** Positions whose normals were also computed from triangles of other primitives. */
  normalsJoined: number;
  /** Corners whose new normal points to the back of their triangle. */
  normalsBehind: number;
  /** Triangles whose winding is opposite to most of the connected triangles. Counted if normals were computed, or if vertices
   * were split for at least one triangle in twenty; else 0, like "twoSidedTriangles". */
  turnedTriangles: number;
  /** Triangles of two-sided sheets: other triangles have the same positions and the opposite winding. */
  twoSidedTriangles: number;
  /** Faces that were flipped ("--fix-winding"). */
  windingMended: number;
  /** The flipped faces in ascending order: the first 256 ranges of triangles of the primitive; for OBJ, ranges of faces,
   * numbered within the file. */
  windingMendedRanges: FaceRange[];
  /** "_BITANGENT" was computed ("--bitangents"). */
  bitangentsGenerated: boolean;
  /** With "--pack": the frames are packed; if not, a note gives the reason. */
  packed: boolean;
  /** Vertices whose frame was repaired before it was packed. */
  packedMended: number;
  /** NORMAL was removed ("--pack-drop all"). */
  normalsDropped: boolean;
  /** TANGENT was removed ("--pack-drop"). */
  tangentsDropped: boolean;
  /** Number of morph targets of the primitive. */
  morphTargets: number;
  /** Morph targets whose tangent deltas were computed. */
  morphDeltas: number;
  /** Morph targets whose normal deltas were computed ("--morph-normals"). */
  morphNormals: number;
  /** Corners, over all targets, whose frame changes its sign in the morphed shape, which glTF cannot express. */
  morphSignFlips: number;
  /** Counts of generated normals; zeros if there are none. For OBJ, the first primitive with generated normals contains the
   * counts of the whole file. */
  normals: GeneratedNormals;
  /** Zeros if nothing was computed. */
  tangents: GeneratedTangents;
  /** Corners that were repaired. */
  sanitize: MendedTangents;
}

export interface ActionCounts {
  /** Tangents were added. */
  generated: number;
  /** Existing tangents were recomputed. */
  replaced: number;
  /** Tangents were recomputed and are bit-identical to those in the file. */
  unchanged: number;
  /** Existing tangents were kept. */
  kept: number;
  /** The material needs no tangents. */
  notNeeded: number;
  /** Points or lines. */
  notTriangles: number;
  /** No UVs, no positions, or nothing to compute. */
  impossible: number;
  /** Tangents were removed, because no material needs them. */
  removed: number;
}

export interface FaceRange {
  /** Number of the first face, from 0. */
  first: number;
  /** Number of consecutive triangles. */
  count: number;
}

export interface GeneratedNormals {
  /** Faces with at least 3 corners. */
  faces: number;
  /** Faces without a face normal. */
  degenerateFaces: number;
  /** Corners whose weighted mean is zero. */
  fallbackCorners: number;
  /** Position noise that --denoise removed: standard deviation in mean edge lengths; 0: none. */
  noise: number;
  /** Edges sharper than this are hard, in degrees; 180: no hard edges. */
  creaseDeg: number;
}

export interface GeneratedTangents {
  /** Triangles that tangents were computed on. */
  triangles: number;
  /** Triangles with two corners at the same position. */
  degenerateTriangles: number;
  /** Triangles without UV area. */
  degenerateUvTriangles: number;
  /** Triangles with negative UV area in the stored values. This is the usual case in glTF, where V points down; "tspace
   * inspect" reports mirrored triangles. */
  negativeUvTriangles: number;
  /** Faces for which nothing was computed. */
  skippedFaces: number;
  /** Sets of corners that share one tangent. */
  groups: number;
  /** Corners without a tangent from any face. */
  defaultCorners: number;
  /** Corners whose tangent was NaN or infinite before the repair. */
  notFiniteCorners: number;
  /** The last step of the reference was skipped, because it would have taken quadratic time: when. */
  referenceOrderAbandoned: boolean;
}

export interface MendedTangents {
  /** Number of repaired corners. */
  mended: number;
  /** Corners by cause; the first applicable cause counts. */
  causes: MendCauses;
  /** Corners by kind of repair. */
  cures: MendCures;
  /** Corners whose normal is zero or not finite. */
  badNormals: number;
}

export interface MendCauses {
  /** NaN or infinity. */
  notFinite: number;
  /** Zero length. */
  zero: number;
  /** Length deviates from 1 by more than 0.0005. */
  notUnit: number;
  /** Within 1 degree of the normal or its opposite. */
  parallel: number;
  /** The default (1, 0, 0) of corners without UV area, if not perpendicular to the normal. */
  placeholder: number;
  /** Sign not +1 or -1. */
  badSign: number;
  /** Corners of one face have different signs. */
  mixedSign: number;
  /** Valid, but changed by "--orthogonalize". */
  orthogonalized: number;
}

export interface MendCures {
  /** The original direction, made unit and orthogonal. */
  normalized: number;
  /** Direction of a nearby valid corner. */
  fromNeighbor: number;
  /** Tangents computed from the normal alone. */
  fromBasis: number;
}
