// SPDX-License-Identifier: MIT
// Each mistake is an exception that says what and where, and the module works afterwards.
import assert from "node:assert/strict";
import { after, describe, it } from "node:test";
import { generateNormals, generateTangents, Plan, ready, sanitizeTangents, splitVertices, TspaceError } from "tspace";
import { grid } from "./meshes.mjs";

await ready;
const mesh = grid(3);
const options = { convention: "gltf" };
const good = generateTangents(mesh, options);

/** body() throws a TspaceError of that code whose message has all the words; then a good call still works. */
function refuses(code, words, body, element) {
  assert.throws(body, (error) => {
    assert.ok(error instanceof TspaceError && error instanceof Error, String(error));
    assert.equal(error.code, code, error.message);
    for (const word of words) assert.match(error.message, word);
    if (element !== undefined) assert.equal(error.element, element);
    return true;
  });
  assert.deepEqual(generateTangents(mesh, options), good);
}
const tangentsOf = (changes, more = {}) => () => generateTangents({ ...mesh, ...changes }, { ...options, ...more });

describe("refused", () => {
  it("no convention", () => {
    refuses("invalidOption", [/convention is missing/, /gltf/], () => generateTangents(mesh));
    refuses("invalidOption", [/convention/, /"maya"/, /gltf/], tangentsOf({}, { convention: "maya" }));
    refuses("invalidOption", [/vAxis/], tangentsOf({}, { convention: {} }));
    refuses("invalidOption", [/green/], tangentsOf({}, { convention: { vAxis: "up", green: 1 } }));
  });

  it("wrong types", () => {
    refuses("wrongType", [/mesh is null/], () => generateTangents(null, options));
    refuses("wrongType", [/positions/, /Float64Array/, /Float32Array/], tangentsOf({ positions: new Float64Array(9) }));
    refuses("wrongType", [/positions is Array/], tangentsOf({ positions: [0, 0, 0] }));
    refuses("wrongType", [/uvs is a string/], tangentsOf({ uvs: "uv" }));
    refuses("wrongType", [/indices is Float32Array/], tangentsOf({ indices: new Float32Array(3) }));
    refuses("wrongType", [/indices is Int32Array/], tangentsOf({ indices: new Int32Array(3) }));
    refuses("wrongType", [/faceSizes/], tangentsOf({ faceSizes: 4 }));
    refuses("wrongType", [/threshold/], tangentsOf({}, { threshold: "180" }));
    refuses("wrongType", [/options/], () => generateTangents(mesh, "gltf"));
    refuses("wrongType", [/tangents/], () => sanitizeTangents(mesh, [...good]));
    refuses("wrongType", [/attributes/], () => splitVertices({ vertexCount: 3 }, {}));
  });

  it("wrong options", () => {
    refuses("invalidOption", [/method is "mikkt"/, /mikktspace, lengyel/], tangentsOf({}, { method: "mikkt" }));
    refuses("invalidOption", [/pairing/], tangentsOf({}, { pairing: "good" }));
    refuses("invalidOption", [/refine/], tangentsOf({}, { refine: 7 }));
    refuses("invalidOption", [/refine/], tangentsOf({}, { refine: -1 }));
    refuses("invalidOption", [/symmetric/], tangentsOf({}, { frame: "symmetric" }));
    refuses("invalidOption", [/crease/], () => generateNormals(mesh, { creaseAngle: 181 }));
    refuses("invalidOption", [/weighting/], () => generateNormals(mesh, { weighting: "heavy" }));
  });

  it("wrong shapes", () => {
    refuses("countMismatch", [/positions has 10 numbers/], tangentsOf({ positions: new Float32Array(10) }));
    refuses("countMismatch", [/normals has 1 entries, 16/], tangentsOf({ normals: new Float32Array(3) }));
    refuses("countMismatch", [/uvs has 17/], tangentsOf({ uvs: new Float32Array(34) }));
    refuses("countMismatch", [/face/], tangentsOf({ faceSizes: Uint32Array.of(3, 3) }));
    refuses("countMismatch", [/more corners than the 53/], tangentsOf({ indices: mesh.indices.subarray(1), faceSizes: new Uint8Array(18).fill(3) }));
    refuses("countMismatch", [/tangents has 1 entries/], () => sanitizeTangents(mesh, new Float32Array(4)));
    refuses("countMismatch", [/attribute 0/], () => splitVertices({ vertexCount: 3 }, [{ data: new Float32Array(4), size: 2 }]), 0);
  });

  it("what is missing", () => {
    refuses("missingAttribute", [/positions/], tangentsOf({ positions: undefined }));
    refuses("missingAttribute", [/normals/], tangentsOf({ normals: null }));
    refuses("missingAttribute", [/UVs/], tangentsOf({ uvs: undefined }));
    refuses("missingAttribute", [/normals/], () => sanitizeTangents({ positions: mesh.positions }, good));
  });

  it("indices out of range, and where", () => {
    const indices = mesh.indices.slice();
    indices[7] = 16;
    refuses("indexOutOfRange", [/index 16 of corner 7/, /16 vertices/], tangentsOf({ indices }), 7);
    refuses("indexOutOfRange", [/index 4294967295/], tangentsOf({ indices: Uint32Array.of(0, 1, 0xffffffff) }), 2);
    refuses("indexOutOfRange", [/corner 1/], () =>
      splitVertices({ indices: Uint32Array.of(0, 5), vertexCount: 2 }, [{ data: new Float32Array(2), size: 1 }]), 1);
  });

  it("counts of 2^31 and more", () => {
    refuses("countMismatch", [/face sizes/, /54/], tangentsOf({ faceSizes: new Uint32Array(3).fill(0x80000000) }));
    refuses("tooLarge", [/2\^31/], () => splitVertices({ indices: Uint32Array.of(0), vertexCount: 2 ** 31 }, [{ data: new Float32Array(1), size: 1 }]));
    refuses("invalidOption", [/vertexCount/], () => splitVertices({ vertexCount: 2 ** 33 }, []));
    refuses("invalidOption", [/vertexCount/], () => splitVertices({ vertexCount: 1.5 }, []));
  });

  it("detached and resized buffers", () => {
    const detached = mesh.positions.slice();
    structuredClone(detached.buffer, { transfer: [detached.buffer] });
    refuses("detached", [/positions/, /detached/], tangentsOf({ positions: detached }));
    const indices = mesh.indices.slice();
    structuredClone(indices.buffer, { transfer: [indices.buffer] });
    refuses("detached", [/indices/], tangentsOf({ indices }));
    if (!ArrayBuffer.prototype.resize) return;
    const buffer = new ArrayBuffer(mesh.uvs.byteLength, { maxByteLength: mesh.uvs.byteLength });
    const uvs = new Float32Array(buffer, 0, mesh.uvs.length);
    buffer.resize(8);
    refuses("detached", [/uvs/], tangentsOf({ uvs }));
  });

  it("plans with poses of another size", () => {
    const plan = new Plan(mesh, options);
    refuses("planMismatch", [/15 positions/, /16/], () =>
      plan.evaluate({ positions: mesh.positions.subarray(3), normals: mesh.normals }));
    refuses("missingAttribute", [/normals/], () => plan.evaluate({ positions: mesh.positions }));
    assert.deepEqual(plan.evaluate(mesh), good);
    plan.destroy();
  });
});

describe("taken as it is", () => {
  it("what is not finite", () => {
    const positions = mesh.positions.slice();
    positions[4] = NaN;
    positions[9] = Infinity;
    const tangents = generateTangents({ ...mesh, positions }, options);
    assert.equal(tangents.length, good.length);
    assert.ok(sanitizeTangents({ ...mesh, positions }, tangents).every(Number.isFinite));
    assert.equal(generateNormals({ ...mesh, positions }).length, 3 * mesh.indices.length);
  });

  it("an empty mesh", () => {
    const empty = { positions: new Float32Array(0), normals: new Float32Array(0), uvs: new Float32Array(0) };
    for (const indices of [undefined, new Uint32Array(0)]) {
      assert.equal(generateTangents({ ...empty, indices }, options).length, 0);
      assert.equal(generateNormals({ ...empty, indices }).length, 0);
      assert.equal(sanitizeTangents({ ...empty, indices }, new Float32Array(0)).length, 0);
      const plan = new Plan({ ...empty, indices }, options);
      assert.equal(plan.evaluate(empty).length, 0);
      plan.destroy();
    }
    assert.equal(splitVertices({ vertexCount: 0 }, []).indices.length, 0);
  });

  it("views into larger buffers, and shared ones", () => {
    const bytes = new ArrayBuffer(mesh.positions.byteLength + 8);
    new Float32Array(bytes, 8).set(mesh.positions);
    assert.deepEqual(generateTangents({ ...mesh, positions: new Float32Array(bytes, 8) }, options), good);
    const shared = new Float32Array(new SharedArrayBuffer(mesh.positions.byteLength));
    shared.set(mesh.positions);
    assert.deepEqual(generateTangents({ ...mesh, positions: shared }, options), good);
  });
});

describe("running out of memory", () => {
  it("is an error, after which the module works", () => {
    const plan = new Plan(mesh, options);
    const vertexCount = 2 ** 31 - 1; // 8 GB of numbers for the new vertices alone
    refuses("outOfMemory", [/memory/], () => splitVertices({ indices: Uint32Array.of(0), vertexCount }, [{ data: new Float32Array(1), size: 1 }]));
    assert.throws(() => plan.evaluate(mesh), { code: "planMismatch" });
    plan.destroy();
  });
});

after(() => assert.deepEqual(generateTangents(mesh, options), good));
