// SPDX-License-Identifier: MIT
import type { NewFloat32Array } from "./types.js";

export { ready, release } from "./types.js";
export const isReady: boolean;

/** Typed arrays are copied; other arrays are converted to Float32Array. */
export type NumberArray = ArrayLike<number>;

/**
 * The call of npm's mikktspace 1.1.1, with its bits: unindexed triangles in, four numbers per vertex out. The sign is the one for v
 * upwards; callers turn it over for glTF. (three.js's module has another pairing of edges: `tspace/three` has the bits of that.)
 */
export function generateTangents(positions: NumberArray, normals: NumberArray, uvs: NumberArray): NewFloat32Array;
