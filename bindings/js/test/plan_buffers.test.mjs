// SPDX-License-Identifier: MIT
// A plan as arrays for compute shaders: evaluation in JavaScript gives the same result as the module.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { makeIndexedFrames, Plan, planBuffers, ready, release } from "tspace";
import { grid } from "./meshes.mjs";

await ready;

const NO_TANGENT = 0x80000000, NO_NORMAL = 0x40000000, NEGATIVE = 0x80000000, NO_CORNER = 0xffffffff;
const minus = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const unit = (a) => a.map((x) => x / Math.sqrt(dot(a, a)));
const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
const has = (word, flag) => (word & flag) !== 0;

/** Normals and tangents of each result, for the method and the weighting "uniform". */
function evaluated(buffers, positions, normals) {
  const width = buffers.triangles.length / buffers.triangleCount;
  const floats = new Float32Array(buffers.triangles.buffer, buffers.triangles.byteOffset, buffers.triangles.length);
  const vector = (array, i) => [...array.subarray(3 * i, 3 * i + 3)];
  const corner = (entry) => [(entry & 0x3fffffff) >>> 2, entry & 3];
  const edges = (t) => {
    const [p, q, r] = buffers.triangles.subarray(width * t, width * t + 3);
    return [q, r].map((v) => minus(vector(positions, v), vector(positions, p)));
  };
  const madeNormals = [], tangents = [];
  for (let i = 0; i < buffers.resultCount; ++i) {
    const [first, countAndFlags, own] = buffers.results.subarray(3 * i, 3 * i + 3);
    const entries = buffers.entries.subarray(first, first + (countAndFlags & 0x0fffffff));
    let n = [0, 0, 0], sum = [0, 0, 0];
    for (const entry of entries) if (!has(entry, NO_NORMAL)) n = minus(n, unit(cross(...edges(corner(entry)[0]).reverse())));
    if (normals) n = vector(normals, buffers.triangles[width * corner(own)[0] + corner(own)[1]]);
    else n = unit(n);
    for (const entry of entries) {
      if (has(entry, NO_TANGENT)) continue;
      const [t] = corner(entry), [e1, e2] = edges(t), [a, b] = floats.subarray(width * t + 3, width * t + 5);
      const along = e1.map((x, k) => a * x - b * e2[k]);
      sum = minus(sum, unit(minus(n.map((x) => x * dot(n, along)), along)));
    }
    madeNormals.push(...n);
    tangents.push(...unit(sum), has(countAndFlags, NEGATIVE) ? -1 : 1);
  }
  return { normals: madeNormals, tangents };
}

const difference = (a, b) => a.reduce((most, x, i) => Math.max(most, Math.abs(x - b[i])), 0);

describe("planBuffers", () => {
  const mesh = grid(9), options = { method: "uniform", convention: "gltf" };

  it("has results per corner that are those of evaluate", () => {
    const plan = new Plan(mesh, options);
    const buffers = planBuffers(plan);
    assert.equal(buffers.resultCount, mesh.indices.length);
    assert.equal(buffers.makesNormals, false);
    const pose = { positions: mesh.positions.map((x, i) => x * [1, 2, 0.5][i % 3]), normals: mesh.normals };
    const { tangents } = evaluated(buffers, pose.positions, pose.normals);
    assert.ok(difference(tangents, plan.evaluate(pose)) < 2e-6);
    assert.ok(difference(tangents, plan.evaluate(mesh)) > 0.1); // a different pose, so that the comparison can fail
    plan.destroy();
    assert.throws(() => planBuffers(plan), /destroyed/);
  });

  it("has results per vertex, and normals, that are those of makeIndexedFrames", () => {
    const normals = { weighting: "uniform", creaseAngle: 40 };
    const made = makeIndexedFrames({ ...mesh, normals: undefined }, { ...options, normals });
    const take = (array, size) => Float32Array.from([...made.sourceVertices].flatMap((v) => [...array.subarray(size * v, size * v + size)]));
    const vertices = { positions: take(mesh.positions, 3), normals: made.normals, uvs: take(mesh.uvs, 2), indices: made.indices };
    const plan = new Plan(vertices, options);
    const buffers = planBuffers(plan, { indices: made.indices, sourceCorners: made.sourceCorners, mesh: vertices, normals });
    assert.equal(buffers.resultCount, made.sourceVertices.length);
    assert.ok(buffers.makesNormals);
    const found = evaluated(buffers, vertices.positions);
    assert.ok(difference(found.normals, made.normals) < 2e-6);
    assert.ok(difference(found.tangents, made.tangents) < 2e-6);
  });

  it("has arrays that are views of its words", () => {
    const { words, results, entries, triangles } = planBuffers(new Plan(mesh, { convention: "gltf", method: "lengyel" }));
    assert.deepEqual([words[0], words[7], triangles.length], [1, 7, 7 * 162]);
    assert.equal(words.length, 12 + results.length + entries.length + triangles.length);
    for (const array of [results, entries, triangles]) assert.equal(array.buffer, words.buffer);
  });

  it("refuses what does not fit", () => {
    const plan = new Plan(mesh, options);
    for (const [given, pattern] of [
      [{ indices: new Uint32Array(3) }, /indices must have one entry per corner/], [{ sourceCorners: Uint32Array.of(NO_CORNER - 1) }, /source corner/],
      [{ mesh, normals: { weighting: "best" } }, /best/], [{ mesh, normals: { weight: "area" } }, /known names are/], [{ corners: 1 }, /known names are/],
      [{ mesh: { positions: mesh.positions.subarray(3) } }, /plan was made for|multiple/],
    ]) assert.throws(() => planBuffers(plan, given), pattern);
    assert.throws(() => planBuffers({}), /plan must be a Plan/);
    assert.throws(() => planBuffers(new Plan(mesh, { convention: "gltf", method: "best" })), /best/);
    release();
    assert.throws(() => planBuffers(plan), /invalidated by release/);
  });
});
