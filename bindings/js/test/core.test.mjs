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

  it("take indices of each size, and meshes without", () => {
    const options = { convention: "gltf" };
    const wanted = generateTangents(mesh, options);
    assert.deepEqual(generateTangents({ ...mesh, indices: Uint16Array.from(mesh.indices) }, options), wanted);
    const unindexed = {};
    for (const [name, size] of [["positions", 3], ["normals", 3], ["uvs", 2]])
      unindexed[name] = Float32Array.from([...mesh.indices].flatMap((v) => [...mesh[name].subarray(size * v, size * v + size)]));
    assert.deepEqual(generateTangents(unindexed, options), wanted);
  });

  it("repair tangents in a copy", () => {
    const broken = generateTangents(mesh, { convention: "gltf" });
    broken[0] = NaN;
    assert.ok(sanitizeTangents(mesh, broken).every(Number.isFinite));
    assert.ok(Number.isNaN(broken[0]));
  });

  it("evaluate a plan in another pose like a separate call", () => {
    const plan = new Plan(mesh, { convention: "gltf", method: "angle" });
    const pose = { positions: mesh.positions.map((x) => 2 * x), normals: mesh.normals };
    assert.deepEqual(plan.evaluate(pose), generateTangents({ ...mesh, ...pose }, { convention: "gltf", method: "angle" }));
    assert.ok(plan.memoryBytes > 0);
    plan.destroy();
    plan.destroy();
    assert.throws(() => plan.evaluate(pose), { code: "planMismatch" });
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

  it("release their memory on request", () => {
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

  it("report each step like a separate call, and null for a skipped one", () => {
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
});
