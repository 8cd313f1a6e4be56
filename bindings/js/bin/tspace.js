#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// The command line of tspace: the native tool's sources, compiled to WebAssembly. This thread takes signals; main() runs in
// another one.
import { readFileSync } from "node:fs";
import { constants } from "node:os";
import { fileURLToPath } from "node:url";
import { setFlagsFromString } from "node:v8";
import { toolWord } from "./paths.js";
import { mostPages } from "./system.js";
import { instanceOf, newTable, programEnd } from "./threads.js";

// A server that runs this program for each call, and ends the process.
if (process.argv[2] === "mcp") await (await import("./mcp.js")).serve(process.argv.slice(3));

// A command calls few of the functions: they are looked at and compiled when they are called.
setFlagsFromString("--wasm-lazy-compilation");
setFlagsFromString("--wasm-lazy-validation");
// And again, to be faster, once they have run for long (10 ms or so): in node 20 they are after a tenth of that, which costs more
// than it gains for models of less than millions of triangles. Node 22 has 13,000,000 of its own.
setFlagsFromString("--wasm-tiering-budget=20000000");
const here = (name) => fileURLToPath(new URL(name, import.meta.url));
const module = new WebAssembly.Module(readFileSync(here("tspace.wasm")));
const memory = newMemory();
const table = newTable();

function newMemory() {
  try {
    return new WebAssembly.Memory({ initial: 256, maximum: mostPages, shared: true });
  } catch (error) {
    // The engine reserves more than 4 GB of address space, which ulimit -v may forbid.
    process.stderr.write(`tspace: ${error.message}\n`);
    process.exit(5);
  }
}

/** Ends the process with a code, or as the signal that it stands for. */
function leave(code) {
  const signal = Object.entries(constants.signals).find(([, number]) => number + 128 === code)?.[0];
  if (signal) {
    process.removeAllListeners(signal);
    process.kill(process.pid, signal);
  }
  process.exit(code);
}

/** Signals that whoever started this program asked to be ignored (nohup). */
function ignoredSignals() {
  try {
    return BigInt(`0x${readFileSync("/proc/self/status", "latin1").match(/^SigIgn:\s*([0-9a-f]+)/m)[1]}`);
  } catch {
    return 0n;
  }
}

const exports = instanceOf({ module, memory, table, program: here("tspace"), end: leave });
exports.__wasm_call_ctors();
const words = process.argv.slice(2).map((word) => (process.platform === "win32" ? toolWord(word) : word));
const texts = ["tspace", ...words].map((word) => Buffer.from(`${word}\0`));
const places = exports.malloc(4 * texts.length + texts.reduce((sum, text) => sum + text.length, 0)) >>> 0;
let at = places + 4 * texts.length;
texts.forEach((text, i) => {
  new DataView(memory.buffer).setUint32(places + 4 * i, at, true);
  new Uint8Array(memory.buffer).set(text, at);
  at += text.length;
});
exports.startMain(texts.length, places);

const ignored = ignoredSignals();
for (const signal of ["SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT"]) {
  const number = constants.signals[signal];
  if (number === undefined || (ignored >> BigInt(number - 1)) & 1n) continue;
  process.on(signal, () => exports.raise(number));
}
leave(await programEnd(table));
