// SPDX-License-Identifier: MIT
// Tests planBuffers: its arrays are views of the words, and invalid arguments are rejected. cases.test.mjs checks the
// words themselves.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Plan, planBuffers, ready, release } from "tspace";
import { grid } from "./meshes.mjs";

await ready;

const NO_CORNER = 0xffffffff;

describe("planBuffers", () => {
  const mesh = grid(9), options = { method: "uniform", convention: "gltf" };

  it("has arrays that are views of its words", () => {
    const { words, results, entries, triangles } = planBuffers(new Plan(mesh, { convention: "gltf", method: "lengyel" }));
    assert.deepEqual([words[0], words[7], triangles.length], [1, 7, 7 * 162]);
    assert.equal(words.length, 12 + results.length + entries.length + triangles.length);
    for (const array of [results, entries, triangles]) assert.equal(array.buffer, words.buffer);
  });

  it("rejects mismatching arguments", () => {
    const plan = new Plan(mesh, options);
    for (const [given, pattern] of [
      [{ indices: new Uint32Array(3) }, /indices must have one entry per corner/], [{ sourceCorners: Uint32Array.of(NO_CORNER - 1) }, /source corner/],
      [{ mesh, normals: { weighting: "best" } }, /best/], [{ mesh, normals: { weight: "area" } }, /known names are/], [{ corners: 1 }, /known names are/],
      [{ mesh: { positions: mesh.positions.subarray(3) } }, /plan was created for|multiple/],
    ]) assert.throws(() => planBuffers(plan, given), pattern);
    assert.throws(() => planBuffers({}), /plan must be a Plan/);
    assert.throws(() => planBuffers(new Plan(mesh, { convention: "gltf", method: "best" })), /best/);
    const gone = new Plan(mesh, options);
    gone.destroy();
    assert.throws(() => planBuffers(gone), /destroyed/);
    release();
    assert.throws(() => planBuffers(plan), /invalidated by release/);
  });
});
