// SPDX-License-Identifier: MIT
// Messages between the page and its worker.
import type { ModelFiles } from "../files.js";

export const methods = ["mikktspace", "best", "fast", "angle", "area", "uniform", "lengyel", "flat"] as const;
export type Method = (typeof methods)[number];
/** What stands right of the slider: frames by a method, or those of another file: the fixed one, or one to compare with. */
export type OtherFile = "mended" | "other";
export type Right = Method | OtherFile;
export const isFile = (right: Right): right is OtherFile => right === "mended" || right === "other";
export const nameOf = (right: Right): string => (right === "mended" ? "the fixed file" : right === "other" ? "the other file" : right);

/** The arrays of a primitive as its file has them. */
export interface Arrays {
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer> | null;
  /** As the normal map reads them: its set, through its transform. */
  uvs: Float32Array<ArrayBuffer> | null;
  tangents: Float32Array<ArrayBuffer> | null;
  indices: Uint32Array<ArrayBuffer> | null;
}

/** A UV map per corner: what the picture of it needs. */
export interface MapCorners {
  uvs: Float32Array<ArrayBuffer>;
  islands: Float32Array<ArrayBuffer>;
  islandCount: number;
  mirroredCount: number;
}

/** The same per corner, three corners a triangle, for the picture. */
export interface Corners {
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  uvs: Float32Array<ArrayBuffer> | null;
  tangents: Float32Array<ArrayBuffer> | null;
  /** Per corner: number of the UV island, and 1 where the triangle shows its texture mirrored, 0 where not, 0.5 without UV area. */
  islands: Float32Array<ArrayBuffer>;
  islandCount: number;
  mirroredCount: number;
  normalsMade: boolean;
}

/** Frames by a method or of another file, and how far those of the file are from them. */
export interface Frames {
  /** Four numbers per corner. */
  tangents: Float32Array<ArrayBuffer>;
  /** Two per corner: degrees between the tangents, -1 where there is nothing to compare; 1 where the signs differ. */
  errors: Float32Array<ArrayBuffer>;
  compared: number;
  meanDegrees: number;
  maxDegrees: number;
  wrongSigns: number;
}

export type Verb = "inspect" | "check" | "identify";

/** Compressed geometry, as the loader of three.js asks for it. */
export interface MeshoptAsk {
  count: number;
  size: number;
  source: Uint8Array<ArrayBuffer>;
  mode: string;
  filter?: string;
}
export interface DracoAsk {
  data: ArrayBuffer;
  /** `type`: the name of a typed array. */
  attributes: { name: string; id: number; type: string }[];
}
export interface DracoMesh {
  indices: Uint32Array;
  attributes: { name: string; size: number; values: Float32Array }[];
}

/** The first level of a KTX2 or DDS, from the top row down. */
export interface TexturePixels {
  width: number;
  height: number;
  rgba: Uint8ClampedArray<ArrayBuffer>;
}

/** How the channels of a normal map are read, as `tspace convert-map` names it. */
export interface MapReading {
  channels?: string;
  curve?: "srgb" | "linearised";
  flipRed?: boolean;
  flipGreen?: boolean;
}
/** Files that a normal map is converted to: their endings. */
export type MapTarget = "png" | "bc5.ktx2" | "eac-rg11.ktx2" | "bc5.dds";
export interface ConvertedMap {
  bytes: Uint8Array<ArrayBuffer>;
  width: number;
  height: number;
  /** Format of the pixels: "16 bits", "BC5". */
  format: string;
  /** Sentences of the engine: how channels were read, what packing changed. */
  notes: string[];
}

export interface Calls {
  report: { ask: { verb: Verb; model: ModelFiles }; answer: unknown };
  /** A normal map without a model: what `check` says of it, and the image as PNG, JPEG or WebP. */
  image: { ask: { model: ModelFiles }; answer: { report: unknown; image: Uint8Array<ArrayBuffer> } };
  convertMap: { ask: { name: string; file: Uint8Array<ArrayBuffer>; reading: MapReading; to: MapTarget }; answer: ConvertedMap };
  generate: { ask: { model: ModelFiles; options: Record<string, unknown> }; answer: { report: unknown; bytes: Uint8Array<ArrayBuffer> } };
  /** `part`: what it is called in later questions, or null. */
  corners: { ask: { part: number | null; arrays: Arrays }; answer: Corners };
  /** The map of other UVs for a part. */
  map: { ask: { arrays: Arrays }; answer: MapCorners };
  frames: { ask: { part: number; method: Method }; answer: Frames };
  /** Frames of the same part in another file: null where it has none, or has other triangles. */
  otherFrames: { ask: { part: number; arrays: Arrays }; answer: Frames | null };
  meshopt: { ask: MeshoptAsk; answer: Uint8Array<ArrayBuffer> };
  draco: { ask: DracoAsk; answer: DracoMesh };
  texture: { ask: { file: Uint8Array<ArrayBuffer> }; answer: TexturePixels };
  forget: { ask: Record<string, never>; answer: null };
}
export type Call = keyof Calls;

export type Question = { [K in Call]: { id: number; call: K; ask: Calls[K]["ask"] } }[Call];
export type Answer = { id: number; answer: unknown } | { id: number; code: string; message: string };
