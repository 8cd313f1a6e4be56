// SPDX-License-Identifier: MIT

/** Location of the module. */
export const source = new URL("./gltf.wasm", import.meta.url);
