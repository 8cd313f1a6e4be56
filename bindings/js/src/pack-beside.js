// SPDX-License-Identifier: MIT

/** Where the module lies. */
export const source = new URL("./pack.wasm", import.meta.url);
