// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Worker } from "node:worker_threads";
import { generateTangents, ready } from "tspace";
import * as files from "tspace/gltf";
import { askWorker } from "./ask_worker.mjs";
import { grid } from "./meshes.mjs";
import { gridModel } from "./models.mjs";

await Promise.all([ready, files.ready]);
const { model } = gridModel();

describe("a worker", () => {
  it("computes, transfers its result without a copy, reports progress, and stops on request", async () => {
    const worker = new Worker(new URL("./worker.mjs", import.meta.url));
    try {
      const mesh = grid(6);
      const tangents = await askWorker(worker, { mesh, options: { convention: "gltf" } });
      assert.deepEqual(tangents, generateTangents(mesh, { convention: "gltf" }));
      const steps = [];
      const glb = await askWorker(worker, { call: "generate", model }, { onProgress: ({ what }) => steps.push(what) });
      assert.deepEqual(glb.bytes, files.generate(model).bytes);
      assert.ok(["reading", "computing tangents", "writing"].every((step) => steps.includes(step)), steps.join());
      const stopped = askWorker(worker, { call: "check", model }, { signal: AbortSignal.abort() });
      await assert.rejects(stopped, /stopped/);
      assert.equal((await askWorker(worker, { call: "check", model })).ok, true);
    } finally {
      await worker.terminate();
    }
  });
});

describe("calls", () => {
  const { model } = gridModel({ size: 40 });
  const verbs = Object.entries({ generate: files.generate, check: files.check });

  it("report increasing progress", () => {
    for (const [verb, call] of verbs) {
      const told = [];
      call(model, { onProgress: (progress) => told.push(progress) });
      assert.ok(told.length > 2, verb);
      told.forEach(({ what, done, total }, i) => {
        assert.ok(typeof what === "string" && done <= total, verb);
        if (i > 0 && told[i - 1].what === what) assert.ok(done >= told[i - 1].done, verb);
      });
    }
  });

  it("stop at any point, throw the reason of the signal, and work afterwards", () => {
    for (const [verb, call] of verbs) {
      let looks = 0;
      call(model, { signal: { get aborted() { return ++looks < 0; } } });
      assert.ok(looks > 10, `${verb} looked ${looks} times`);
      for (let last = 1; last < looks; last += Math.ceil(looks / 12)) {
        let left = last;
        const signal = { get aborted() { return --left <= 0; }, reason: new RangeError("enough") };
        assert.throws(() => call(model, { signal }), { message: "enough" }, `${verb} ${last}`);
      }
      assert.throws(() => call(model, { signal: { aborted: true } }), { code: "stopped" });
      assert.throws(() => call(model, { signal: AbortSignal.abort() }), { name: "AbortError" });
      const controller = new AbortController();
      const told = [];
      const onProgress = ({ what }) => told.push(what) && controller.abort();
      assert.throws(() => call(model, { signal: controller.signal, onProgress }), { name: "AbortError" });
      assert.equal(told.length, 1);
      assert.throws(() => call(model, { onProgress() { throw new RangeError("mine"); } }), { message: "mine" });
      assert.throws(() => call(model, { onProgress: 5 }), { code: "wrongType" });
      assert.throws(() => call(model, { signal: 5 }), { code: "wrongType" });
      assert.throws(() => call(model, { signal: {} }), { code: "wrongType" });
      assert.equal(call(model).ok ?? call(model).report.ok, true);
    }
  });
});
