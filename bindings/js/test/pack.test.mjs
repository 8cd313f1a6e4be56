// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { frameBytes, frameFormats, packFrames, ready, TspaceError, unpackFrames } from "tspace/pack";

await ready;

const count = 5000;
const normals = new Float32Array(3 * count), tangents = new Float32Array(4 * count);
for (let i = 0; i < count; ++i) {
  normals.set([(i % 7) - 3, (i % 5) - 2, 1 + (i % 3)], 3 * i);
  tangents.set([((i * 3) % 19) - 9, ((i * 5) % 17) - 8, (i % 4) - 1.5, i % 11 < 5 ? -1 : 1], 4 * i);
}

const hashOf = (...arrays) => {
  let hash = 2166136261;
  for (const array of arrays)
    for (const byte of new Uint8Array(array.buffer, array.byteOffset, array.byteLength)) hash = Math.imul(hash ^ byte, 16777619);
  return hash >>> 0;
};

/** Of these frames, by the C++ library: bytes of a frame, and FNV-1a of the words, and of the frames that they unpack to. */
const inCpp = {
  frame32: [4, 1317488668, 1336354235],
  frame48: [6, 2475687055, 1704285321],
  frame64: [8, 2636187332, 2786118656],
  oct32: [4, 503579235, 671103331],
  qtangent64: [8, 1928537401, 2639850260],
  snorm8_pair: [8, 3148665511, 1050175138],
  snorm16_pair: [16, 2260135931, 1860090120],
  gltf_snorm8: [7, 2651807397, 1050175138],
  gltf_snorm16: [14, 3462702691, 1860090120],
};

describe("packed frames", () => {
  it("have the bits of the C++ library, there and back", () => {
    assert.deepEqual(Object.keys(inCpp), [...frameFormats]);
    for (const [format, wanted] of Object.entries(inCpp)) {
      const report = {};
      const frames = packFrames(normals, tangents, format, { report });
      const back = unpackFrames(frames, format);
      assert.deepEqual([frameBytes(format), hashOf(frames), hashOf(back.normals, back.tangents)], wanted, format);
      assert.ok(report.mendedCount > 0 && report.notUnitCount > 0);
      for (let i = 0; i < count; ++i) assert.equal(back.tangents[4 * i + 3], tangents[4 * i + 3], "every sign survives");
    }
  });

  it("stay what they are when they are packed again", () => {
    for (const format of ["frame32", "frame48", "frame64", "oct32"]) {
      const frames = packFrames(normals, tangents, format);
      const back = unpackFrames(frames, format);
      const again = unpackFrames(packFrames(back.normals, back.tangents, format), format);
      assert.deepEqual(again, back, format);
    }
  });

  it("say what is wrong with their input, and go on", () => {
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
