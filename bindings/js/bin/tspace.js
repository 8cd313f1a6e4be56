#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Command line of tspace: the native tool's sources, compiled to WebAssembly. This thread handles signals; main() runs
// in another thread.
import { readFileSync } from "node:fs";
import { constants } from "node:os";
import { fileURLToPath } from "node:url";
import { setFlagsFromString } from "node:v8";
import { toolWord } from "./paths.js";
import { mostPages } from "./system.js";
import { instanceOf, newTable, programEnd } from "./threads.js";

// The MCP server starts this program for each tool call, and serve() does not return.
if (process.argv[2] === "mcp") await (await import("./mcp.js")).serve(process.argv.slice(3));

// A command calls few of the functions, so they are validated and compiled on first use.
setFlagsFromString("--wasm-lazy-compilation");
setFlagsFromString("--wasm-lazy-validation");
// Recompile functions with optimization only after about 10 ms of run time. Node 20 does this after a tenth of that
// time, which costs more than it gains for models with less than millions of triangles. The default of node 22 is
// 13,000,000.
setFlagsFromString("--wasm-tiering-budget=20000000");
const here = (name) => fileURLToPath(new URL(name, import.meta.url));
const module = new WebAssembly.Module(readFileSync(here("tspace.wasm")));
const memory = newMemory();
const table = newTable();

function newMemory() {
  try {
    return new WebAssembly.Memory({ initial: 256, maximum: mostPages, shared: true });
  } catch (error) {
    // The engine reserves more than 4 GB of address space, which ulimit -v may prevent.
    process.stderr.write(`tspace: ${error.message}\n`);
    process.exit(5);
  }
}

/** Ends the process with an exit code, or with the signal that the code represents. */
function leave(code) {
  const signal = Object.entries(constants.signals).find(([, number]) => number + 128 === code)?.[0];
  if (signal) {
    process.removeAllListeners(signal);
    process.kill(process.pid, signal);
  }
  process.exit(code);
}

/** Returns the signals that the parent process has set to be ignored (nohup). */
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
