// SPDX-License-Identifier: MIT
// The entry "tspace/compat": the function of npm's mikktspace that glTF-Transform and three.js call.
import { generateTangents as generate, ready, release } from "./mikktspace.js";

export { ready, release };

/** three.js checks this before it calls generateTangents. */
export let isReady = false;
ready.then(() => (isReady = true), () => {});

/** npm's mikktspace accepts arrays of any number type, and objects like { length: 1, 0: 0.5 }. */
const floats = (array) => (typeof array === "object" && array?.length >= 0 && Number.isInteger(array.length) ? Float32Array.from(array) : array);

export const generateTangents = (positions, normals, uvs) =>
  generate({ positions: floats(positions), normals: floats(normals), uvs: floats(uvs) }, { convention: "opengl" });
