// SPDX-License-Identifier: MIT
import type { Mesh, MikktspaceOptions, NewFloat32Array } from "./types.js";

export { conventions, ready, release, sanitizeTangents, splitVertices, TspaceError } from "./types.js";
export type * from "./types.js";

/**
 * Computes tangents bit-identical to the MikkTSpace reference.
 * @returns four numbers per corner: the tangent and its sign, `B = sign * cross(N, T)`
 */
export function generateTangents(mesh: Mesh, options: MikktspaceOptions): NewFloat32Array;
