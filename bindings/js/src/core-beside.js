// SPDX-License-Identifier: MIT

/** Location of the module. */
export const source = new URL("./core.wasm", import.meta.url);
