// SPDX-License-Identifier: MIT

/** Location of the module. */
export const source = new URL("./pack.wasm", import.meta.url);
