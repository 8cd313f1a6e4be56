// SPDX-License-Identifier: MIT
import { readFile } from "node:fs/promises";

/** The bytes of a file of this package. */
export const load = (url) => readFile(url);
