// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { frameBytes, packFrames, ready, TspaceError, unpackFrames } from "tspace/pack";

await ready;

const normals = Float32Array.of(0, 0, 1, 0, 1, 0), tangents = Float32Array.of(1, 0, 0, 1, 1, 0, 0, -1);

describe("packed frames", () => {
  it("report invalid input, and work afterwards", () => {
    const refused = (body, code) => assert.throws(body, (error) => error instanceof TspaceError && error.code === code);
    refused(() => packFrames(normals, tangents, "frame31"), "invalidOption");
    refused(() => packFrames([0, 0, 1], tangents, "frame32"), "wrongType");
    refused(() => packFrames(normals, tangents.subarray(4), "frame32"), "countMismatch");
    refused(() => packFrames(undefined, tangents, "frame32"), "missingAttribute");
    refused(() => unpackFrames(new Uint8Array(5), "frame32"), "countMismatch");
    refused(() => unpackFrames("words", "frame32"), "wrongType");
    refused(() => frameBytes("frame31"), "invalidOption");
    assert.equal(packFrames(new Float32Array(0), new Float32Array(0), "frame32").length, 0);
    const broken = packFrames(new Float32Array([NaN, 0, 0]), new Float32Array([Infinity, 0, 0, 7]), "frame32");
    const back = unpackFrames(broken, "frame32");
    assert.ok([...back.normals, ...back.tangents].every(Number.isFinite));
  });
});
