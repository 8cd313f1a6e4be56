// SPDX-License-Identifier: MIT
// Each invalid argument raises a precise exception, and the module still works afterwards.
import assert from "node:assert/strict";
import { after, describe, it } from "node:test";
import { runInNewContext } from "node:vm";
import { generateNormals, generateTangents, makeIndexedFrames, Plan, ready, sanitizeTangents, splitVertices, triangulate, TspaceError } from "tspace";
import * as small from "tspace/mikktspace";
import * as whole from "tspace/normals";
import { grid } from "./meshes.mjs";

await Promise.all([ready, small.ready, whole.ready]);
const mesh = grid(3);
const options = { convention: "gltf" };
const good = generateTangents(mesh, options);

/** Checks that body() throws a TspaceError with this code and all words in its message, and that a valid call works afterwards. */
function refuses(code, words, body, element) {
  assert.throws(body, (error) => {
    assert.ok(error instanceof TspaceError && error instanceof Error, String(error));
    assert.equal(error instanceof TypeError, code === "wrongType" || / is unknown; /.test(error.message));
    assert.equal(error.code, code, error.message);
    for (const word of words) assert.match(error.message, word);
    if (element !== undefined) assert.equal(error.element, element);
    return true;
  });
  assert.deepEqual(generateTangents(mesh, options), good);
}
const plainNormals = (given) => generateNormals(mesh, given);
const wholeNormals = (given) => whole.generateNormals(mesh, { ...given, weighting: given.weighting === undefined ? "best" : given.weighting });
const tangentsOf = (changes, more = {}) => () => generateTangents({ ...mesh, ...changes }, { ...options, ...more });

describe("rejects", () => {
  it("no convention", () => {
    refuses("invalidOption", [/convention is missing/, /gltf/], () => generateTangents(mesh));
    refuses("invalidOption", [/convention/, /"maya"/, /gltf/], tangentsOf({}, { convention: "maya" }));
    refuses("invalidOption", [/vAxis/], tangentsOf({}, { convention: {} }));
    refuses("invalidOption", [/green/], tangentsOf({}, { convention: { vAxis: "up", green: 1 } }));
  });

  it("wrong types", () => {
    refuses("wrongType", [/^mesh must be an object, not null$/], () => generateTangents(null, options));
    refuses("wrongType", [/^mesh must be an object, not undefined$/], () => generateTangents(undefined, options));
    refuses("wrongType", [/^mesh must be an object, not a function$/], () => generateTangents(grid, options));
    refuses("wrongType", [/positions/, /Float64Array/, /Float32Array/], tangentsOf({ positions: new Float64Array(9) }));
    refuses("wrongType", [/positions must be a Float32Array, not an Array/], tangentsOf({ positions: [0, 0, 0] }));
    refuses("wrongType", [/uvs must be a Float32Array, not "uv"/], tangentsOf({ uvs: "uv" }));
    refuses("wrongType", [/indices must be a Uint32Array, Uint16Array or Uint8Array, not a Float32Array/], tangentsOf({ indices: new Float32Array(3) }));
    refuses("wrongType", [/not an Int32Array/], tangentsOf({ indices: new Int32Array(3) }));
    refuses("wrongType", [/faceSizes/], tangentsOf({ faceSizes: 4 }));
    refuses("wrongType", [/threshold must be a number, not "180"/], tangentsOf({}, { threshold: "180" }));
    refuses("wrongType", [/threshold must be a number, not NaN/], tangentsOf({}, { threshold: NaN }));
    refuses("wrongType", [/report must be an object, not 5/], tangentsOf({}, { report: 5 }));
    refuses("wrongType", [/normals must be an object, not true/], () => makeIndexedFrames(mesh, { ...options, normals: true }));
    refuses("wrongType", [/options/], () => generateTangents(mesh, "gltf"));
    refuses("wrongType", [/tangents/], () => sanitizeTangents(mesh, [...good]));
    refuses("wrongType", [/attributes/], () => splitVertices({ vertexCount: 3 }, {}));
    refuses("wrongType", [/attribute 0 must be an object, not undefined/], () => splitVertices({ vertexCount: 3 }, new Array(3)));
  });

  it("wrong options", () => {
    refuses("invalidOption", [/method must be one of mikktspace, lengyel/, /"mikkt"/], tangentsOf({}, { method: "mikkt" }));
    refuses("invalidOption", [/pairing/], tangentsOf({}, { pairing: "good" }));
    refuses("invalidOption", [/refine/], tangentsOf({}, { refine: 7 }));
    refuses("invalidOption", [/refine/], tangentsOf({}, { refine: -1 }));
    refuses("invalidOption", [/symmetric/], tangentsOf({}, { frame: "symmetric" }));
    refuses("invalidOption", [/crease/], () => generateNormals(mesh, { creaseAngle: 181 }));
    refuses("invalidOption", [/uvIndices/], () => triangulate({ ...mesh, uvIndices: mesh.indices }));
    refuses("invalidOption", [/weighting/], () => generateNormals(mesh, { weighting: "heavy" }));
  });

  it("unknown options, and lists the known ones", () => {
    const unknown = (words, body) => refuses("invalidOption", [/ is unknown; known names are /, ...words], body);
    const typo = { ...options, treshold: 90 };
    const words = [/^options\.treshold/, /method, threshold, pairing, ngons, convention, normalizeNormals, frame, refine/];
    unknown([...words, /report$/], () => generateTangents(mesh, typo));
    unknown(words, () => new Plan(mesh, typo));
    unknown([...words, /makeNormals, sanitize, orthogonalizeAll, normals/], () => makeIndexedFrames(mesh, typo));
    unknown([/^options\.threshold/, /weighting, creaseAngle/], () => generateNormals(mesh, { threshold: 90 }));
    unknown([/^normals\.crease /, /creaseAngle/], () => makeIndexedFrames(mesh, { ...options, normals: { crease: 90 } }));
    unknown([/^convention\.greenUp/, /vAxis, green/], tangentsOf({}, { convention: { vAxis: "up", greenUp: true } }));
    unknown([/^options\.orthogonalize /, /orthogonalizeAll/], () => sanitizeTangents(mesh, good, { orthogonalize: true }));
    const plan = new Plan(mesh, options);
    unknown([/^options\.convention/, /report/], () => plan.evaluate(mesh, options));
    plan.destroy();
    const attribute = { data: new Float32Array(3), size: 1, epsilon: 0 };
    unknown([/^attribute 0\.epsilon/, /tolerance/], () => splitVertices({ vertexCount: 3 }, [attribute]));
    unknown([/^options\.frame/], () => small.generateTangents(mesh, { ...options, frame: "symmetric" }));
  });

  it("unknown members of a mesh", () => {
    const unknown = (member, body) => refuses("invalidOption", [new RegExp(`\\.${member} is unknown; known names are positions, normals, uvs, indices, faceSizes`)], body);
    for (const member of ["normal", "index", "faceSize", "uv", "position"]) {
      const typo = { ...mesh, [member]: mesh.normals };
      const calls = [generateTangents, makeIndexedFrames, small.generateTangents];
      for (const call of calls) unknown(member, () => call(typo, options));
      unknown(member, () => new Plan(typo, options));
      for (const call of [generateNormals, triangulate, whole.generateNormals, whole.fixWinding, whole.measurePositionNoise]) unknown(member, () => call(typo));
      unknown(member, () => sanitizeTangents(typo, good));
    }
    const plan = new Plan(mesh, options);
    unknown("normal", () => plan.evaluate({ positions: mesh.positions, normal: mesh.normals }));
    plan.destroy();
    refuses("invalidOption", [/^vertices\.index is unknown; known names are indices, vertexCount$/], () => splitVertices({ vertexCount: 3, index: mesh.indices }, []));
  });

  it("thresholds out of range", () => {
    for (const threshold of [-1, 360.5, Infinity, -Infinity])
      refuses("invalidOption", [/^threshold must be a number from 0 to 360 degrees, not /], tangentsOf({}, { threshold }));
    for (const threshold of [NaN, "180"]) refuses("wrongType", [/^threshold must be a number, not /], tangentsOf({}, { threshold }));
    for (const threshold of [0, 360]) assert.equal(tangentsOf({}, { threshold })().length, good.length);
  });

  it("numbers below 0 where \"auto\" is possible", () => {
    const calls = [
      [plainNormals, ["creaseAngle", "weldDistance"]], [wholeNormals, ["creaseAngle", "weldDistance", "denoise"]],
      [(given) => makeIndexedFrames(mesh, { ...options, makeNormals: true, normals: { ...given, weighting: "best" } }), ["creaseAngle", "weldDistance"]],
      [(given) => whole.fixWinding(mesh, given), ["weldDistance"]],
    ];
    for (const [call, names] of calls)
      for (const name of names)
        for (const value of [-1, -1 - 1e-12, -0.5, -2, -Infinity])
          refuses("invalidOption", [new RegExp(`^${name} must be (a finite number of 0 or more|from 0 to \\d+), or "auto"$`)], () => call({ [name]: value }));
    refuses("invalidOption", [/^denoise must be from 0 to 4, or "auto"$/], () => plainNormals({ denoise: -1 }));
    refuses("wrongType", [/^weldDistance must be a number or "auto", not "automatic"$/], () => plainNormals({ weldDistance: "automatic" }));
  });

  it("null, except for arrays and functions", () => {
    for (const name of ["method", "threshold", "pairing", "ngons", "convention", "frame", "refine", "normalizeNormals", "report"])
      refuses(/threshold|normalizeNormals|report/.test(name) ? "wrongType" : "invalidOption", [new RegExp(`^${name} .*(null|missing)`)], tangentsOf({}, { [name]: null }));
    for (const name of ["weighting", "creaseAngle", "smoothingGroupsAreMasks", "weldPositions", "weldDistance", "refine", "denoise", "convention"])
      assert.throws(() => wholeNormals({ [name]: null }), ({ message }) => message.startsWith(`${name} `), name);
    for (const name of ["makeNormals", "sanitize", "orthogonalizeAll", "normals"])
      assert.throws(() => makeIndexedFrames(mesh, { ...options, [name]: null }), ({ message }) => message.startsWith(`${name} `), name);
    for (const name of ["useNormals", "weldPositions", "weldDistance", "convention"])
      assert.throws(() => whole.fixWinding(mesh, { [name]: null }), ({ message }) => message.startsWith(`${name} `), name);
    assert.throws(() => sanitizeTangents(mesh, good, { orthogonalizeAll: null }), { message: "orthogonalizeAll must be true or false, not null" });
    assert.deepEqual(generateTangents({ ...mesh, faceSizes: null }, { ...options, hasTangent: null }), good);
  });

  it("with the names that callers use", () => {
    const messages = [];
    const told = (body) => assert.throws(body, ({ message }) => messages.push(message) > 0);
    const few = Uint32Array.of(0, 1, 2);
    told(tangentsOf({ normalIndices: few }));
    told(tangentsOf({ uvIndices: few }));
    told(tangentsOf({ uvIndices: mesh.indices.map(() => 99) }));
    told(tangentsOf({ faceSizes: few }));
    told(() => generateNormals(mesh, { creaseAngle: 181 }));
    told(() => generateNormals(mesh, { smoothingGroups: few }));
    told(() => whole.generateNormals(mesh, { weighting: "best", denoise: 5 }));
    assert.match(messages.join(), /normalIndices.*uvIndices.*creaseAngle must be from 0 to 180, or "auto".*smoothingGroups/);
    for (const message of messages) assert.doesNotMatch(message, /[a-z]_[a-z]/);
  });

  it("masks of another size or type", () => {
    refuses("countMismatch", [/hasTangent has 3 entries, but needs 54/], tangentsOf({}, { hasTangent: new Uint8Array(3) }));
    refuses("wrongType", [/hasTangent must be a Uint8Array/], tangentsOf({}, { hasTangent: [] }));
  });

  it("wrong shapes", () => {
    refuses("countMismatch", [/positions has 10 numbers/], tangentsOf({ positions: new Float32Array(10) }));
    refuses("countMismatch", [/normals has 1 entries, but needs 16/], tangentsOf({ normals: new Float32Array(3) }));
    refuses("countMismatch", [/uvs has 17/], tangentsOf({ uvs: new Float32Array(34) }));
    refuses("countMismatch", [/face/], tangentsOf({ faceSizes: Uint32Array.of(3, 3) }));
    refuses("countMismatch", [/more than the 53 corners of the mesh/], tangentsOf({ indices: mesh.indices.subarray(1), faceSizes: new Uint8Array(18).fill(3) }));
    refuses("countMismatch", [/tangents has 1 entries/], () => sanitizeTangents(mesh, new Float32Array(4)));
    refuses("countMismatch", [/attribute 0/], () => splitVertices({ vertexCount: 3 }, [{ data: new Float32Array(4), size: 2 }]), 0);
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

  it("buffers that change during the call", () => {
    const shrinking = mesh.positions.slice();
    const detaches = { ...mesh, positions: shrinking, get uvIndices() { structuredClone(shrinking.buffer, { transfer: [shrinking.buffer] }); } };
    assert.throws(() => generateTangents(detaches, options), TypeError);
    assert.deepEqual(generateTangents(mesh, options), good);
    if (!ArrayBuffer.prototype.resize) return;
    const buffer = new ArrayBuffer(mesh.positions.byteLength, { maxByteLength: 1e7 });
    const positions = new Float32Array(buffer);
    positions.set(mesh.positions);
    assert.deepEqual(generateTangents({ ...mesh, positions, get uvIndices() { buffer.resize(1e7); } }, options), good);
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

describe("accepts", () => {
  it("values that are not finite", () => {
    const positions = mesh.positions.slice();
    positions[4] = NaN;
    positions[9] = Infinity;
    const tangents = generateTangents({ ...mesh, positions }, options);
    assert.equal(tangents.length, good.length);
    assert.ok(sanitizeTangents({ ...mesh, positions }, tangents).every(Number.isFinite));
    assert.equal(generateNormals({ ...mesh, positions }).length, 3 * mesh.indices.length);
  });

  it("views into larger buffers, and shared ones", () => {
    const bytes = new ArrayBuffer(mesh.positions.byteLength + 8);
    new Float32Array(bytes, 8).set(mesh.positions);
    assert.deepEqual(generateTangents({ ...mesh, positions: new Float32Array(bytes, 8) }, options), good);
    const shared = new Float32Array(new SharedArrayBuffer(mesh.positions.byteLength));
    shared.set(mesh.positions);
    assert.deepEqual(generateTangents({ ...mesh, positions: shared }, options), good);
  });

  it("arrays of another context", () => {
    const positions = runInNewContext("Float32Array.from(numbers)", { numbers: [...mesh.positions] });
    assert.ok(!(positions instanceof Float32Array));
    assert.deepEqual(generateTangents({ ...mesh, positions }, options), good);
  });
});

describe("running out of memory", () => {
  it("is an error, and the module works afterwards", () => {
    const plan = new Plan(mesh, options);
    // An invalid argument does not invalidate plans.
    assert.throws(() => generateTangents(mesh, { ...options, report: 5 }), TypeError);
    assert.throws(() => generateTangents(mesh, { ...options, report: Object.freeze({}) }), TypeError);
    assert.throws(() => generateTangents({ ...mesh, indices: new Uint8Array(2 ** 31) }, options), { code: "outOfMemory" });
    assert.deepEqual(plan.evaluate(mesh), good);
    const vertexCount = 2 ** 31 - 1; // 8 GB for the new vertices alone
    refuses("outOfMemory", [/memory/], () => splitVertices({ indices: Uint32Array.of(0), vertexCount }, [{ data: new Float32Array(1), size: 1 }]));
    assert.throws(() => plan.evaluate(mesh), { code: "planMismatch" });
    plan.destroy();
  });
});

after(() => assert.deepEqual(generateTangents(mesh, options), good));
