// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { it } from "node:test";
import { Worker } from "node:worker_threads";
import { generateTangents, ready } from "tspace";
import * as files from "tspace/gltf";
import { grid } from "./meshes.mjs";

it("a worker computes, and hands its result over without a copy", async () => {
  await Promise.all([ready, files.ready]);
  const mesh = grid(6);
  const worker = new Worker(new URL("./worker.mjs", import.meta.url));
  const ask = (message) => new Promise((resolve, reject) => {
    worker.once("message", resolve);
    worker.once("error", reject);
    worker.postMessage(message);
  });
  const tangents = await ask({ mesh, options: { convention: "gltf" } });
  const model = new TextEncoder().encode(JSON.stringify({ asset: { version: "2.0" }, scenes: [] }));
  const glb = await ask({ model });
  await worker.terminate();
  assert.deepEqual(tangents, generateTangents(mesh, { convention: "gltf" }));
  assert.deepEqual(glb, files.generate(model).bytes);
});
