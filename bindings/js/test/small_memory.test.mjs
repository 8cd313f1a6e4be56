// SPDX-License-Identifier: MIT
// Modules whose memory has a small maximum, as in a tab that is nearly full: each call succeeds or is an error of the code
// outOfMemory, and the module works afterwards.
import assert from "node:assert/strict";
import { once } from "node:events";
import { describe, it } from "node:test";
import { isMainThread, parentPort, Worker, workerData } from "node:worker_threads";
import { grid } from "./meshes.mjs";

const kMemorySection = 5;

/** A number of WebAssembly's binary format (LEB128) at a place, and the place behind it. */
function numberAt(bytes, at) {
  let value = 0;
  for (let shift = 0; ; shift += 7) {
    const byte = bytes[at++];
    value += (byte & 127) * 2 ** shift;
    if (byte < 128) return [value, at];
  }
}

const spelled = (value) => (value < 128 ? [value] : [(value & 127) | 128, ...spelled(value >>> 7)]);

/** The module with a memory that can grow by so many pages. */
function withMaximum(source, pages) {
  const bytes = new Uint8Array(source.buffer ?? source, source.byteOffset ?? 0, source.byteLength);
  for (let at = 8; at < bytes.length; ) {
    const [size, body] = numberAt(bytes, at + 1);
    if (bytes[at] === kMemorySection) {
      const [initial] = numberAt(bytes, body + 2); // behind the number of memories and the flags of the first
      const memory = [1, 1, ...spelled(initial), ...spelled(initial + pages)];
      return Uint8Array.from([...bytes.subarray(0, at), kMemorySection, ...spelled(memory.length), ...memory, ...bytes.subarray(body + size)]);
    }
    at = body + size;
  }
  throw new Error("the module has no memory of its own");
}

const options = { convention: "gltf" };
const calls = {
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

/** What each call gives with a memory that can grow by so many pages: for a large mesh, and for a small one afterwards. */
async function outcomes(pages) {
  const compile = WebAssembly.compile;
  WebAssembly.compile = (bytes) => compile(withMaximum(bytes, pages));
  const tspace = await import("tspace");
  await tspace.ready;
  const outcome = (call, mesh) => {
    try {
      return call(tspace, mesh);
    } catch (error) {
      return error.code ?? error.stack;
    }
  };
  return Object.entries(calls).map(([name, call]) => [name, outcome(call, grid(90)), outcome(call, grid(2))]);
}

if (!isMainThread) {
  parentPort.postMessage(await outcomes(workerData));
} else {
  const outcomesIn = async (pages) => {
    const worker = new Worker(new URL(import.meta.url), { workerData: pages });
    const [made] = await once(worker, "message");
    await worker.terminate();
    return made;
  };
  describe("with little memory", () => {
    it("each call succeeds or runs out of memory, and the module works afterwards", async () => {
      const wanted = await outcomesIn(2048);
      const failures = wanted.map(() => 0);
      for (const pages of [0, 1, 2, 4, 7, 12, 20, 33, 54, 90]) {
        for (const [i, [name, large, small]] of (await outcomesIn(pages)).entries()) {
          const where = `${name} with ${pages} pages`;
          failures[i] += large === "outOfMemory";
          if (large !== "outOfMemory") assert.deepEqual(large, wanted[i][1], where);
          assert.deepEqual(small, wanted[i][2], `${where}, afterwards`);
        }
      }
      for (const count of failures) assert.ok(count > 0 && count < 10, `${failures}`);
    });
  });
}
