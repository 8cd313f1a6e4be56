// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { it } from "node:test";
import { Worker } from "node:worker_threads";
import { generateTangents, ready } from "tspace";
import { grid } from "./meshes.mjs";

it("a worker computes, and hands its result over without a copy", async () => {
  await ready;
  const mesh = grid(6);
  const worker = new Worker(new URL("./worker.mjs", import.meta.url));
  const tangents = await new Promise((resolve, reject) => {
    worker.once("message", resolve);
    worker.once("error", reject);
    worker.postMessage({ mesh, options: { convention: "gltf" } });
  });
  await worker.terminate();
  assert.deepEqual(tangents, generateTangents(mesh, { convention: "gltf" }));
});
