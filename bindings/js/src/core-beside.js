// SPDX-License-Identifier: MIT

/** Where the module lies. */
export const source = new URL("./core.wasm", import.meta.url);
