// SPDX-License-Identifier: MIT
// Messages between the page and its worker.
import type { ModelFiles } from "../files.js";

export const methods = ["mikktspace", "best", "fast", "angle", "area", "uniform", "lengyel", "flat"] as const;
export type Method = (typeof methods)[number];
/** What is shown right of the split line: frames computed by a method, the fixed file, or a file to compare with. */
export type OtherFile = "mended" | "other";
export type Right = Method | OtherFile;
export const isFile = (right: Right): right is OtherFile => right === "mended" || right === "other";
export const nameOf = (right: Right): string => (right === "mended" ? "the fixed file" : right === "other" ? "the other file" : right);

/** The arrays of a primitive, as in the file. */
export interface Arrays {
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer> | null;
  /** UVs of the normal map: its UV set, after its transform. */
  uvs: Float32Array<ArrayBuffer> | null;
  tangents: Float32Array<ArrayBuffer> | null;
  indices: Uint32Array<ArrayBuffer> | null;
}

/** A UV map, with data per corner. */
export interface MapCorners {
  uvs: Float32Array<ArrayBuffer>;
  islands: Float32Array<ArrayBuffer>;
  islandCount: number;
  mirroredCount: number;
}

/** Data per corner for the picture, three corners per triangle. */
export interface Corners {
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  uvs: Float32Array<ArrayBuffer> | null;
  tangents: Float32Array<ArrayBuffer> | null;
  /**
   * Per corner: index of the UV island, and 1 if the triangle shows its texture mirrored, 0 if not, 0.5 if it has no UV
   * area.
   */
  islands: Float32Array<ArrayBuffer>;
  islandCount: number;
  mirroredCount: number;
  normalsMade: boolean;
}

/** Frames by a method or from another file, and the deviation of the file's frames from them. */
export interface Frames {
  /** Four numbers per corner. */
  tangents: Float32Array<ArrayBuffer>;
  /**
   * Two numbers per corner: the angle between the tangents in degrees, -1 if they cannot be compared; and 1 if the
   * signs differ.
   */
  errors: Float32Array<ArrayBuffer>;
  compared: number;
  meanDegrees: number;
  maxDegrees: number;
  wrongSigns: number;
}

export type Verb = "inspect" | "check" | "identify";

/** Compressed geometry, as requested by the loader of three.js. */
export interface MeshoptAsk {
  count: number;
  size: number;
  source: Uint8Array<ArrayBuffer>;
  mode: string;
  filter?: string;
}
export interface DracoAsk {
  data: ArrayBuffer;
  /** `type`: name of a typed array. */
  attributes: { name: string; id: number; type: string }[];
}
export interface DracoMesh {
  indices: Uint32Array;
  attributes: { name: string; size: number; values: Float32Array }[];
}

/** The first level of a KTX2 or DDS, top row first. */
export interface TexturePixels {
  width: number;
  height: number;
  rgba: Uint8ClampedArray<ArrayBuffer>;
}

/** Encoding of a normal map, with the names of `tspace convert-map`. */
export interface MapReading {
  channels?: string;
  curve?: "srgb" | "linearized";
  flipRed?: boolean;
  flipGreen?: boolean;
}
/** Target formats of a normal map, by extension. */
export type MapTarget = "png" | "bc5.ktx2" | "eac-rg11.ktx2" | "bc5.dds";
export interface ConvertedMap {
  bytes: Uint8Array<ArrayBuffer>;
  width: number;
  height: number;
  /** Format of the pixels, such as "16 bits" or "BC5". */
  format: string;
  /** Notes of the engine: how channels were interpreted, and what packing changed. */
  notes: string[];
}

export interface Calls {
  report: { ask: { verb: Verb; model: ModelFiles }; answer: unknown };
  /** Checks a normal map without a model; returns the report, and the image as PNG, JPEG or WebP. */
  image: { ask: { model: ModelFiles }; answer: { report: unknown; image: Uint8Array<ArrayBuffer> } };
  convertMap: { ask: { name: string; file: Uint8Array<ArrayBuffer>; reading: MapReading; to: MapTarget }; answer: ConvertedMap };
  generate: { ask: { model: ModelFiles; options: Record<string, unknown> }; answer: { report: unknown; bytes: Uint8Array<ArrayBuffer> } };
  /** `part`: number for later calls, or null. */
  corners: { ask: { part: number | null; arrays: Arrays }; answer: Corners };
  /** Returns the UV map of a part with other UVs. */
  map: { ask: { arrays: Arrays }; answer: MapCorners };
  frames: { ask: { part: number; method: Method }; answer: Frames };
  /** Returns the frames of the same part in another file; null if it has none, or has other triangles. */
  otherFrames: { ask: { part: number; arrays: Arrays }; answer: Frames | null };
  meshopt: { ask: MeshoptAsk; answer: Uint8Array<ArrayBuffer> };
  draco: { ask: DracoAsk; answer: DracoMesh };
  texture: { ask: { file: Uint8Array<ArrayBuffer> }; answer: TexturePixels };
  forget: { ask: Record<string, never>; answer: null };
}
export type Call = keyof Calls;

export type Question = { [K in Call]: { id: number; call: K; ask: Calls[K]["ask"] } }[Call];
export type Answer = { id: number; answer: unknown } | { id: number; code: string; message: string };
