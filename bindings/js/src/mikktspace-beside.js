// SPDX-License-Identifier: MIT

/** Location of the module. */
export const source = new URL("./mikktspace.wasm", import.meta.url);
