// SPDX-License-Identifier: MIT
// The entry "tspace/compat": the call of npm's mikktspace, which glTF-Transform and three.js make.
import { generateTangents as generate, ready, release } from "./mikktspace.js";

export { ready, release };

/** What three.js asks before it calls. */
export let isReady = false;
ready.then(() => (isReady = true), () => {});

/** npm's mikktspace takes arrays of any numbers. */
const floats = (array) => (Array.isArray(array) || ArrayBuffer.isView(array) ? Float32Array.from(array) : array);

export const generateTangents = (positions, normals, uvs) =>
  generate({ positions: floats(positions), normals: floats(normals), uvs: floats(uvs) }, { convention: "opengl" });
