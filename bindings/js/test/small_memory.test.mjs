// SPDX-License-Identifier: MIT
// Tests modules whose memory has a small maximum, as in a browser tab that is nearly full: each call succeeds or fails
// with the code outOfMemory, and the module works afterwards.
import assert from "node:assert/strict";
import { once } from "node:events";
import { describe, it } from "node:test";
import { isMainThread, parentPort, Worker, workerData } from "node:worker_threads";
import { grid } from "./meshes.mjs";
import { gridModel } from "./models.mjs";

const kMemorySection = 5;

/** Reads a LEB128 integer at an offset; returns it and the offset after it. */
function numberAt(bytes, at) {
  let value = 0;
  for (let shift = 0; ; shift += 7) {
    const byte = bytes[at++];
    value += (byte & 127) * 2 ** shift;
    if (byte < 128) return [value, at];
  }
}

const spelled = (value) => (value < 128 ? [value] : [(value & 127) | 128, ...spelled(value >>> 7)]);

/** Returns the module with a memory that can grow by this number of pages. */
function withMaximum(source, pages) {
  const bytes = new Uint8Array(source.buffer ?? source, source.byteOffset ?? 0, source.byteLength);
  for (let at = 8; at < bytes.length; ) {
    const [size, body] = numberAt(bytes, at + 1);
    if (bytes[at] === kMemorySection) {
      const [initial] = numberAt(bytes, body + 2); // skips the number of memories and the flags of the first one
      const memory = [1, 1, ...spelled(initial), ...spelled(initial + pages)];
      return Uint8Array.from([...bytes.subarray(0, at), kMemorySection, ...spelled(memory.length), ...memory, ...bytes.subarray(body + size)]);
    }
    at = body + size;
  }
  throw new Error("the module has no memory of its own");
}

const options = { convention: "gltf" };
const meshCalls = {
  generateTangents: (tspace, mesh) => tspace.generateTangents(mesh, options),
  generateNormals: (tspace, mesh) => tspace.generateNormals(mesh),
  makeIndexedFrames: (tspace, mesh) => tspace.makeIndexedFrames(mesh, options),
  plan: (tspace, mesh) => {
    const plan = new tspace.Plan(mesh, options);
    try {
      return plan.evaluate(mesh);
    } finally {
      plan.destroy();
    }
  },
};
const modelCalls = {
  generate: (gltf, model) => gltf.generate(model).bytes,
  check: (gltf, model) => gltf.check(model).findings,
  identify: (gltf, model) => gltf.identify(model).explanations,
  inspect: (gltf, model) => gltf.inspect(model).primitives,
  diff: (gltf, model) => gltf.diff(model, model).primitives,
};
const model = (size) => gridModel({ size, tangents: new Float32Array(4 * (size + 1) ** 2).map((_, i) => (i % 4 === 1 || i % 4 === 2 ? 0 : 1)) }).model;
const entries = {
  tspace: { calls: meshCalls, large: () => grid(90), small: () => grid(2) },
  "tspace/gltf": { calls: modelCalls, large: () => model(60), small: () => model(2) },
};

/** Returns the result of each call of an entry with a memory that can grow by this number of pages: for a large input, and then for a small one. */
async function outcomes({ entry, pages }) {
  const compile = WebAssembly.compile;
  WebAssembly.compile = (bytes) => compile(withMaximum(bytes, pages));
  const { calls, large, small } = entries[entry], tspace = await import(entry);
  await tspace.ready;
  const outcome = (call, input) => {
    try {
      return call(tspace, input);
    } catch (error) {
      return error.code ?? error.stack;
    }
  };
  return Object.entries(calls).map(([name, call]) => [name, outcome(call, large()), outcome(call, small())]);
}

if (!isMainThread) {
  parentPort.postMessage(await outcomes(workerData));
} else {
  const outcomesIn = async (entry, pages) => {
    const worker = new Worker(new URL(import.meta.url), { workerData: { entry, pages } });
    const [made] = await once(worker, "message");
    await worker.terminate();
    return made;
  };
  describe("with little memory", () => {
    for (const entry of Object.keys(entries)) {
      it(`each call of ${entry} succeeds or runs out of memory, and the module works afterwards`, async () => {
        const wanted = await outcomesIn(entry, 2048);
        for (const [name, large] of wanted) assert.notEqual(typeof large, "string", `${name}: ${large}`);
        const failures = wanted.map(() => 0);
        for (const pages of [0, 1, 2, 4, 7, 12, 20, 33, 54, 90]) {
          for (const [i, [name, large, small]] of (await outcomesIn(entry, pages)).entries()) {
            const where = `${name} with ${pages} pages`;
            failures[i] += large === "outOfMemory";
            if (large !== "outOfMemory") assert.deepEqual(large, wanted[i][1], where);
            assert.deepEqual(small, wanted[i][2], `${where}, afterwards`);
          }
        }
        for (const count of failures) assert.ok(count > 0 && count < 10, `${failures}`);
      });
    }
  });
}
