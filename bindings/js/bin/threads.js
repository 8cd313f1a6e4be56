// SPDX-License-Identifier: MIT
// Threads of the tool as node workers with shared memory. A worker whose thread has ended waits for the next thread,
// because starting a worker takes 10 to 20 ms; idle workers are listed in a shared table.
import { writeSync } from "node:fs";
import { Worker } from "node:worker_threads";
import { systemOf } from "./system.js";

const ended = 0, code = 1, workerCount = 2, firstWorker = 4, wordsOfWorker = 8, mostWorkers = 1024;
/** States of a worker. The state is 0 until the worker gets its first thread. */
const idle = 1, taken = 2, ready = 3;

export const newTable = () => new Int32Array(new SharedArrayBuffer(4 * (firstWorker + wordsOfWorker * mostWorkers)));

/** Ends the program from any thread. */
export function endProgram(table, exitCode) {
  if (Atomics.compareExchange(table, ended, 0, 1) === 0) {
    Atomics.store(table, code, exitCode);
    Atomics.store(table, ended, 2);
    Atomics.notify(table, ended);
  }
  for (;;) Atomics.wait(table, firstWorker - 1, 0);
}

/** Resolves with the exit code when the program has ended. */
export async function programEnd(table) {
  for (let seen; (seen = Atomics.load(table, ended)) !== 2; ) await Atomics.waitAsync(table, ended, seen).value;
  return Atomics.load(table, code);
}

/** Reports a thread that ended with an engine exception: excessive recursion, or a defect. */
export function giveUp(table, error) {
  writeSync(2, `tspace: internal error: ${error?.message ?? error}\n`);
  endProgram(table, 5);
}

/** Creates an instance of the module for this thread. */
export function instanceOf({ module, memory, table, program, end }) {
  let instance;
  const imports = systemOf({ memory, program, exports: () => instance.exports });
  const startThread = (thread, stackEnd, start, argument) => {
    let worker = 0;
    const count = Atomics.load(table, workerCount);
    const at = (number) => firstWorker + wordsOfWorker * number;
    while (worker < count && Atomics.compareExchange(table, at(worker), idle, taken) !== idle) ++worker;
    const isNew = worker === count;
    if (isNew) {
      worker = Atomics.add(table, workerCount, 1);
      if (worker >= mostWorkers) return 6; // EAGAIN
    }
    [thread, stackEnd, start, argument].forEach((word, i) => Atomics.store(table, at(worker) + 1 + i, word));
    Atomics.store(table, at(worker), ready);
    if (!isNew) {
      Atomics.notify(table, at(worker));
      return 0;
    }
    try {
      new Worker(new URL("thread.js", import.meta.url), { workerData: { module, memory, table, program, place: at(worker) }, trackUnmanagedFds: false });
      return 0;
    } catch {
      Atomics.store(table, at(worker), taken);
      return 6;
    }
  };
  Object.assign(imports.env, {
    startThread,
    endProgram: end ?? ((exitCode) => endProgram(table, exitCode)),
    exit: end ?? ((exitCode) => endProgram(table, exitCode)),
    // The first thread handles signals, and may block.
    __emscripten_init_main_thread_js: (thread) => {
      instance.exports._emscripten_thread_init(thread, 0, 0, 1, 0);
      instance.exports.emscripten_tls_init?.();
    },
    __emscripten_thread_cleanup: (thread) => instance.exports._emscripten_thread_free_data(thread),
  });
  instance = new WebAssembly.Instance(module, imports);
  return instance.exports;
}

/** Runs threads, one after the other, until the program ends. */
export function serve({ place, ...program }) {
  const { table } = program;
  const exports = instanceOf(program);
  for (;;) {
    for (let state; (state = Atomics.load(table, place)) !== ready; ) Atomics.wait(table, place, state);
    const [thread, stackEnd, start, argument] = table.subarray(place + 1, place + 5);
    exports._emscripten_thread_init(thread, 0, 0, 1, 0);
    exports.stackRestore(stackEnd);
    exports.emscripten_tls_init?.();
    exports._emscripten_thread_exit(exports.__indirect_function_table.get(start)(argument));
    Atomics.store(table, place, idle);
  }
}
