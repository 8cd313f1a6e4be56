// SPDX-License-Identifier: MIT
import type {
  Convention, ConventionName, Indices, Mesh, MikktspaceOptions, NewFloat32Array, NewUint32Array, NormalReport, SanitizeReport, TangentOutputs, TangentReport,
  TspaceError,
} from "./types.js";

export { conventions, ready, release, sanitizeTangents, splitVertices, TspaceError } from "./types.js";
export type * from "./types.js";

export interface TangentOptions extends Omit<MikktspaceOptions, "method"> {
  /** Tangent method. Default: `mikktspace`, bit-identical to the reference. */
  method?: "mikktspace" | "lengyel" | "uniform" | "angle" | "area" | "flat" | "basis" | "fast" | "best";
  /** `symmetric`: T is the bisector of dP/du and the direction perpendicular to dP/dv. Not for mikktspace and basis. */
  frame?: "gramSchmidt" | "symmetric";
  /** Number of refinement steps of `best` after its fit. Default: 1. */
  refine?: 0 | 1 | 2;
}

/**
 * Computes the tangents of a mesh.
 * @returns four numbers per corner: the tangent and its sign, `B = sign * cross(N, T)`
 */
export function generateTangents(mesh: Mesh, options: TangentOptions): NewFloat32Array;

/** One mesh of a call for many meshes, with its own options. */
export interface MeshJob {
  mesh: Mesh;
  options: TangentOptions;
}

/**
 * Computes the tangents of many meshes, one after the other, in memory that the module reuses.
 * @returns one entry per job: the result of generateTangents, or the error that it throws. A failed job does not affect
 * the others.
 */
export function generateTangentsOfMeshes(jobs: readonly MeshJob[]): (NewFloat32Array | TspaceError | TypeError)[];

export interface NormalOptions {
  /** Weight of a face at a corner. Default: `angle`. */
  weighting?: "flat" | "uniform" | "area" | "angle" | "angleArea" | "max" | "best";
  /**
   * Degrees from 0 to 180: edges where face normals differ by more are hard. Default: 180. "auto" (only
   * "tspace/normals"): derived from the mesh.
   */
  creaseAngle?: number | "auto";
  /** One number per face: two faces are smoothed only if their numbers are equal and not 0. */
  smoothingGroups?: Indices | null;
  /** true: two faces are smoothed if their numbers share a bit. */
  smoothingGroupsAreMasks?: boolean;
  /** true (the default): vertices at the same position are welded. false: only by index. */
  weldPositions?: boolean;
  /**
   * With weldPositions: positions that differ by at most this in each coordinate are welded. Default: 0. "auto":
   * derived from the spacing of floats.
   */
  weldDistance?: number | "auto";
  /** Convention whose handedness and winding define the outside. Default: right-handed, counter-clockwise from outside. */
  convention?: ConventionName | Convention;
  /** Number of refinement steps of `best` after its fit. Default: 2. */
  refine?: 0 | 1 | 2;
  /**
   * Denoising for `best` on noisy positions, with larger neighborhoods; only in "tspace/normals". "auto": by the
   * measured noise, unless it looks like shape. A number from 0 (the default: off) to 4: factor of the measured noise,
   * even if it looks like shape.
   */
  denoise?: number | "auto";
  report?: Partial<NormalReport>;
}

/** Triangles of a polygon mesh. */
export interface Triangles {
  /** Three corners of the mesh (not vertices) per triangle, with the original winding. */
  corners: NewUint32Array;
  /** The original face of each triangle. */
  faces: NewUint32Array;
}

/**
 * Splits faces with 4 or more corners into triangles: quads along the diagonal that MikkTSpace chooses, which also
 * depends on `uvs` if given; n-gons by ear clipping. Faces with fewer than 3 corners are skipped. `normals` are
 * ignored, and `uvIndices` are rejected.
 * @example
 * const { corners } = triangulate(mesh);
 * const indices = corners.map((corner) => mesh.indices[corner]);
 */
export function triangulate(mesh: Mesh): Triangles;

/** Computes unit normals of a mesh from its positions, indices and face sizes: three numbers per corner. */
export function generateNormals(mesh: Mesh, options?: NormalOptions): NewFloat32Array;

/** Reports of the steps; null if a step was skipped. */
export interface IndexedFramesReport {
  normals: NormalReport | null;
  tangents: TangentReport;
  sanitize: SanitizeReport | null;
  /**
   * Given options without an effect, such as `refine` for `mikktspace`, or `normals.weighting` if no normals are
   * computed.
   */
  ignoredOptions?: string[];
}

export interface IndexedFramesOptions extends Omit<TangentOptions, keyof TangentOutputs> {
  /** Recompute existing normals; missing normals are always computed. */
  makeNormals?: boolean;
  /** Options of computed normals. */
  normals?: Omit<NormalOptions, "convention" | "report">;
  /** Repair invalid tangents. Default: true. */
  sanitize?: boolean;
  /** Also make every valid tangent unit and orthogonal to its normal. */
  orthogonalizeAll?: boolean;
  report?: Partial<IndexedFramesReport>;
}

/** Indexed mesh with the same faces as the input. */
export interface IndexedFrames {
  /** The new vertex of each corner. */
  indices: NewUint32Array;
  /** The entry of `positions` that each new vertex copies; use it to gather other attributes and morph targets. */
  sourceVertices: NewUint32Array;
  /** The first corner of each new vertex; 4294967295 if no corner uses it. */
  sourceCorners: NewUint32Array;
  /** Three numbers per new vertex. */
  normals: NewFloat32Array;
  /** Four numbers per new vertex. */
  tangents: NewFloat32Array;
  report: IndexedFramesReport;
}

/**
 * Computes missing normals, then tangents, repairs tangents, and splits vertices into an indexed mesh: the common case
 * in one call.
 */
export function makeIndexedFrames(mesh: Mesh, options: IndexedFramesOptions): IndexedFrames;

/**
 * Data of a mesh that does not change while it deforms. It uses the module's memory: call destroy, or rely on the
 * garbage collector.
 */
export class Plan {
  constructor(mesh: Mesh, options: Omit<TangentOptions, keyof TangentOutputs>);
  readonly vertexCount: number;
  readonly cornerCount: number;
  /** Memory of the plan in bytes. */
  readonly memoryBytes: number;
  /** Given options that the method does not use. */
  readonly ignoredOptions: readonly string[];
  /** Computes the tangents of a pose, four numbers per corner, like generateTangents with the groups of the plan. */
  evaluate(pose: { positions: Float32Array; normals: Float32Array }, options?: TangentOutputs): NewFloat32Array;
  destroy(): void;
}

export interface PlanBufferOptions {
  /**
   * The vertex of each corner in the arrays of a pose, such as `makeIndexedFrames(...).indices`. Default: those of the
   * plan's mesh.
   */
  indices?: Indices | null;
  /** The corner of each result, such as `makeIndexedFrames(...).sourceCorners`. Default: one result per corner. */
  sourceCorners?: Uint32Array | null;
  /** The plan's mesh: the shader then also computes normals. Default: normals are an input of each pose. */
  mesh?: Mesh | null;
  /** Options of the normals of `mesh`: any weighting except `best`, without `denoise`. */
  normals?: Omit<NormalOptions, "report">;
}

/** A plan as 32-bit words for compute shaders. The arrays are views of `words`; see docs/guides/gpu.md. */
export interface PlanBuffers {
  /** A header of 12 words, then results, entries and triangles. */
  readonly words: NewUint32Array;
  /** Three words per result: first entry, number of entries with flags, own corner. */
  readonly results: NewUint32Array;
  /** Corners of triangles in the order of summation, with flags. */
  readonly entries: NewUint32Array;
  /** Three vertices, then UV coefficients as bits of floats: 5 words per triangle, or 7 for `lengyel`. */
  readonly triangles: NewUint32Array;
  readonly resultCount: number;
  readonly triangleCount: number;
  /** True if the shader computes normals from positions. */
  readonly makesNormals: boolean;
}

/** Exports a plan as arrays, with which a compute shader evaluates each pose on a GPU: see "tspace/webgpu". */
export function planBuffers(plan: Plan, options?: PlanBufferOptions): PlanBuffers;

/**
 * Returns the memory of the module in bytes: it grows to the size that the largest call and all plans need, and is 0
 * after release().
 */
export function memoryBytes(): number;
