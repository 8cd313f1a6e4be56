// SPDX-License-Identifier: MIT

/** Where the module lies. */
export const source = new URL("./mikktspace.wasm", import.meta.url);
