// SPDX-License-Identifier: MIT
// The entry "tspace/normals": noise, automatic hard edges, winding.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import * as plain from "tspace";
import * as whole from "tspace/normals";

await Promise.all([plain.ready, whole.ready]);

describe("options of \"tspace/normals\" alone", () => {
  it("are rejected by name in \"tspace\"", () => {
    const mesh = { positions: new Float32Array(9) };
    for (const options of [{ denoise: "auto" }, { denoise: 2 }, { creaseAngle: "auto" }])
      assert.throws(() => plain.generateNormals(mesh, { weighting: "best", ...options }), /tspace\/normals/);
    assert.equal(whole.generateNormals(mesh, { weighting: "best", denoise: "auto", creaseAngle: "auto" }).length, 9);
  });
});

describe("fixWinding", () => {
  const positions = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
  const sound = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];
  it("gives indices with consistent winding and the correct outside", () => {
    const indices = new Uint32Array([0, 2, 1, 0, 3, 1, 0, 3, 2, 1, 2, 3]);
    const fixed = whole.fixWinding({ positions, indices });
    assert.deepEqual([...fixed.indices], sound);
    assert.deepEqual([...fixed.turned], [0, 1, 0, 0]);
    assert.equal(fixed.report.turnedCount, 1);
    assert.equal(fixed.report.conflictCountBefore, 3);
    assert.equal(fixed.report.byVolumeCount, 1);
    assert.equal(indices[4], 3); // the caller's indices are not changed
  });
  it("has the former name mendWinding", () => {
    assert.equal(whole.mendWinding, whole.fixWinding);
  });
});
