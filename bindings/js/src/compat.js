// SPDX-License-Identifier: MIT
// The entry "tspace/compat": the function of npm's mikktspace that glTF-Transform and three.js call.
import { generateTangents as generate, ready, release } from "./mikktspace.js";

export { ready, release };

/** three.js checks this before it calls generateTangents. */
export let isReady = false;
ready.then(() => (isReady = true), () => {});

/** npm's mikktspace accepts arrays of any number type. */
const floats = (array) => (Array.isArray(array) || ArrayBuffer.isView(array) ? Float32Array.from(array) : array);

export const generateTangents = (positions, normals, uvs) =>
  generate({ positions: floats(positions), normals: floats(normals), uvs: floats(uvs) }, { convention: "opengl" });
