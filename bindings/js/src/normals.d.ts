// SPDX-License-Identifier: MIT
import type { NormalOptions } from "./index.js";
import type { Convention, ConventionName, Mesh, NewFloat32Array, NewUint32Array, NewUint8Array, PositionNoise, WindingReport } from "./types.js";

export { conventions, TspaceError } from "./types.js";
export type * from "./types.js";
export type { NormalOptions } from "./index.js";

/** Resolves when the module is ready for calls. */
export const ready: Promise<void>;

/** Releases the module's memory. The next call starts with little memory. */
export function release(): void;

/** Like generateNormals of "tspace", with `denoise` and `creaseAngle: "auto"`. */
export function generateNormals(mesh: Mesh, options?: NormalOptions): NewFloat32Array;

/** Measures the noise of positions from samples. UVs and normals are ignored. */
export function measurePositionNoise(mesh: Mesh): PositionNoise;

export interface WindingOptions {
  /** true (the default): the mesh's normals, if consistent, define the outside. */
  useNormals?: boolean;
  /** true (the default): vertices at the same position are welded. false: only by index. */
  weldPositions?: boolean;
  /**
   * With weldPositions: positions that differ by at most this in each coordinate are welded. Default: 0. "auto":
   * derived from the spacing of floats.
   */
  weldDistance?: number | "auto";
  /**
   * Convention whose handedness and winding define the correct order of corners. Default: right-handed, counter-clockwise from
   * outside.
   */
  convention?: ConventionName | Convention;
}

/** Flips faces whose winding differs from their neighbors, and components that are inside out. UVs are ignored. */
export function fixWinding(mesh: Mesh, options?: WindingOptions): {
  /** The mesh's indices, reordered within flipped faces. */
  indices: NewUint32Array;
  /** One per face: 1 if it was flipped. */
  turned: NewUint8Array;
  report: WindingReport;
};

/** The former name of fixWinding. */
export const mendWinding: typeof fixWinding;
