// SPDX-License-Identifier: MIT
// The entry "tspace/inline": the complete core with its module embedded, for any environment.
import { source } from "./core-inside.js";
import { start } from "./core.js";

export { generateNormals, generateTangents, generateTangentsOfMeshes, makeIndexedFrames, memoryBytes, Plan, planBuffers, release, sanitizeTangents, splitVertices, triangulate } from "./core.js";
export { conventions } from "./convention.js";
export { TspaceError } from "./error.js";
export const ready = start(source);
