// SPDX-License-Identifier: MIT
// Fails if a WebAssembly module imports anything but these functions, and prints its size: node check_module.mjs FILE NAME...
import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { gzipSync } from "node:zlib";

const [file, ...known] = process.argv.slice(2), bytes = readFileSync(file);
const unknown = WebAssembly.Module.imports(new WebAssembly.Module(bytes)).map((i) => i.name).filter((name) => !known.includes(name));
if (unknown.length !== 0) throw new Error(`${file} imports ${unknown.join(", ")}`);
console.log(`${basename(file)}: ${bytes.length} bytes, ${gzipSync(bytes, { level: 9 }).length} gzipped`);
