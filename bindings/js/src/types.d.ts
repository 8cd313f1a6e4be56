// SPDX-License-Identifier: MIT
import type { SanitizeReport, TangentReport } from "./core_reports.js";

export type * from "./core_reports.js";

/** A mesh: arrays of the caller, which are copied and never changed. */
export interface Mesh {
  /** Three numbers per vertex. */
  positions: Float32Array;
  /** Three numbers per vertex, used as given. Required by all tangent methods. */
  normals?: Float32Array | null;
  /** Two numbers per vertex. Required by all methods except `basis`. */
  uvs?: Float32Array | null;
  /** The vertex of each corner. Default: corner c uses vertex c. */
  indices?: Indices | null;
  /** The normal of each corner. Default: the normal of its vertex. */
  normalIndices?: Indices | null;
  /** The UV of each corner. Default: the UV of its vertex. */
  uvIndices?: Indices | null;
  /** Number of corners of each face. Default: triangles. Faces with fewer than 3 corners are ignored. */
  faceSizes?: Indices | null;
}

export type Indices = Uint32Array | Uint16Array | Uint8Array;

/** Arrays that calls return: from TypeScript 5.7 on `Float32Array<ArrayBuffer>`, whose buffers can be transferred. */
export type NewFloat32Array = ReturnType<typeof Float32Array.of>;
export type NewUint32Array = ReturnType<typeof Uint32Array.of>;
export type NewUint8Array = ReturnType<typeof Uint8Array.of>;

/** Meaning of the tangent sign, and the outside of a face. */
export interface Convention {
  /** Whether v = 0 is the bottom row of the image (up) or the top row (down). */
  vAxis: "up" | "down";
  /**
   * Direction of large green values in a normal map: toward the top row (up, the default), or toward the bottom row.
   */
  green?: "up" | "down";
  /** Whether signs are stored unchanged (the default) or negated. */
  storedSign?: "asIs" | "negated";
  handedness?: "right" | "left";
  /** Order of a face's vertices seen from outside. */
  winding?: "counterClockwise" | "clockwise";
}

export type ConventionName = "gltf" | "opengl" | "directx" | "unreal" | "unity" | "blender" | "godot";

/** Presets, keyed by the name of a format or an engine. */
export const conventions: Readonly<Record<ConventionName, Convention>>;

/** Outputs that the caller provides. */
export interface TangentOutputs {
  /**
   * One entry per corner: 1 if at least one face contributes to the corner, 0 if none does and the method's default was
   * written (`defaultCornerCount` of the report), and for corners of skipped faces.
   */
  hasTangent?: Uint8Array | null;
  /** Receives the counts of the report. */
  report?: Partial<TangentReport>;
}

export interface MikktspaceOptions extends TangentOutputs {
  method?: "mikktspace";
  /**
   * Convention of the tangents: a preset's name, or an object. There is no default, because a wrong convention inverts
   * all signs.
   */
  convention: ConventionName | Convention;
  /**
   * Degrees from 0 to 180: tangents of faces that differ by this or more are not averaged. A value above 180, up to 360,
   * has the effect of 360 minus the value. Default: 180.
   */
  threshold?: number;
  /** `reference` (the default): with the reference's defect in its last bucket of edges. `corrected`: without it. */
  pairing?: "reference" | "corrected";
  /**
   * `triangulate` splits faces with five or more corners, and is the default of "tspace"; `skip` gives them zeros, like
   * the reference, and is the only choice of "tspace/mikktspace".
   */
  ngons?: "triangulate" | "skip";
  /**
   * true: normals whose length differs from 1 by more than 0.00674 are normalized first. false (the default): they are
   * used as given.
   */
  normalizeNormals?: boolean;
}

export interface SanitizeOptions {
  /** Also make every valid tangent unit and orthogonal to its normal. */
  orthogonalizeAll?: boolean;
  report?: Partial<SanitizeReport>;
}

export interface CornerAttribute {
  /** `size` numbers per corner. */
  data: Float32Array;
  /** 1 to 16. */
  size: number;
  /** 0 (the default): corners are equal only if all bits are equal. Otherwise: maximum difference of each number. */
  tolerance?: number;
}

export interface Split {
  /** The new vertex of each corner. */
  indices: NewUint32Array;
  /**
   * The old vertex that each new one copies: old vertices keep their positions, copies are appended. Use it to gather
   * other attributes.
   */
  sourceVertices: NewUint32Array;
  /** A corner whose values each new vertex has; 4294967295 if no corner uses it. */
  sourceCorners: NewUint32Array;
}

/**
 * Error of a failed call. The module can be used afterwards. Errors for wrong types and unknown options are also
 * instances of TypeError.
 */
export class TspaceError extends Error {
  /**
   * Stable: wrongType, detached, notReady, or one of the library: nullData, countMismatch, indexOutOfRange, tooLarge,
   * missingAttribute, invalidOption, outOfMemory, planMismatch, internal, cancelled.
   */
  readonly code: string;
  /** Index of the offending element, where there is one. */
  readonly element?: number;
}

/** Resolves when the module is loaded, which every call requires. */
export const ready: Promise<void>;

/** Frees the module's memory and invalidates all plans. The next call starts with little memory. */
export function release(): void;

/**
 * Repairs tangents that contain NaN or infinity, are zero, do not have unit length, are parallel to N, are placeholders,
 * have a sign that is not +-1, or have different signs within a face. Valid tangents keep every bit. Needs positions and normals.
 * @param tangents four numbers per corner
 * @returns a repaired copy
 */
export function sanitizeTangents(mesh: Mesh, tangents: Float32Array, options?: SanitizeOptions): NewFloat32Array;

/** Splits vertices whose corners differ in any attribute. */
export function splitVertices(vertices: { indices?: Indices | null; vertexCount: number }, attributes: CornerAttribute[]): Split;
