// SPDX-License-Identifier: MIT
// Made by scripts/schema from docs/schema: reports of the entry "tspace/gltf".

export * from "./generate_report.js";

export interface CheckReport {
  /** Path of the input. */
  input: string;
  /** The file could be read; it may have findings. */
  ok: true;
  /** Null when ok. */
  error: null;
  /** "glb", "gltf", "obj", or the extension of an imported file such as "fbx"; of an image "png", "jpeg", "webp", "exr",
   * "ktx2", "dds" or "tga". */
  format: string;
  /** The program that wrote the file; may be empty. */
  generator: string;
  /** Primitives in the file. */
  primitives: number;
  /** Primitives whose tangents were examined. */
  primitivesWithTangents: number;
  /** Images whose channel contents were examined. */
  normalMaps: number;
  /** Images whose relief shows the direction of green. */
  normalMapsWithGreen: number;
  /** Content of an image that was checked as a normal map without a model; null for a model. */
  image: CheckedImage | null;
  /** One entry for each format of packed frames of each primitive, in file order. */
  packedFrames: CheckedPackedFrames[];
  /** Findings by severity. */
  counts: FindingCounts;
  /** Findings by severity, errors first, then in file order. */
  findings: Finding[];
  /** Exit code of the tool: 0, or 1 if there is a finding. */
  exitCode: 0 | 1;
}

export interface CheckedImage {
  width: number;
  height: number;
  /** "normals" in tangent space as glTF reads them, "twoChannels", "unsignedZ", "xInAlpha", "exchanged", "encoded" (sRGB),
   * "hemiOctahedral", "objectSpace", "height", "picture" or "constant". */
  content: string;
  /** Direction of green (or of the channel with y), assuming x is correct: "up", "down", "mixed" or "unknown". */
  green: string;
  /** Share of texel blocks that agree, beyond an even split, 0 to 1. */
  greenConfidence: number;
}

export interface CheckedPackedFrames {
  /** JSON pointer of the attribute. */
  place: string;
  /** Name of the attribute, such as "_FRAME32"; the first one if two attributes contain a frame. */
  attribute: string;
  /** Format name, such as "frame32". */
  format: string;
  /** Index of the mesh. */
  mesh: number;
  /** Index of the primitive in its mesh. */
  primitive: number;
  vertices: number;
  /** False: a finding "packedFramesUnreadable" gives the reason. */
  readable: boolean;
  /** NORMAL and TANGENT exist; if not, angles and signs here are 0. */
  compared: boolean;
  /** The largest angle between N as decoded and NORMAL. */
  worstNormalDegrees: number;
  /** Largest angle between T as decoded and TANGENT, made orthogonal to NORMAL if necessary. */
  worstTangentDegrees: number;
  /** Error bound that the format guarantees. */
  promisedNormalDegrees: number;
  promisedTangentDegrees: number;
  /** Vertices whose sign differs from TANGENT. */
  differingSigns: number;
}

export interface FindingCounts {
  error: number;
  warning: number;
  note: number;
}

export interface Finding {
  /** Stable code of the finding. */
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
  /** Counted unit: "vertices", "triangles", "targets" (of a morph), "blocks" or "texels" (of an image), "images", "textures",
   * "attributes", "primitives", "meshes" or "files". */
  unit: "vertices" | "triangles" | "targets" | "blocks" | "texels" | "images" | "textures" | "attributes" | "primitives" | "meshes" | "files";
  /** Number of elements that have the fault. */
  count: number;
  /** Number of candidates. */
  total: number;
  /** Share of the primitive's surface that is affected, 0 to 1; 0 if not applicable. */
  surfaceShare: number;
  /** The largest angle, for findings about angles; else 0. */
  worstDegrees: number;
  /** 0 to 1; below 1 for statistical findings. */
  confidence: number;
  /** The first affected vertices. */
  vertices: number[];
  /** The fault, in a sentence that is the same for all findings of the code. */
  summary: string;
  /** The visible symptom, in a sentence that is the same for all findings of the code. */
  effect: string;
  /** Human-readable summary in one sentence. */
  message: string;
  /** Human-readable fix. */
  remedy: string;
  /** View of "tspace render --show" that makes it visible; empty: none. */
  show: string;
  /** Commands that "remedy" names, in its order. */
  commands: RemedyCommand[];
}

export interface RemedyCommand {
  /** Name of the command: "generate", "convert-map", ... */
  verb: string;
  /** Files; empty: the model that was checked. */
  inputs: string[];
  /** Options in the order of the command line. */
  options: RemedyOption[];
  /** Words among inputs and values that the user replaces, such as "OUT.png". */
  placeholders: string[];
  /** Command line, as in "remedy". */
  line: string;
}

export interface RemedyOption {
  /** Name without dashes; "o" is the output. */
  name: string;
  /** Empty: the option is a flag. */
  value: string;
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
  /** The model file and the files that it loads, without images. */
  fileBytes: number;
  /** For OBJ: objects and groups with faces. */
  meshes: number;
  /** For OBJ: materials that faces use and an MTL file defines. */
  materials: number;
  nodes: number;
  animations: number;
  images: number;
  extensionsUsed: string[];
  extensionsRequired: string[];
  /** Names of KHR_materials_variants. */
  variants: string[];
  /** Human-readable warnings about the file as a whole: data that were ignored or repaired while reading. */
  warnings: string[];
  /** Offset that "generate" would subtract from the coordinates of an OBJ, PLY or STL file far from the origin; zeros: none.
   * */
  coordinateOffset: [number, number, number];
  /** One entry per primitive, in file order. */
  primitives: InspectedPrimitive[];
  /** Exit code of the tool: 0, or 1 if there is a finding. */
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
  /** Number of triangles after triangulation of polygons. */
  triangles: number;
  vertices: number;
  indexType: "u8" | "u16" | "u32" | "none";
  compression: "none" | "meshopt" | "draco";
  /** Attribute and type, such as "POSITION float3". */
  attributes: string[];
  uvSets: number;
  morphTargets: number;
  skinned: boolean;
  hasNormals: boolean;
  hasTangents: boolean;
  /** "hasTangents" is false, but the file may have tangents that the importer cannot read. */
  tangentsNotRead: boolean;
  /** Names of the formats of packed frames in the primitive, such as "frame32". */
  packedFrames: string[];
  /** The material needs tangents. */
  needsTangents: boolean;
  /** User of the tangents: "normalTexture", "clearcoatNormalTexture", "anisotropy", or empty. */
  neededBy: "normalTexture" | "clearcoatNormalTexture" | "anisotropy" | "";
  /** The textures of its materials that need tangents; the tangents follow the first one. */
  tangentUses: TangentUse[];
  /** Materials that KHR_materials_variants can assign to it. */
  variantMaterials: number;
  /** Nodes that draw its mesh. */
  nodes: number;
  /** Number of times it is drawn; EXT_mesh_gpu_instancing counts each instance. */
  instances: number;
  /** The n of the "TEXCOORD_n" that tangents would follow, or -1. */
  uvSet: number;
  /** Triangles without UV area in that set. */
  degenerateUvTriangles: number;
  /** Triangles with two corners at one position. */
  degenerateTriangles: number;
  /** Noise of the positions: standard deviation along the normal, in mean edge lengths; 0: less than 0.03, or fewer than 1,000
   * triangles, or not enough memory to measure it. */
  positionNoise: number;
  /** Triangles that show the texture mirrored. */
  mirroredTriangles: number;
  /** Connected components of the UV map. */
  uvIslands: number;
  /** UV islands whose area is mostly mirrored. */
  mirroredUvIslands: number;
}

export interface TangentUse {
  /** User of the tangents. */
  neededBy: "normalTexture" | "clearcoatNormalTexture" | "anisotropy";
  /** JSON pointer; empty for OBJ. */
  place: string;
  /** Index of the material. */
  material: number;
  /** May be empty. */
  materialName: string;
  /** The material is one of KHR_materials_variants, not the primitive's own. */
  onlyInVariant: boolean;
  /** The n of "TEXCOORD_n". */
  uvSet: number;
  /** Offset of KHR_texture_transform. */
  uvOffset: [number, number];
  /** Rotation in radians. */
  uvRotation: number;
  /** Scale of the transform. */
  uvScale: [number, number];
  /** Tangents made for the first texture fit this one too. */
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
  /** Human-readable warnings about the file as a whole. */
  warnings: string[];
  /** Human-readable summary of two or three sentences. */
  verdict: string;
  /** Over all primitives, along the texture's UV set, the best method first. */
  explanations: Explanation[];
  /** In file order. */
  primitives: IdentifiedPrimitive[];
  /** Exit code of the tool: 0, or 1 if there is a finding. */
  exitCode: 0 | 1;
}

export interface Explanation {
  /** Name of the method. */
  method: string;
  /** "quads" where pairs of triangles explain clearly more (mikktspace only), else "triangles". */
  faces: "triangles" | "quads";
  /** N of the "TEXCOORD_n" that was used; -1 over several primitives. */
  uvSet: number;
  /** It is the UV set that the texture uses. */
  isTexturesSet: boolean;
  /** The UVs were used as rotated or mirrored by KHR_texture_transform. */
  isTransformed: boolean;
  /** Corners compared. */
  corners: number;
  /** Corners of triangles without UV area, which are ignored. */
  undecidedCorners: number;
  /** Compared corners within the tolerance of the method's tangent. */
  near: number;
  /** Compared corners that are within the tolerance at some corner of their vertex. */
  nearAtVertex: number;
  /** Mean angle to the method's tangent. */
  meanDeg: number;
  /** Corners whose sign is that of glTF. */
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
  /** Index of the primitive in its mesh. */
  primitive: number;
  /** May be empty. */
  meshName: string;
  /** May be empty. */
  materialName: string;
  /** Reason why it was not examined; empty: it was examined. */
  skipped: string;
  /** Every method along every UV set that has an area, the best first. */
  explanations: Explanation[];
}

/** Differences between the frames of two models: diff. */
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
  /** Tolerance of the run. */
  toleranceDeg: number;
  /** No angle exceeds the tolerance, no sign differs, every triangle has a match. */
  isWithinTolerance: boolean;
  /** Pairs of corners that were examined. */
  corners: number;
  /** Pairs whose signs differ. */
  signChanges: number;
  /** Triangles of both files without a match. */
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
  /** Human-readable warnings, each preceded by the name of its file. */
  warnings: string[];
  /** Corners with the largest differences, the largest angle first. */
  worst: FrameDifference[];
  /** Primitives of A in file order, then primitives of B without a match. */
  primitives: DiffedPrimitive[];
  /** Exit code of the tool: 0, or 1 if there is a finding. */
  exitCode: 0 | 1;
}

export interface AngleStatistics {
  /** Pairs of corners with a direction in both. */
  corners: number;
  /** Pairs in which one vector has no direction (zero or not finite). */
  unusable: number;
  meanDeg: number;
  /** Median. */
  medianDeg: number;
  /** 95th percentile. */
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
  /** Location in A. */
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
  /** How the two were matched. */
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
  /** Index of the primitive in its mesh. */
  primitive: number;
  triangles: number;
  hasTangents: boolean;
  /** "hasTangents" is false, but the file may have tangents that the importer cannot read. */
  tangentsNotRead: boolean;
  hasNormals: boolean;
}
