// SPDX-License-Identifier: MIT

/** Location of the module. */
export const source = new URL("./textures.wasm", import.meta.url);
