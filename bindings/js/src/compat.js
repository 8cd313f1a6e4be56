// SPDX-License-Identifier: MIT
// The entry "tspace/compat": the call of npm's mikktspace, which glTF-Transform and three.js make.
import { generateTangents as generate, ready } from "./mikktspace.js";

export { ready };

/** What three.js asks before it calls. */
export let isReady = false;
ready.then(() => (isReady = true), () => {});

export const generateTangents = (positions, normals, uvs) =>
  generate({ positions, normals, uvs }, { convention: "opengl", pairing: "corrected" });
