// SPDX-License-Identifier: MIT
// The entry "tspace/normals": noise, automatic hard edges, winding.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import * as plain from "tspace";
import * as whole from "tspace/normals";

await Promise.all([plain.ready, whole.ready]);

/** A ball of `rows` rings, each vertex moved along its normal by noise of `sigma` edges. */
function ball(rows, sigma) {
  const columns = 2 * rows, positions = [], truth = [], indices = [];
  let state = 1;
  const random = () => ((state = (state * 48271) % 2147483647) / 2147483647);
  for (let i = 0; i <= rows; ++i) {
    for (let k = 0; k < columns; ++k) {
      const a = (Math.PI * (i + 0.5)) / (rows + 1), b = (2 * Math.PI * k) / columns;
      const n = [Math.sin(a) * Math.cos(b), Math.cos(a), Math.sin(a) * Math.sin(b)];
      const far = 1 + (sigma * Math.PI / rows) * Math.sqrt(-2 * Math.log(random() + 1e-9)) * Math.cos(2 * Math.PI * random());
      positions.push(...n.map((x) => x * far));
      truth.push(n);
      if (i === rows) continue;
      const at = (r, c) => r * columns + (c % columns);
      indices.push(at(i, k), at(i, k + 1), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
    }
  }
  return { mesh: { positions: new Float32Array(positions), indices: new Uint32Array(indices) }, truth };
}

const meanDegrees = (normals, { mesh, truth }) => {
  let sum = 0;
  mesh.indices.forEach((vertex, corner) => (sum += Math.acos(Math.min(1, truth[vertex].reduce((d, x, k) => d + x * normals[3 * corner + k], 0)))));
  return (sum / mesh.indices.length) * (180 / Math.PI);
};

describe("denoise", () => {
  it("leaves less than two thirds of the error on noisy positions, and every bit of clean ones", () => {
    const noisy = ball(60, 0.1), clean = ball(60, 0);
    const before = meanDegrees(whole.generateNormals(noisy.mesh, { weighting: "best" }), noisy);
    const report = {};
    const after = meanDegrees(whole.generateNormals(noisy.mesh, { weighting: "best", denoise: "auto", report }), noisy);
    assert.ok(after < 0.65 * before, `${after} of ${before}`);
    assert.ok(report.noise > 0.05 && report.noise < 0.2, String(report.noise));
    assert.deepEqual(whole.generateNormals(clean.mesh, { weighting: "best", denoise: "auto" }), whole.generateNormals(clean.mesh, { weighting: "best" }));
  });
  it("measures the noise", () => {
    const { sigma, noise, meanEdge } = whole.measurePositionNoise(ball(60, 0.1).mesh);
    assert.ok(sigma > 0.05 && sigma < 0.2 && noise > 0 && meanEdge > 0, `${sigma} ${noise} ${meanEdge}`);
    assert.equal(whole.measurePositionNoise(ball(60, 0).mesh).noise, 0);
  });
  it("gives the normals of \"tspace\" without it, where it is refused by name", () => {
    const { mesh } = ball(20, 0.1);
    assert.deepEqual(whole.generateNormals(mesh, { weighting: "best", creaseAngle: 40 }), plain.generateNormals(mesh, { weighting: "best", creaseAngle: 40 }));
    for (const options of [{ denoise: "auto" }, { denoise: 2 }, { creaseAngle: "auto" }])
      assert.throws(() => plain.generateNormals(mesh, { weighting: "best", ...options }), /tspace\/normals/);
  });
});

describe("creaseAngle: \"auto\"", () => {
  it("finds no hard edge on a ball, and says the angle", () => {
    const { mesh } = ball(30, 0), report = {};
    const made = whole.generateNormals(mesh, { weighting: "best", creaseAngle: "auto", report });
    assert.deepEqual(made, whole.generateNormals(mesh, { weighting: "best" }));
    assert.ok(report.creaseAngle > 0 && report.creaseAngle <= 180);
  });
});

describe("mendWinding", () => {
  const positions = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
  const sound = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];
  it("gives indices in which faces are wound alike, and outwards", () => {
    const indices = new Uint32Array([0, 2, 1, 0, 3, 1, 0, 3, 2, 1, 2, 3]);
    const mended = whole.mendWinding({ positions, indices });
    assert.deepEqual([...mended.indices], sound);
    assert.deepEqual([...mended.turned], [0, 1, 0, 0]);
    assert.equal(mended.report.turnedCount, 1);
    assert.equal(mended.report.conflictCountBefore, 3);
    assert.equal(mended.report.byVolumeCount, 1);
    assert.equal(indices[4], 3); // the caller's indices are not changed
  });
});
