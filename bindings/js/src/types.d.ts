// SPDX-License-Identifier: MIT

/** A mesh: arrays of the caller, which are copied and never changed. */
export interface Mesh {
  /** Three numbers per vertex. */
  positions: Float32Array;
  /** Three numbers per vertex, used as given. All methods but those of normals need them. */
  normals?: Float32Array | null;
  /** Two numbers per vertex. All methods but `basis` need them. */
  uvs?: Float32Array | null;
  /** The vertex of each corner; without them corner c uses vertex c. */
  indices?: Indices | null;
  /** The normal of each corner; without them that of its vertex. */
  normalIndices?: Indices | null;
  /** The UV of each corner; without them that of its vertex. */
  uvIndices?: Indices | null;
  /** Corners of each face; without them all faces are triangles. Faces of fewer than 3 corners are ignored. */
  faceSizes?: Indices | null;
}

export type Indices = Uint32Array | Uint16Array | Uint8Array;

/** Arrays that calls make: from TypeScript 5.7 on `Float32Array<ArrayBuffer>`, whose buffers can be transferred. */
export type NewFloat32Array = ReturnType<typeof Float32Array.of>;
export type NewUint32Array = ReturnType<typeof Uint32Array.of>;
export type NewUint8Array = ReturnType<typeof Uint8Array.of>;

/** What the sign of a tangent means and which side of a face is out. */
export interface Convention {
  /** Whether v = 0 is the bottom row of the image (up) or the top row (down). */
  vAxis: "up" | "down";
  /** What a large green value in a normal map means: towards the top row (up, the default), or the bottom row. */
  green?: "up" | "down";
  /** Whether signs are stored as they are (the default) or negated. */
  storedSign?: "asIs" | "negated";
  handedness?: "right" | "left";
  /** Order of a face's vertices as seen from outside. */
  winding?: "counterClockwise" | "clockwise";
}

export type ConventionName = "gltf" | "opengl" | "directx" | "unreal" | "unity" | "blender" | "godot";

/** Presets by the name of a format or an engine. */
export const conventions: Readonly<Record<ConventionName, Convention>>;

export interface TangentReport {
  /** Triangles computed with, after cutting quads and n-gons. */
  triangleCount: number;
  /** Two corners at the same position. */
  degenerateTriangleCount: number;
  /** Triangles without UV area: they take their neighbours' frame. */
  degenerateUvCount: number;
  /** Triangles with negative UV area. */
  mirroredCount: number;
  /** Faces for which nothing was computed. */
  skippedFaceCount: number;
  /** Sets of corners that share one tangent. */
  groupCount: number;
  /** Corners that no face gives a tangent: the method's default. */
  defaultCornerCount: number;
  /** Tangents with a NaN or infinity. */
  notFiniteCount: number;
  /** 1: the input drives the reference itself into quadratic time, so its last step was left out. */
  referenceOrderAbandoned: number;
  /** Options that were given and that the method does not read, such as `refine` for `mikktspace`. */
  ignoredOptions?: string[];
}

/** Outputs that the caller provides. */
export interface TangentOutputs {
  /**
   * One entry per corner: 1 where at least one face gives the corner a tangent, 0 where none does and the method's default was
   * written (`defaultCornerCount` of the report), and at corners of skipped faces.
   */
  hasTangent?: Uint8Array | null;
  /** Gets counts of what was met. */
  report?: Partial<TangentReport>;
}

export interface MikktspaceOptions extends TangentOutputs {
  method?: "mikktspace";
  /** What the tangents are for: a preset's name, or each part of it. There is no default: a wrong one turns every sign over. */
  convention: ConventionName | Convention;
  /** Degrees from 0 to 360, 180 unless given: faces whose tangents differ by this or more are not averaged. */
  threshold?: number;
  /** `reference` (the default): with the reference's defect in its last bucket of edges. `corrected`: without. */
  pairing?: "reference" | "corrected";
  /**
   * `triangulate` cuts faces of five corners and more, and is the default of "tspace"; `skip` gives them zeros, as the reference
   * does, and is all that "tspace/mikktspace" has.
   */
  ngons?: "triangulate" | "skip";
  /** true: normals whose length is further from 1 than 0.00674 are scaled to length 1 first. false (the default): they are used as given. */
  normalizeNormals?: boolean;
}

export interface SanitizeReport {
  notFiniteCount: number;
  zeroCount: number;
  notUnitCount: number;
  parallelCount: number;
  placeholderCount: number;
  badSignCount: number;
  mixedSignCount: number;
  orthogonalizedCount: number;
  normalizedCount: number;
  fromNeighborCount: number;
  fromBasisCount: number;
  badNormalCount: number;
  /** All corners that were written. */
  mendedCount: number;
}

export interface SanitizeOptions {
  /** Also make every sound tangent unit and orthogonal to its normal. */
  orthogonalizeAll?: boolean;
  report?: Partial<SanitizeReport>;
}

export interface CornerAttribute {
  /** `size` numbers per corner. */
  data: Float32Array;
  /** 1 to 16. */
  size: number;
  /** 0 (the default): corners are equal only when all bits are. Else how much each number may differ. */
  tolerance?: number;
}

export interface Split {
  /** The new vertex of each corner. */
  indices: NewUint32Array;
  /** The old vertex that each new one copies: old ones keep their place, copies come after them. Gather every attribute through it. */
  sourceVertices: NewUint32Array;
  /** The corner whose values belong to each new vertex; 4294967295 for one that no corner uses. */
  sourceCorners: NewUint32Array;
}

/** Why a call failed. The module can be used afterwards. Wrong types, and options that do not exist, are instances of TypeError too. */
export class TspaceError extends Error {
  /**
   * Stable: wrongType, detached, notReady, or one of the library: nullData, countMismatch, indexOutOfRange, tooLarge,
   * missingAttribute, invalidOption, outOfMemory, planMismatch, internal, cancelled.
   */
  readonly code: string;
  /** Index of the offending element, where there is one. */
  readonly element?: number;
}

/** Settles when the module is loaded; every call needs that. */
export const ready: Promise<void>;

/** Gives the module's memory back, and ends all plans. The next call starts with little memory. */
export function release(): void;

/**
 * Mends tangents: those that are not finite, zero, not unit, parallel to N, placeholders, or whose sign is not +-1 or differs
 * inside a face. Sound ones keep every bit. Needs positions and normals.
 * @param tangents four numbers per corner
 * @returns a copy, mended
 */
export function sanitizeTangents(mesh: Mesh, tangents: Float32Array, options?: SanitizeOptions): NewFloat32Array;

/** Splits vertices whose corners disagree in any of the attributes. */
export function splitVertices(vertices: { indices?: Indices | null; vertexCount: number }, attributes: CornerAttribute[]): Split;
