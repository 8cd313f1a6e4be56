// SPDX-License-Identifier: MIT
import type {
  Convention, ConventionName, Indices, Mesh, MikktspaceOptions, NewFloat32Array, NewUint32Array, SanitizeReport, TangentOutputs, TangentReport,
  TspaceError,
} from "./types.js";

export { conventions, ready, release, sanitizeTangents, splitVertices, TspaceError } from "./types.js";
export type * from "./types.js";

export interface TangentOptions extends Omit<MikktspaceOptions, "method"> {
  /** How tangents are computed; `mikktspace`, bit for bit as the reference, unless given. */
  method?: "mikktspace" | "lengyel" | "uniform" | "angle" | "area" | "flat" | "basis" | "fast" | "best";
  /** `symmetric`: T lies between dP/du and the direction across dP/dv. Not for mikktspace and basis. */
  frame?: "gramSchmidt" | "symmetric";
  /** 0, 1 (the default) or 2 steps after the fit of `best`. */
  refine?: 0 | 1 | 2;
}

/**
 * Tangents of a mesh.
 * @returns four numbers per corner: the tangent and its sign, `B = sign * cross(N, T)`
 */
export function generateTangents(mesh: Mesh, options: TangentOptions): NewFloat32Array;

/** One mesh of a call for many meshes, with its own options. */
export interface MeshJob {
  mesh: Mesh;
  options: TangentOptions;
}

/**
 * Tangents of many meshes, one mesh after the other, in memory that the module reuses.
 * @returns one entry per job: what generateTangents returns for it, or the error that it throws. A job that fails does not affect the others.
 */
export function generateTangentsOfMeshes(jobs: readonly MeshJob[]): (NewFloat32Array | TspaceError | TypeError)[];

export interface NormalReport {
  faceCount: number;
  /** Faces without a normal: zero area or not finite. */
  degenerateFaceCount: number;
  /** Corners whose mean vanished and that got a substitute. */
  fallbackCornerCount: number;
  /** Noise of positions that `denoise` removed: standard deviation in mean edge lengths; 0: none. */
  noise: number;
  /** The angle that edges were held against: as given, or what "auto" found. */
  creaseAngle: number;
  /** Options that were given and that the weighting does not read, such as `refine` for `angle`. */
  ignoredOptions?: string[];
}

export interface NormalOptions {
  /** How much a face counts at a corner; `angle` unless given. */
  weighting?: "flat" | "uniform" | "area" | "angle" | "angleArea" | "max" | "best";
  /** Degrees, 0 to 180, 180 unless given: edges whose faces differ by more are hard. "auto", an angle by the mesh: of "tspace/normals". */
  creaseAngle?: number | "auto";
  /** One number per face: faces are smooth together only when their numbers are equal and not 0. */
  smoothingGroups?: Indices | null;
  /** Or, with true, when they have a bit in common. */
  smoothingGroupsAreMasks?: boolean;
  /** true (the default): vertices at one position are one point. false: only equal indices are. */
  weldPositions?: boolean;
  /** With weldPositions: positions that differ by no more than this (0 unless given) in each coordinate are one. "auto": by the spacing of floats. */
  weldDistance?: number | "auto";
  /** Handedness and winding say which side is out; counter-clockwise from outside, right-handed, unless given. */
  convention?: ConventionName | Convention;
  /** 0, 1 or 2 (the default) steps after the fit of `best`. */
  refine?: 0 | 1 | 2;
  /**
   * Of "tspace/normals", for `best` on noisy positions: normals by more of the surface around. "auto": as much as is measured, and nothing where
   * that is shape; 0 (the default) to 4: so many times the noise that is measured, also where it looks like shape.
   */
  denoise?: number | "auto";
  report?: Partial<NormalReport>;
}

/** Triangles of a polygon mesh. */
export interface Triangles {
  /** Three corners of the mesh (not vertices) per triangle, winding kept. */
  corners: NewUint32Array;
  /** The face that each triangle was cut from. */
  faces: NewUint32Array;
}

/**
 * Cuts faces of 4 and more corners into triangles: quads along the diagonal that MikkTSpace takes, for which it looks at `uvs` too,
 * where they are given; n-gons by clipping ears. Faces of fewer than 3 corners give nothing. `normals` are not looked at, and
 * `uvIndices` are refused.
 * @example
 * const { corners } = triangulate(mesh);
 * const indices = corners.map((corner) => mesh.indices[corner]);
 */
export function triangulate(mesh: Mesh): Triangles;

/** Normals of a mesh, of which positions, indices and face sizes are used: three numbers per corner, unit. */
export function generateNormals(mesh: Mesh, options?: NormalOptions): NewFloat32Array;

/** What each step met; null: the step was left out. */
export interface IndexedFramesReport {
  normals: NormalReport | null;
  tangents: TangentReport;
  sanitize: SanitizeReport | null;
  /** Options that were given and have no effect, such as `refine` for `mikktspace` or `normals.weighting` where no normals are made. */
  ignoredOptions?: string[];
}

export interface IndexedFramesOptions extends Omit<TangentOptions, keyof TangentOutputs> {
  /** Make normals also where the mesh has them; where it has none they are made anyway. */
  makeNormals?: boolean;
  /** How normals are made. */
  normals?: Omit<NormalOptions, "convention" | "report">;
  /** Mend tangents that are broken; true unless given. */
  sanitize?: boolean;
  /** Also make every sound tangent unit and orthogonal to its normal. */
  orthogonalizeAll?: boolean;
  report?: Partial<IndexedFramesReport>;
}

/** A mesh with the faces of the given one. */
export interface IndexedFrames {
  /** The new vertex of each corner. */
  indices: NewUint32Array;
  /** The entry of `positions` that each new vertex copies. Gather every other attribute and morph target through it. */
  sourceVertices: NewUint32Array;
  /** The first corner of each new vertex; 4294967295 for one that no corner uses. */
  sourceCorners: NewUint32Array;
  /** Three numbers per new vertex. */
  normals: NewFloat32Array;
  /** Four numbers per new vertex. */
  tangents: NewFloat32Array;
  report: IndexedFramesReport;
}

/** The usual case in one call: normals where they are missing, tangents, mended and split into an indexed mesh. */
export function makeIndexedFrames(mesh: Mesh, options: IndexedFramesOptions): IndexedFrames;

/** What of a mesh stays while it deforms. It lies in the module's memory: destroy it, or leave that to the collector. */
export class Plan {
  constructor(mesh: Mesh, options: Omit<TangentOptions, keyof TangentOutputs>);
  readonly vertexCount: number;
  readonly cornerCount: number;
  /** Memory that the plan holds. */
  readonly memoryBytes: number;
  /** Options that were given and that the method does not read. */
  readonly ignoredOptions: readonly string[];
  /** The tangents of a pose, four numbers per corner: those that generateTangents gives for it, with the groups of the plan. */
  evaluate(pose: { positions: Float32Array; normals: Float32Array }, options?: TangentOutputs): NewFloat32Array;
  destroy(): void;
}

export interface PlanBufferOptions {
  /** The vertex of each corner in the arrays of a pose, as `makeIndexedFrames(...).indices`; unless given, those of the plan's mesh. */
  indices?: Indices | null;
  /** The corner of each result, as `makeIndexedFrames(...).sourceCorners`; unless given, there is one result per corner. */
  sourceCorners?: Uint32Array | null;
  /** The plan's mesh: the shader then computes normals too. Unless given, a pose brings its normals. */
  mesh?: Mesh | null;
  /** How the normals of `mesh` are computed: every weighting but `best`, without `denoise`. */
  normals?: Omit<NormalOptions, "report">;
}

/** A plan as 32-bit words for compute shaders. The arrays are views of `words`; docs/guides/gpu.md describes them. */
export interface PlanBuffers {
  /** A header of 12 words, then results, entries and triangles. */
  readonly words: NewUint32Array;
  /** Three words per result: the first entry, the count of entries with flags, the own corner. */
  readonly results: NewUint32Array;
  /** Corners of triangles in the order of summation, with flags. */
  readonly entries: NewUint32Array;
  /** Three vertices, then UV coefficients as bits of floats: 5 words per triangle, or 7 for `lengyel`. */
  readonly triangles: NewUint32Array;
  readonly resultCount: number;
  readonly triangleCount: number;
  /** Whether the shader computes normals from positions. */
  readonly makesNormals: boolean;
}

/** Writes a plan as arrays, from which a compute shader evaluates each pose on a GPU: see "tspace/webgpu". */
export function planBuffers(plan: Plan, options?: PlanBufferOptions): PlanBuffers;

/** Memory of the module in bytes: it grows to what the largest call and all plans need, and is 0 after release(). */
export function memoryBytes(): number;
