// SPDX-License-Identifier: MIT
// Made by scripts/schema from docs/schema: the report of generate.

export interface GenerateReport {
  /** Path of the input. */
  input: string;
  /** Path of the output; empty when the input led to none. */
  output: string;
  /** The output was written. */
  ok: true;
  /** Null when ok. */
  error: null;
  /** Time for this file. */
  seconds: number;
  /** Nothing was done, because the manifest says that it was done before and nothing has changed. */
  skipped: boolean;
  /** False when the output is byte for byte the input. */
  changed: boolean;
  /** The model file and what it loads. */
  inputBytes: number;
  /** Everything that was written. */
  outputBytes: number;
  /** Paths of everything that was written, the model first. */
  outputFiles: string[];
  /** Sentences for a person. */
  warnings: string[];
  /** What was taken out of the coordinates of an OBJ, PLY or STL file, and is the translation of the nodes; zeros: nothing
   * was. */
  coordinateOffset: [number, number, number];
  /** Sums over the primitives. */
  totals: GenerateTotals;
  /** With "--mend-winding", one entry per mesh with triangles; from OBJ one for the file. */
  windings: MendedWinding[];
  /** With "--flip-green", "--flip-green-all" or "--mend-maps", one entry per image that is a normal map; from OBJ one for each
   * material whose height map became a normal map. */
  normalMaps: JudgedMap[];
  /** With "--convert-maps", one entry for each normal map and the primitives that share it. */
  convertedMaps: ConvertedMap[];
  /** One entry per primitive, in file order. */
  primitives: GeneratedPrimitive[];
  /** That of the tool: 0, or 1 where something was found. */
  exitCode: 0 | 1;
}

export interface GenerateTotals {
  /** Primitives in the file. */
  primitives: number;
  /** Primitives by what was done with them. */
  actions: ActionCounts;
  /** Triangles of the primitives that were computed. */
  triangles: number;
  /** Their vertices in the input; vertices that several of them share count once. */
  verticesBefore: number;
  /** The same after vertices were split. */
  verticesAfter: number;
  /** Corners whose tangents were mended. */
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
  /** Faces with at least 3 corners; what several primitives draw counts once. */
  faces: number;
  /** Faces that were turned. */
  turned: number;
  /** Pairs of neighbours that run through their edge in the same direction. */
  conflictsBefore: number;
  /** The same afterwards. */
  conflictsAfter: number;
  /** Parts that hang together over edges. */
  components: number;
  /** Those of which more than half of the faces were turned. */
  turnedComponents: number;
  /** Components whose outside the normals of the file decided. */
  byNormals: number;
  /** Closed ones: their volume did. */
  byVolume: number;
  /** Closed ones that lie in another: as they mostly were, or, where that said nothing, a cavity. */
  byNesting: number;
  /** Open ones with an inside. */
  byWindingNumber: number;
  /** Open ones without: as most of the area was wound. */
  byMajority: number;
  /** Components of fewer than 4 faces, which stay. */
  small: number;
  /** Components with one side only, as a Moebius band, which stay. */
  oneSided: number;
}

export interface JudgedMap {
  /** Index of the image in the input; for OBJ a running number. */
  image: number;
  /** Name or URI of the image; may be empty. */
  name: string;
  /** Its green channel was inverted. */
  flipped: boolean;
  /** It was written anew: it held something else than glTF reads, or heights. */
  mended: boolean;
  /** Why nothing was done, or what it held, for a person; empty where green alone was inverted. */
  reason: string;
}

export interface ConvertedMap {
  /** Index of the image in the input. */
  image: number;
  /** Name or URI of the image; may be empty. */
  name: string;
  /** These primitives show a new map. */
  converted: boolean;
  /** Why not, for a person; empty where they do. */
  reason: string;
  /** Index of the new image in the output; null where there is none. */
  newImage: number | null;
  /** Indices of the input's materials that show it. */
  materials: number[];
  /** How many primitives show it. */
  primitives: number;
  /** Of a channel of the new map; 0 where there is none. */
  bits: number;
  /** Texels that changed. */
  changed: number;
  /** What is left of the change: between what the primitives show after and before, in the mean over their texels. */
  meanErrorDeg: number;
  /** The same with the old map. */
  meanErrorUnconvertedDeg: number;
  /** Sentences for a person. */
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
  /** What was done with its tangents, as in "totals.actions". */
  action: "generated" | "replaced" | "unchanged" | "kept" | "notNeeded" | "notTriangles" | "impossible" | "removed";
  /** Why, for a person. */
  reason: string;
  /** Further sentences: textures that want other tangents, texture transforms, repairs. */
  notes: string[];
  /** The n of the "TEXCOORD_n" that the tangents follow, or -1. */
  uvSet: number;
  /** What its tangents were computed on: "triangles" or "quads". */
  faces: "triangles" | "quads";
  /** How many of those faces are quads, or polygons with more corners (OBJ). */
  quads: number;
  triangles: number;
  verticesBefore: number;
  /** More than before where vertices were split. */
  verticesAfter: number;
  /** "--repair": those of "verticesBefore" whose tangents were wrong; all others keep theirs. */
  mendedVertices: number;
  /** Normals were made: the input had none, or they were to be made anew. */
  normalsGenerated: boolean;
  /** It had normals, and they were made anew. */
  normalsReplaced: boolean;
  /** Positions at which its normals were made with triangles of other primitives too. */
  normalsJoined: number;
  /** Corners whose new normal points behind their own triangle. */
  normalsBehind: number;
  /** Triangles that are wound against most of those that they are connected with. Counted where normals were made, and where
   * vertices were split for one in twenty or more; else 0, as "twoSidedTriangles". */
  turnedTriangles: number;
  /** Triangles of sheets with two sides: others with the same positions are wound the other way. */
  twoSidedTriangles: number;
  /** Faces that were turned ("--mend-winding"). */
  windingMended: number;
  /** Which these are, in ascending order: the first 256 ranges of triangles of the primitive; from OBJ of faces, numbered
   * through the file. */
  windingMendedRanges: FaceRange[];
  /** "_BITANGENT" was computed ("--bitangents"). */
  bitangentsGenerated: boolean;
  /** "--pack": its frames are packed; where they are not, a note says why. */
  packed: boolean;
  /** Vertices whose frame was mended before it was packed. */
  packedMended: number;
  /** NORMAL was taken away ("--pack-drop all"). */
  normalsDropped: boolean;
  /** TANGENT was taken away ("--pack-drop"). */
  tangentsDropped: boolean;
  /** Morph targets that the primitive has. */
  morphTargets: number;
  /** Those whose tangent deltas were computed. */
  morphDeltas: number;
  /** Those whose normal deltas were computed ("--morph-normals"). */
  morphNormals: number;
  /** Corners, over all targets, whose frame in the moved shape has the other sign, which glTF cannot express. */
  morphSignFlips: number;
  /** About generated normals; zeros when there are none. For OBJ the counts cover the whole file and stand with the first
   * primitive that got normals. */
  normals: GeneratedNormals;
  /** Zeros where nothing was computed. */
  tangents: GeneratedTangents;
  /** Corners that were mended. */
  sanitize: MendedTangents;
}

export interface ActionCounts {
  /** Tangents were added. */
  generated: number;
  /** Tangents were there and were computed anew. */
  replaced: number;
  /** Computed anew with the same bits as those in the file. */
  unchanged: number;
  /** Tangents were there and stay. */
  kept: number;
  /** The material needs no tangents. */
  notNeeded: number;
  /** Points or lines. */
  notTriangles: number;
  /** No UVs, no positions, or nothing to compute. */
  impossible: number;
  /** No material needs the tangents, and they were taken away. */
  removed: number;
}

export interface FaceRange {
  /** Number of the first face, from 0. */
  first: number;
  /** How many follow one another. */
  count: number;
}

export interface GeneratedNormals {
  /** Faces with at least 3 corners. */
  faces: number;
  /** Faces without a normal of their own. */
  degenerateFaces: number;
  /** Corners whose mean vanished. */
  fallbackCorners: number;
  /** Noise of positions that --denoise removed, as a standard deviation in mean edge lengths; 0: none. */
  noise: number;
  /** Edges sharper than this are hard; 180: none is by its angle. */
  creaseDeg: number;
}

export interface GeneratedTangents {
  /** Triangles computed with. */
  triangles: number;
  /** Two corners at the same position. */
  degenerateTriangles: number;
  /** No UV area. */
  degenerateUvTriangles: number;
  /** Negative UV area in the numbers of the file. In glTF, where V runs down, that is the ordinary case; "tspace inspect" says
   * what is mirrored to the eye. */
  negativeUvTriangles: number;
  /** Faces for which nothing was computed. */
  skippedFaces: number;
  /** Sets of corners that share one tangent. */
  groups: number;
  /** Corners that no face gives a tangent. */
  defaultCorners: number;
  /** Corners whose tangent was NaN or infinite before mending. */
  notFiniteCorners: number;
  /** The last step of the reference was left out, because it would have taken quadratic time: when. */
  referenceOrderAbandoned: boolean;
}

export interface MendedTangents {
  /** All of them. */
  mended: number;
  /** By cause, the first that applies. */
  causes: MendCauses;
  /** By cure. */
  cures: MendCures;
  /** Corners whose normal is zero or not finite. */
  badNormals: number;
}

export interface MendCauses {
  /** NaN or infinity. */
  notFinite: number;
  /** No length. */
  zero: number;
  /** Length off by more than 0.0005. */
  notUnit: number;
  /** Within 1 degree of the normal or its opposite. */
  parallel: number;
  /** The (1, 0, 0) that corners without UV area get, out of the surface. */
  placeholder: number;
  /** Sign not +1 or -1. */
  badSign: number;
  /** Corners of one face disagreed about the sign. */
  mixedSign: number;
  /** Sound, but changed by "--orthogonalize". */
  orthogonalized: number;
}

export interface MendCures {
  /** Own direction, made unit and orthogonal. */
  normalized: number;
  /** Direction of a sound corner nearby. */
  fromNeighbor: number;
  /** Made from the normal alone. */
  fromBasis: number;
}
