// SPDX-License-Identifier: MIT

/** Where the module lies. */
export const source = new URL("./normals.wasm", import.meta.url);
