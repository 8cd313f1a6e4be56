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
  /** Those of them whose tangents were examined. */
  primitivesWithTangents: number;
  /** Images that were looked at: what their channels hold. */
  normalMaps: number;
  /** Those of them whose relief says which way green points. */
  normalMapsWithGreen: number;
  /** What an image holds as a normal map that was checked without a model; null for a model. */
  image: CheckedImage | null;
  /** One entry for each format of packed frames of each primitive, in file order. */
  packedFrames: CheckedPackedFrames[];
  /** Findings by severity. */
  counts: FindingCounts;
  /** Errors first; among equals in file order. */
  findings: Finding[];
  /** That of the tool: 0, or 1 where something was found. */
  exitCode: 0 | 1;
}

export interface CheckedImage {
  width: number;
  height: number;
  /** "normals" in tangent space as glTF reads them, "twoChannels", "unsignedZ", "xInAlpha", "exchanged", "encoded" (sRGB),
   * "hemiOctahedral", "objectSpace", "height", "picture" or "constant". */
  content: string;
  /** Direction of green, or of y where that is in another channel, if x is right: "up", "down", "mixed" or "unknown". */
  green: string;
  /** How many blocks of texels agree beyond an even split, 0 to 1. */
  greenConfidence: number;
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
  /** The view of tspace render --show that shows it; empty: none does. */
  show: string;
  /** Commands that "remedy" names, in its order. */
  commands: RemedyCommand[];
}

export interface RemedyCommand {
  /** Name of the command: "generate", "convert-map", ... */
  verb: string;
  /** Files; empty: the model that was checked. */
  inputs: string[];
  /** In the order of the command line. */
  options: RemedyOption[];
  /** Words among inputs and values that the user replaces, such as "OUT.png". */
  placeholders: string[];
  /** The command line, as it stands in "remedy". */
  line: string;
}

export interface RemedyOption {
  /** Without dashes; "o": where the result goes. */
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
  /** What "generate" would take out of the coordinates of an OBJ, PLY or STL file far from the origin; zeros: nothing. */
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
  /** May be empty. */
  materialName: string;
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
  /** Sentences for a person about the file as a whole. */
  warnings: string[];
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
  /** Sentences for a person about the files, each behind the name of its file. */
  warnings: string[];
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
