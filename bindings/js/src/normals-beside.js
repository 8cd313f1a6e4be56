// SPDX-License-Identifier: MIT

/** Location of the module. */
export const source = new URL("./normals.wasm", import.meta.url);
