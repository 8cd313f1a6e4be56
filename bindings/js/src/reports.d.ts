// SPDX-License-Identifier: MIT
// Made by scripts/schema from docs/schema: reports of the entry "tspace/gltf".

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
  /** What was taken out of the coordinates of an OBJ, PLY, STL, COLLADA or FBX file, and is the translation of the nodes;
   * zeros: nothing was. */
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
  /** Their vertices in the input. */
  verticesBefore: number;
  /** Their vertices in the output. */
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

export interface CheckReport {
  /** Path of the input. */
  input: string;
  /** The file could be read; it may have findings. */
  ok: true;
  /** Null when ok. */
  error: null;
  /** "glb", "gltf", "obj", or the extension of an imported file such as "fbx". */
  format: string;
  /** The program that wrote the file; may be empty. */
  generator: string;
  /** Primitives in the file. */
  primitives: number;
  /** Those of them whose tangents were examined. */
  primitivesWithTangents: number;
  /** Images that were looked at: what their channels hold. */
  normalMaps: number;
  /** Those of them whose relief says which way green points. */
  normalMapsWithGreen: number;
  /** One entry for each format of packed frames of each primitive, in file order. */
  packedFrames: CheckedPackedFrames[];
  /** Findings by severity. */
  counts: FindingCounts;
  /** Errors first; among equals in file order. */
  findings: Finding[];
  /** That of the tool: 0, or 1 where something was found. */
  exitCode: 0 | 1;
}

export interface CheckedPackedFrames {
  /** JSON pointer of the attribute. */
  place: string;
  /** Its name, such as "_FRAME32"; of two that hold one frame the first. */
  attribute: string;
  /** Such as "frame32". */
  format: string;
  /** Index of the mesh. */
  mesh: number;
  /** Index of the primitive in its mesh. */
  primitive: number;
  vertices: number;
  /** False: a finding "packedFramesUnreadable" says why. */
  readable: boolean;
  /** NORMAL and TANGENT are there; if not, angles and signs here are 0. */
  compared: boolean;
  /** The largest angle between N as decoded and NORMAL. */
  worstNormalDegrees: number;
  /** The same of T and TANGENT, made orthogonal to NORMAL where it is not. */
  worstTangentDegrees: number;
  /** What the format promises. */
  promisedNormalDegrees: number;
  promisedTangentDegrees: number;
  /** Vertices with another sign than TANGENT. */
  differingSigns: number;
}

export interface FindingCounts {
  error: number;
  warning: number;
  note: number;
}

export interface Finding {
  /** Stable name of what was found. */
  code: string;
  severity: "error" | "warning" | "note";
  /** JSON pointer of the primitive, morph target, attribute or texture; for OBJ "usemtl NAME"; empty: the whole file. */
  place: string;
  /** Index of the mesh. */
  mesh: number;
  /** Index of the primitive in its mesh. */
  primitive: number;
  /** May be empty. */
  meshName: string;
  /** May be empty. */
  materialName: string;
  /** What is counted: "vertices", "triangles", "targets" (of a morph), "blocks" or "texels" (of an image), "images",
   * "textures", "attributes", "primitives", "meshes" or "files". */
  unit: "vertices" | "triangles" | "targets" | "blocks" | "texels" | "images" | "textures" | "attributes" | "primitives" | "meshes" | "files";
  /** How many have it. */
  count: number;
  /** Of how many that could have it. */
  total: number;
  /** Their part of the primitive's surface, 0 to 1; 0 where that says nothing. */
  surfaceShare: number;
  /** The largest angle, for findings about angles; else 0. */
  worstDegrees: number;
  /** 0 to 1; below 1 for findings that rest on statistics. */
  confidence: number;
  /** The first of them. */
  vertices: number[];
  /** One sentence for a person. */
  message: string;
  /** How to mend it, for a person. */
  remedy: string;
}

export interface InspectReport {
  /** Path of the input. */
  input: string;
  /** The file could be read. */
  ok: true;
  /** Null when ok. */
  error: null;
  /** "glb", "gltf", "obj", or the extension of an imported file such as "fbx". */
  format: string;
  /** The program that wrote the file; may be empty. */
  generator: string;
  /** The model file and what it loads, without images. */
  fileBytes: number;
  /** For OBJ: objects and groups with faces. */
  meshes: number;
  /** For OBJ: those that faces use and an MTL file has. */
  materials: number;
  nodes: number;
  animations: number;
  images: number;
  extensionsUsed: string[];
  extensionsRequired: string[];
  /** Names of KHR_materials_variants. */
  variants: string[];
  /** Sentences for a person about the file as a whole: what was left out or mended as it was read. */
  warnings: string[];
  /** What "generate" would take out of the coordinates of an OBJ, PLY, STL, COLLADA or FBX file far from the origin; zeros:
   * nothing. */
  coordinateOffset: [number, number, number];
  /** One entry per primitive, in file order. */
  primitives: InspectedPrimitive[];
  /** That of the tool: 0, or 1 where something was found. */
  exitCode: 0 | 1;
}

export interface InspectedPrimitive {
  /** Index of the mesh. */
  mesh: number;
  /** Index of the primitive in its mesh. */
  primitive: number;
  /** May be empty. */
  meshName: string;
  /** May be empty. */
  materialName: string;
  /** "triangles", "triangle strip", "points", ...; for OBJ also "polygons". */
  mode: string;
  /** After cutting polygons. */
  triangles: number;
  vertices: number;
  indexType: "u8" | "u16" | "u32" | "none";
  compression: "none" | "meshopt" | "draco";
  /** Such as "POSITION float3". */
  attributes: string[];
  uvSets: number;
  morphTargets: number;
  skinned: boolean;
  hasNormals: boolean;
  hasTangents: boolean;
  /** "hasTangents" is false, but the file may have some: the importer cannot give them. */
  tangentsNotRead: boolean;
  /** Names of the formats of packed frames that it has, such as "frame32". */
  packedFrames: string[];
  /** The material needs them. */
  needsTangents: boolean;
  /** What reads the tangents: "normalTexture", "clearcoatNormalTexture", "anisotropy", or empty. */
  neededBy: "normalTexture" | "clearcoatNormalTexture" | "anisotropy" | "";
  /** Everything in its materials that needs tangents; they follow the first. */
  tangentUses: TangentUse[];
  /** Materials that KHR_materials_variants can put on it. */
  variantMaterials: number;
  /** Nodes that draw its mesh. */
  nodes: number;
  /** How often they draw it; EXT_mesh_gpu_instancing counts each. */
  instances: number;
  /** The n of the "TEXCOORD_n" that tangents would follow, or -1. */
  uvSet: number;
  /** Triangles without UV area in that set. */
  degenerateUvTriangles: number;
  /** Triangles with two corners at one position. */
  degenerateTriangles: number;
  /** Random offsets of positions, as a standard deviation along the normal in mean edge lengths; 0: less than .03, or less
   * than 1,000 triangles, or no memory to measure. */
  positionNoise: number;
  /** Triangles that show the texture mirrored. */
  mirroredTriangles: number;
  /** Connected pieces of the UV map. */
  uvIslands: number;
  /** Those of which most of the area is mirrored. */
  mirroredUvIslands: number;
}

export interface TangentUse {
  /** What reads the tangents. */
  neededBy: "normalTexture" | "clearcoatNormalTexture" | "anisotropy";
  /** JSON pointer; empty for OBJ. */
  place: string;
  /** Index of the material. */
  material: number;
  /** The material is one of KHR_materials_variants, not the primitive's own. */
  onlyInVariant: boolean;
  /** The n of "TEXCOORD_n". */
  uvSet: number;
  /** Of KHR_texture_transform. */
  uvOffset: [number, number];
  /** Of the same, in radians. */
  uvRotation: number;
  /** Of the same. */
  uvScale: [number, number];
  /** Tangents made for the first entry fit this one too. */
  followsFirst: boolean;
}

export interface IdentifyReport {
  /** Path of the input. */
  input: string;
  /** The file could be read. */
  ok: true;
  /** Null when ok. */
  error: null;
  /** "glb", "gltf", "obj", or the extension of an imported file such as "fbx". */
  format: string;
  /** The program that wrote the file; may be empty. */
  generator: string;
  /** Two or three sentences for a person. */
  verdict: string;
  /** Over all primitives, along the texture's UV set, the best method first. */
  explanations: Explanation[];
  /** In file order. */
  primitives: IdentifiedPrimitive[];
  /** That of the tool: 0, or 1 where something was found. */
  exitCode: 0 | 1;
}

export interface Explanation {
  /** Name of the method. */
  method: string;
  /** "quads" where pairs of triangles explain clearly more (mikktspace only), else "triangles". */
  faces: "triangles" | "quads";
  /** The n of the "TEXCOORD_n" that was followed; -1 over several primitives. */
  uvSet: number;
  /** It is the set that the texture reads. */
  isTexturesSet: boolean;
  /** The UVs were taken as KHR_texture_transform turns or mirrors them. */
  isTransformed: boolean;
  /** Corners compared. */
  corners: number;
  /** Corners of triangles whose UVs have no area: they vote in nothing. */
  undecidedCorners: number;
  /** Of those, within the tolerance of the method's tangent. */
  near: number;
  /** Within the tolerance at some corner of the same vertex. */
  nearAtVertex: number;
  /** Mean angle to the method's tangent. */
  meanDeg: number;
  /** Corners whose sign is the one that glTF wants. */
  gltfSigns: number;
  /** Corners whose sign is the opposite. */
  invertedSigns: number;
  /** The signs of most corners. */
  signs: "gltf" | "inverted" | "mixed" | "none";
}

export interface IdentifiedPrimitive {
  /** JSON pointer, or "usemtl NAME" for OBJ. */
  place: string;
  mesh: number;
  /** Its index in the mesh. */
  primitive: number;
  /** May be empty. */
  meshName: string;
  /** May be empty. */
  materialName: string;
  /** Why it was not looked at; empty: it was. */
  skipped: string;
  /** Every method along every UV set that has an area, the best first. */
  explanations: Explanation[];
}

/** How the frames of two models differ: diff. */
export interface DiffReport {
  schema: "tspace.diff/1";
  /** Version of the tool. */
  version: string;
  /** Both files could be read. */
  ok: true;
  /** Path of the first file. */
  a: string;
  /** Path of the second file. */
  b: string;
  /** Null when ok. */
  error: null;
  /** The tolerance of the run. */
  toleranceDeg: number;
  /** No angle above the tolerance, no sign differs, every triangle has a partner. */
  isWithinTolerance: boolean;
  /** Pairs of corners that were looked at. */
  corners: number;
  /** Pairs whose signs differ. */
  signChanges: number;
  /** Triangles of both files without a partner. */
  unpairedTriangles: number;
  /** Primitives with tangents in one file only. */
  missingTangents: number;
  /** Upper ends of the bins of every histogram. */
  histogramUpperDeg: number[];
  /** Angles between T. */
  tangents: AngleStatistics;
  /** Angles between N. */
  normals: AngleStatistics;
  /** Angles between "sign * cross(N, T)". */
  bitangents: AngleStatistics;
  /** The worst places, the largest angle first. */
  worst: FrameDifference[];
  /** Those of A in file order, then those of B without a partner. */
  primitives: DiffedPrimitive[];
  /** That of the tool: 0, or 1 where something was found. */
  exitCode: 0 | 1;
}

export interface AngleStatistics {
  /** Pairs of corners with a direction in both. */
  corners: number;
  /** Pairs of which one has no direction (zero or not finite). */
  unusable: number;
  meanDeg: number;
  /** Half of the pairs differ by this or less. */
  medianDeg: number;
  /** 95 % of the pairs. */
  p95Deg: number;
  maxDeg: number;
  /** Pairs per bin, see "histogramUpperDeg". */
  histogram: number[];
}

export interface FrameDifference {
  meshA: number;
  primitiveA: number;
  vertexA: number;
  meshB: number;
  primitiveB: number;
  vertexB: number;
  /** Where, in A. */
  position: [number, number, number];
  tangentDeg: number;
  normalDeg: number;
  bitangentDeg: number;
  signDiffers: boolean;
}

export interface DiffedPrimitive {
  /** Null: only the other file has it. */
  a: DiffedSide | null;
  /** Null: only the other file has it. */
  b: DiffedSide | null;
  /** May be empty. */
  meshName: string;
  /** How the two were found to belong together. */
  pairedBy: "geometry" | "name" | "order" | "none";
  pairedTriangles: number;
  signChanges: number;
  /** Angles between T. */
  tangents: AngleStatistics;
  /** Angles between N. */
  normals: AngleStatistics;
  /** Angles between "sign * cross(N, T)". */
  bitangents: AngleStatistics;
}

export interface DiffedSide {
  /** JSON pointer, or "usemtl NAME" for OBJ. */
  place: string;
  mesh: number;
  /** Its index in the mesh. */
  primitive: number;
  triangles: number;
  hasTangents: boolean;
  /** "hasTangents" is false, but the file may have some: the importer cannot give them. */
  tangentsNotRead: boolean;
  hasNormals: boolean;
}
