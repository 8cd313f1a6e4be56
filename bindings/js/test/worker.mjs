// SPDX-License-Identifier: MIT
// A worker that computes tangents: it reports progress, and stops when a flag in shared memory is set.
import { parentPort } from "node:worker_threads";
import { generateTangents, ready } from "tspace";
import * as files from "tspace/gltf";

const calls = { generate: files.generate, check: files.check };

parentPort.on("message", async ({ call, mesh, model, options, flag }) => {
  await Promise.all([ready, files.ready]);
  try {
    if (mesh) {
      const tangents = generateTangents(mesh, options);
      return parentPort.postMessage({ made: tangents }, [tangents.buffer]);
    }
    const signal = { get aborted() { return Atomics.load(flag, 0) !== 0; } };
    const onProgress = (progress) => parentPort.postMessage({ progress });
    const made = calls[call](model, { ...options, signal, onProgress });
    parentPort.postMessage({ made }, made.bytes ? [made.bytes.buffer] : []);
  } catch (error) {
    parentPort.postMessage({ error });
  }
});
