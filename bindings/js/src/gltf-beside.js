// SPDX-License-Identifier: MIT

/** Where the module lies. */
export const source = new URL("./gltf.wasm", import.meta.url);
