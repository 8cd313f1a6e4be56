// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { describe, it } from "node:test";
import * as small from "tspace/mikktspace";
import * as whole from "tspace";
import { differences, readGolden } from "./golden.mjs";
import { grid } from "./meshes.mjs";

await Promise.all([whole.ready, small.ready]);
const { generateNormals, generateTangents, Plan, sanitizeTangents, splitVertices } = whole;

const folder = process.env.TSPACE_GOLDEN ?? new URL("../../../shared/golden/mikktspace", import.meta.url).pathname;
const golden = existsSync(folder)
  ? readdirSync(folder)
      .filter((name) => name.endsWith(".tsg"))
      .map((name) => {
        const bytes = readFileSync(`${folder}/${name}`);
        return { name, ...readGolden(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)) };
      })
      .filter((one) => one.isPromised)
  : [];

describe("the golden meshes of MikkTSpace", { skip: golden.length === 0 && `${folder} is not here` }, () => {
  const check = (compute) => {
    assert.ok(golden.length > 300);
    for (const { name, mesh, threshold, wanted } of golden) {
      const options = { convention: "opengl", threshold, ngons: "skip" };
      assert.equal(differences(compute(mesh, options), wanted), 0, name);
    }
  };
  it("get the same bits", () => check(whole.generateTangents));
  it("get the same bits from the small module", () => check(small.generateTangents));
  it("get the same bits from plans", () =>
    check((mesh, options) => {
      const plan = new Plan(mesh, options);
      const tangents = plan.evaluate(mesh);
      plan.destroy();
      return tangents;
    }));
});

describe("calls", () => {
  const mesh = grid(12);

  it("give four numbers per corner, unit and across the normal", () => {
    for (const method of ["mikktspace", "lengyel", "uniform", "angle", "area", "flat", "basis", "fast", "best"]) {
      const tangents = generateTangents(mesh, { method, convention: "gltf" });
      assert.equal(tangents.length, 4 * mesh.indices.length);
      for (let c = 0; c < mesh.indices.length; ++c) {
        const [x, y, z, w] = tangents.subarray(4 * c, 4 * c + 4);
        const n = mesh.normals.subarray(3 * mesh.indices[c], 3 * mesh.indices[c] + 3);
        assert.ok(Math.abs(Math.hypot(x, y, z) - 1) < 1e-5 && Math.abs(w) === 1, method);
        assert.ok(Math.abs(x * n[0] + y * n[1] + z * n[2]) < 1e-5, method);
      }
    }
  });

  it("scale normals to length 1 first where normalizeNormals says so", () => {
    const longer = { ...mesh, normals: mesh.normals.map((x) => 4 * x) };
    for (const entry of [whole, small]) {
      const wanted = entry.generateTangents(mesh, { convention: "gltf" });
      const made = entry.generateTangents(longer, { convention: "gltf", normalizeNormals: true });
      made.forEach((x, i) => assert.ok(Math.abs(x - wanted[i]) < 1e-5));
      assert.throws(() => entry.generateTangents(mesh, { convention: "gltf", normalizeNormals: 1 }), TypeError);
    }
  });

  it("turn the sign over where v runs the other way", () => {
    const [a, b] = ["gltf", "opengl"].map((convention) => generateTangents(mesh, { convention }));
    assert.ok(a.every((x, i) => x === (i % 4 === 3 ? -b[i] : b[i])));
    assert.deepEqual(generateTangents(mesh, { convention: { vAxis: "down" } }), a);
  });

  it("take indices of each size, and meshes without", () => {
    const options = { convention: "gltf" };
    const wanted = generateTangents(mesh, options);
    assert.deepEqual(generateTangents({ ...mesh, indices: Uint16Array.from(mesh.indices) }, options), wanted);
    const unindexed = {};
    for (const [name, size] of [["positions", 3], ["normals", 3], ["uvs", 2]])
      unindexed[name] = Float32Array.from([...mesh.indices].flatMap((v) => [...mesh[name].subarray(size * v, size * v + size)]));
    assert.deepEqual(generateTangents(unindexed, options), wanted);
  });

  it("cut quads and n-gons", () => {
    const square = {
      positions: Float32Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0),
      normals: Float32Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1),
      uvs: Float32Array.of(0, 0, 1, 0, 1, 1, 0, 1),
      faceSizes: Uint8Array.of(4),
    };
    const report = {};
    const tangents = generateTangents(square, { convention: "opengl", report });
    assert.deepEqual([...tangents], [1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1]);
    assert.equal(report.triangleCount, 2);
    assert.equal(report.groupCount, 4);
  });

  it("cut polygons into triangles: quads by MikkTSpace's rule, others by ears", () => {
    // Three quads and a triangle that share vertices: the longer diagonal is 0-2, then 1-3; then both are equal.
    const quads = {
      positions: Float32Array.of(0, 0, 0, 2, 0, 0, 3, 1, 0, 0, 1, 0, 5, 0, 0, 9, 0, 0, 9, 1, 0, 4, 1, 0),
      indices: Uint16Array.of(0, 1, 2, 3, 0, 1, 2, 4, 5, 6, 7),
      faceSizes: Uint8Array.of(4, 3, 4),
    };
    assert.deepEqual(Object.values(whole.triangulate(quads)).map((list) => [...list]), [[0, 1, 3, 1, 2, 3, 4, 5, 6, 7, 8, 9, 7, 9, 10], [0, 0, 1, 2, 2]]);
    const uvs = new Float32Array(16);
    uvs.set([0, 0, 4, 0, 1, 1, 0, 1]); // in UVs 0-2 is the shorter diagonal
    assert.deepEqual([...whole.triangulate({ ...quads, uvs }).corners.subarray(0, 6)], [0, 1, 2, 0, 2, 3]);

    // The letter L without indices, followed by a face of two corners, which produces no triangle.
    const letter = [0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3];
    const positions = Float32Array.from([...letter, 5, 5, 6, 6].flatMap((x, i) => (i % 2 ? [x, 0] : [x])));
    const { corners, faces } = whole.triangulate({ positions, faceSizes: Uint32Array.of(6, 2) });
    assert.deepEqual([...faces], [0, 0, 0, 0]);
    const areas = [0, 3, 6, 9].map((at) => {
      const [[ax, ay], [bx, by], [cx, cy]] = [0, 1, 2].map((k) => letter.slice(2 * corners[at + k], 2 * corners[at + k] + 2));
      return ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2;
    });
    assert.ok(areas.every((area) => area > 0));
    assert.equal(areas.reduce((sum, area) => sum + area), 5);
    assert.deepEqual([...whole.triangulate(mesh).corners], [...mesh.indices.keys()]);
    assert.throws(() => whole.triangulate({ ...quads, faceSizes: Uint32Array.of(4, 3, 0xffffffff) }), { code: "countMismatch" });
    assert.throws(() => whole.triangulate({ ...quads, uvIndices: quads.indices }), { code: "invalidOption" });
  });

  it("mend what is broken, and nothing else", () => {
    const sound = generateTangents(mesh, { convention: "gltf" });
    const broken = sound.slice();
    broken[0] = NaN;
    broken[4 * 7 + 3] = 0;
    const report = {};
    const mended = sanitizeTangents(mesh, broken, { report });
    assert.ok(Number.isNaN(broken[0]), "the input stays");
    assert.ok(mended.every(Number.isFinite));
    assert.equal(report.mendedCount, 2);
    assert.equal(report.notFiniteCount, 1);
    assert.deepEqual(mended.subarray(32), sound.subarray(32));
    assert.deepEqual(small.sanitizeTangents(mesh, broken), mended);
  });

  it("split vertices whose corners disagree", () => {
    const indices = Uint32Array.of(0, 1, 2, 0, 2, 3);
    const data = Float32Array.of(1, 2, 3, 9, 3, 4);
    for (const split of [splitVertices, small.splitVertices]) {
      const { indices: to, sourceVertices, sourceCorners } = split({ indices, vertexCount: 4 }, [{ data, size: 1 }]);
      assert.deepEqual([...to], [0, 1, 2, 4, 2, 3]);
      assert.deepEqual([...sourceVertices], [0, 1, 2, 3, 0]);
      assert.deepEqual([...sourceCorners], [0, 1, 2, 5, 3]);
      to.forEach((v, c) => assert.equal(data[sourceCorners[v]], data[c]));
    }
  });

  it("make normals", () => {
    const report = {};
    const normals = generateNormals(mesh, { report });
    assert.equal(report.faceCount, mesh.indices.length / 3);
    mesh.indices.forEach((v, c) => {
      const [n, wanted] = [normals.subarray(3 * c, 3 * c + 3), mesh.normals.subarray(3 * v, 3 * v + 3)];
      assert.ok(n[0] * wanted[0] + n[1] * wanted[1] + n[2] * wanted[2] > 0.9);
    });
    const flat = generateNormals(mesh, { weighting: "flat" });
    assert.deepEqual(flat, generateNormals(mesh, { creaseAngle: 0 }).map((x, i) => (Math.abs(x - flat[i]) < 1e-5 ? flat[i] : x)));
  });

  it("evaluate a plan in another pose as a call of its own would", () => {
    const plan = new Plan(mesh, { convention: "gltf", method: "angle" });
    const pose = { positions: mesh.positions.map((x) => 2 * x), normals: mesh.normals };
    assert.deepEqual(plan.evaluate(pose), generateTangents({ ...mesh, ...pose }, { convention: "gltf", method: "angle" }));
    assert.ok(plan.memoryBytes > 0);
    plan.destroy();
    plan.destroy();
    assert.throws(() => plan.evaluate(pose), { code: "planMismatch" });
  });

  it("say which corners no face gives a tangent", () => {
    const uvs = mesh.uvs.slice().fill(0.5, 0, 40);
    const alone = { positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0), normals: new Float32Array(18).map((_, i) => (i % 3 === 2 ? 1 : 0)), uvs: Float32Array.of(0, 0, 1, 0, 0, 1, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5) };
    for (const given of [alone, { ...mesh, uvs }]) {
      const count = (given.indices ?? given.positions).length / (given.indices ? 1 : 3);
      for (const { generateTangents, methods } of [{ ...whole, methods: ["mikktspace", "best", "lengyel", "flat"] }, { ...small, methods: ["mikktspace"] }]) {
        for (const method of methods) {
          const [hasTangent, report] = [new Uint8Array(count).fill(7), {}];
          const tangents = generateTangents(given, { convention: "opengl", method, hasTangent, report });
          assert.equal(hasTangent.filter((has) => has === 0).length, report.defaultCornerCount, method);
          assert.ok(hasTangent.every((has) => has <= 1));
          if (given === alone) assert.deepEqual([...hasTangent], [1, 1, 1, 0, 0, 0], method);
          assert.deepEqual(generateTangents(given, { convention: "opengl", method }), tangents);
          if (generateTangents !== whole.generateTangents) continue;
          const plan = new Plan(given, { convention: "opengl", method }), posed = new Uint8Array(count);
          plan.evaluate(given, { hasTangent: posed });
          assert.deepEqual(posed, hasTangent);
          plan.destroy();
        }
      }
    }
  });

  it("report options that had no effect", () => {
    const ignoredBy = (options) => {
      const report = { ignoredOptions: ["old"] };
      generateTangents(mesh, { convention: "gltf", report, ...options });
      return report.ignoredOptions;
    };
    assert.equal(ignoredBy({}), undefined);
    assert.equal(ignoredBy({ threshold: 90, pairing: "corrected" }), undefined);
    assert.deepEqual(ignoredBy({ refine: 1 }), ["refine"]);
    assert.deepEqual(ignoredBy({ method: "best", refine: 1, threshold: 180, pairing: "reference" }), ["threshold", "pairing"]);
    assert.deepEqual(new Plan(mesh, { convention: "gltf", method: "fast", refine: 2 }).ignoredOptions, ["refine"]);
    const report = {};
    generateNormals(mesh, { refine: 1, smoothingGroupsAreMasks: true, report });
    assert.deepEqual(report.ignoredOptions, ["smoothingGroupsAreMasks", "refine"]);
    const { makeIndexedFrames } = whole;
    const frames = makeIndexedFrames(mesh, { convention: "gltf", refine: 2, sanitize: false, orthogonalizeAll: true, normals: { weighting: "area" } });
    assert.deepEqual(frames.report.ignoredOptions, ["refine", "orthogonalizeAll", "normals.weighting"]);
    const made = makeIndexedFrames(mesh, { convention: "gltf", makeNormals: true, normals: { weighting: "flat", creaseAngle: 30 } });
    assert.deepEqual(made.report.ignoredOptions, ["normals.creaseAngle"]);
  });

  it("give their memory back when asked", () => {
    const options = { convention: "gltf" };
    const wanted = generateTangents(mesh, options);
    const plan = new Plan(mesh, options);
    const large = grid(300);
    generateTangents(large, options);
    const used = whole.memoryBytes();
    whole.release();
    assert.equal(whole.memoryBytes(), 0);
    assert.deepEqual(generateTangents(mesh, options), wanted);
    assert.ok(whole.memoryBytes() < used / 2);
    assert.throws(() => plan.evaluate(mesh), { code: "planMismatch", message: /release/ });
    plan.destroy();
    const next = new Plan(mesh, options);
    assert.deepEqual(next.evaluate(mesh), wanted);
    next.destroy();
    small.release();
    assert.deepEqual(small.generateTangents(mesh, options), wanted);
  });

  it("keep their memory from call to call", () => {
    const options = { convention: "gltf" };
    const once = () => {
      const tangents = generateTangents(mesh, options);
      splitVertices({ indices: mesh.indices, vertexCount: mesh.positions.length / 3 }, [{ data: sanitizeTangents(mesh, tangents), size: 4 }]);
      generateNormals(mesh, { weighting: "best" });
      const plan = new Plan(mesh, { ...options, method: "best" });
      plan.evaluate(mesh);
      plan.destroy();
    };
    once();
    const bytes = whole.memoryBytes();
    for (let i = 0; i < 1000; ++i) once();
    assert.equal(whole.memoryBytes(), bytes);
  });
});

describe("tangents of many meshes", () => {
  const { generateTangentsOfMeshes, TspaceError } = whole;

  it("are those of single calls, and errors stay with their jobs", () => {
    const jobs = [3, 5, 8].map((side) => ({ mesh: grid(side), options: { convention: "gltf" } }));
    const broken = { ...grid(3), indices: new Uint32Array([0, 1, 1000]) };
    const given = [...jobs, { mesh: broken, options: { convention: "gltf" } }, { mesh: grid(3), options: { conventoin: "gltf" } }, jobs[1]];
    const results = generateTangentsOfMeshes(given);
    assert.equal(results.length, given.length);
    for (const i of [0, 1, 2, 5]) assert.deepEqual(results[i], generateTangents(given[i].mesh, given[i].options));
    assert.equal(results[3].code, "indexOutOfRange");
    assert.ok(results[3] instanceof TspaceError && results[4] instanceof TypeError);
    assert.deepEqual(generateTangentsOfMeshes([]), []);
    assert.throws(() => generateTangentsOfMeshes(jobs[0]), TypeError);
  });
});

describe("indexed frames in one call", () => {
  const { makeIndexedFrames } = whole;
  const mesh = grid(8);

  it("give each corner what the single calls give", () => {
    const frames = makeIndexedFrames(mesh, { convention: "gltf" });
    const wanted = sanitizeTangents(mesh, generateTangents(mesh, { convention: "gltf" }));
    assert.equal(frames.indices.length, mesh.indices.length);
    frames.indices.forEach((v, c) => {
      assert.deepEqual(frames.tangents.subarray(4 * v, 4 * v + 4), wanted.subarray(4 * c, 4 * c + 4));
      assert.equal(frames.sourceVertices[v], mesh.indices[c]);
      assert.deepEqual(frames.normals.subarray(3 * v, 3 * v + 3), mesh.normals.subarray(3 * mesh.indices[c], 3 * mesh.indices[c] + 3));
    });
    assert.equal(frames.report.tangents.triangleCount, mesh.indices.length / 3);
    assert.equal(frames.sourceCorners.length, frames.sourceVertices.length);
  });

  it("report each step as its own call does, and null for one that was left out", () => {
    const broken = { ...mesh, uvs: mesh.uvs.slice().fill(0.5, 0, 12), indices: mesh.indices.slice() };
    broken.indices[4] = broken.indices[3]; // a face without area
    const [tangents, sanitize, normals] = [{}, {}, {}];
    sanitizeTangents(broken, generateTangents(broken, { convention: "gltf", report: tangents }), { report: sanitize });
    const given = {};
    const { report } = makeIndexedFrames(broken, { convention: "gltf", report: given });
    assert.ok(sanitize.mendedCount > 0 && tangents.degenerateUvCount > 0);
    assert.deepEqual(report, { normals: null, tangents, sanitize });
    assert.deepEqual(given, report);
    generateNormals(broken, { report: normals });
    assert.ok(normals.degenerateFaceCount > 0);
    const made = makeIndexedFrames(broken, { convention: "gltf", makeNormals: true, sanitize: false }).report;
    assert.deepEqual([made.normals, made.sanitize], [normals, null]);
    assert.deepEqual(makeIndexedFrames({ ...broken, normals: undefined }, { convention: "gltf" }).report.normals, normals);
  });

  it("make normals where there are none, and take an index list per attribute", () => {
    const { positions, uvs, indices } = mesh;
    const frames = makeIndexedFrames({ positions, uvs, indices }, { convention: "gltf", normals: { weighting: "area" } });
    assert.equal(frames.normals.length, 3 * frames.sourceVertices.length);
    const lists = { ...mesh, normalIndices: indices, uvIndices: Uint16Array.from(indices) };
    assert.deepEqual(generateTangents(lists, { convention: "gltf" }), generateTangents(mesh, { convention: "gltf" }));
    assert.throws(() => makeIndexedFrames(mesh, {}), { code: "invalidOption" });
  });
});
