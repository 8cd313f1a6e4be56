// SPDX-License-Identifier: MIT

/** Where the module lies. */
export const source = new URL("./textures.wasm", import.meta.url);
