// SPDX-License-Identifier: MIT
import type { NormalOptions } from "./index.js";
import type { Convention, ConventionName, Mesh, NewFloat32Array, NewUint32Array, NewUint8Array } from "./types.js";

export { conventions, TspaceError } from "./types.js";
export type * from "./types.js";
export type { NormalOptions, NormalReport } from "./index.js";

/** Resolves when calls can be made. */
export const ready: Promise<void>;

/** Gives the module's memory back. The next call starts with little memory. */
export function release(): void;

/** As that of "tspace", with `denoise` and `creaseAngle: "auto"`. */
export function generateNormals(mesh: Mesh, options?: NormalOptions): NewFloat32Array;

/** Lengths are parts of `meanEdge`. */
export interface PositionNoise {
  /** How far positions lie from a smooth surface through their neighbours: the standard deviation along the normal. */
  sigma: number;
  /** Of how normals differ along an edge, the part that no smooth surface has: the median, 0 to 1. */
  kinkShare: number;
  /** What of `sigma` is noise, and `denoise: "auto"` removes; 0: positions are not noisy. */
  noise: number;
  meanEdge: number;
}

/** How noisy positions are, by samples. UVs and normals are not looked at. */
export function measurePositionNoise(mesh: Mesh): PositionNoise;

export interface WindingOptions {
  /** true (the default): normals of the mesh, where it has some, say which side is out, if they agree among themselves. */
  useNormals?: boolean;
  /** true (the default): vertices at one position are one point. false: only equal indices are. */
  weldPositions?: boolean;
  /** With weldPositions: positions that differ by no more than this (0 unless given) in each coordinate are one. "auto": by the spacing of floats. */
  weldDistance?: number | "auto";
  /** Handedness and winding say which order of corners is right; counter-clockwise from outside, right-handed, unless given. */
  convention?: ConventionName | Convention;
}

/** A component is what hangs together over pairs of faces at edges; a conflict is a pair that runs through its edge the same way. */
export interface WindingReport {
  /** Faces with at least 3 corners. */
  faceCount: number;
  turnedCount: number;
  conflictCountBefore: number;
  conflictCountAfter: number;
  componentCount: number;
  /** Components of which more than half of the faces were turned. */
  turnedComponentCount: number;
  /** Components decided by normals of the mesh; so on, how the others were. */
  byNormalsCount: number;
  byVolumeCount: number;
  byNestingCount: number;
  byWindingNumberCount: number;
  byMajorityCount: number;
  /** Components of fewer than 4 faces, which are left alone. */
  smallCount: number;
  /** Components that have one side only, as a Moebius band, and are left alone. */
  oneSidedCount: number;
}

/** Turns faces that are wound against their neighbours, and parts that are inside out as a whole. UVs are not looked at. */
export function mendWinding(mesh: Mesh, options?: WindingOptions): {
  /** The mesh's own, in another order within faces that were turned. */
  indices: NewUint32Array;
  /** One per face: 1 where it was turned. */
  turned: NewUint8Array;
  report: WindingReport;
};
