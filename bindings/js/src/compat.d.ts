// SPDX-License-Identifier: MIT

export const ready: Promise<void>;
export const isReady: boolean;

/**
 * The call of npm's mikktspace: unindexed triangles in, four numbers per vertex out. The sign is the one for v upwards; callers
 * turn it over for glTF. The pairing is the corrected one, as there: bit for bit what three.js r187 gives.
 */
export function generateTangents(positions: Float32Array, normals: Float32Array, uvs: Float32Array): Float32Array;
