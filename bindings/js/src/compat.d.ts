// SPDX-License-Identifier: MIT
import type { NewFloat32Array } from "./types.js";

export { ready, release } from "./types.js";
export const isReady: boolean;

/** Arrays and array-like objects are converted to Float32Array. */
export type NumberArray = ArrayLike<number>;

/**
 * Replaces the function of npm's mikktspace 1.1.1, with bit-identical results: takes unindexed triangles, returns four
 * numbers per vertex. The sign is for v pointing up; callers negate it for glTF. (three.js's module pairs edges
 * differently: `tspace/three` is bit-identical to that module.) For empty arrays it returns an empty array; the package
 * throws an error.
 */
export function generateTangents(positions: NumberArray, normals: NumberArray, uvs: NumberArray): NewFloat32Array;
