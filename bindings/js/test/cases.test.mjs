// SPDX-License-Identifier: MIT
// The cases that all languages share: tests/cases/arrays.json and files.json.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import * as core from "tspace";
import * as gltf from "tspace/gltf";
import * as normals from "tspace/normals";
import * as pack from "tspace/pack";
import * as small from "tspace/mikktspace";

await Promise.all([core.ready, gltf.ready, normals.ready, pack.ready, small.ready]);
const textOf = (name) => readFileSync(`${process.env.TSPACE_CASES ?? new URL("../../../tests/cases", import.meta.url).pathname}/${name}`);
const { meshes, cases } = JSON.parse(textOf("arrays.json"));

/** Options that this binding does not have: these cases are left to other languages. */
const lacks = ["domain"];
/** Options for which -1 in the table, as in C, is "auto" in JavaScript. */
const withAuto = ["crease_angle_deg", "denoise", "weld_distance"];
const choices = ["pairing", "ngons", "frame", "weighting"];

const camel = (name) => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
const snake = (name) => name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
const optionName = (name) => camel({ angular_threshold_deg: "threshold", crease_angle_deg: "crease_angle" }[name] ?? name);
const inSnakeCase = (object) => object && Object.fromEntries(Object.entries(object).map(([name, value]) => [snake(name), value]));
const withReport = (call) => {
  const report = {};
  return { ...call(report), report };
};

function meshOf({ face_size: size, ...mesh }) {
  const made = {};
  for (const [name, list] of Object.entries(mesh)) made[camel(name)] = (/s$/.test(name) && !/_/.test(name) && name !== "indices" ? Float32Array : Uint32Array).from(list);
  if (size) made.faceSizes = new Uint32Array(mesh.indices.length / size).fill(size);
  return made;
}

const calls = {
  tangents: (mesh, options) =>
    withReport((report) => {
      const hasTangent = new Uint8Array(mesh.indices?.length ?? mesh.positions.length / 3);
      const tangents = core.generateTangents(mesh, { ...options, hasTangent, report });
      const plan = new core.Plan(mesh, options);
      assert.deepEqual(plan.evaluate(mesh), tangents);
      plan.destroy();
      return { tangents, has_tangent: hasTangent };
    }),
  normals: (mesh, options) =>
    withReport((report) => ({ normals: normals.generateNormals(mesh, { ...options, smoothingGroups: options.smoothingGroups && Uint32Array.from(options.smoothingGroups), report }) })),
  position_noise: (mesh) => ({ report: normals.measurePositionNoise(mesh) }),
  sanitize: (mesh, { tangents, ...options }) =>
    withReport((report) => {
      const given = Float32Array.from(tangents), repaired = core.sanitizeTangents(mesh, given, { ...options, report });
      assert.deepEqual(small.sanitizeTangents(mesh, given, options), repaired);
      return { tangents: repaired };
    }),
  make_indexed_frames: (mesh, options) => {
    const { report, ...made } = core.makeIndexedFrames(mesh, options);
    return { ...inSnakeCase(made), ...Object.fromEntries(Object.entries(report).map(([step, counts]) => [`${step}_report`, counts])) };
  },
  mend_winding: (mesh, options) => normals.fixWinding(mesh, options),
  triangulate: (mesh) => core.triangulate(mesh),
  split: (_, { indices, vertexCount, attributes, tolerance }) => {
    const given = [{ indices: indices && Uint32Array.from(indices), vertexCount }, attributes.map(({ data, size }) => ({ data: Float32Array.from(data), size, tolerance }))];
    const made = core.splitVertices(...given);
    assert.deepEqual(small.splitVertices(...given), made);
    return inSnakeCase(made);
  },
  plan_buffers: (mesh, { indices, sourceCorners, normals, ...options }) => {
    const plan = new core.Plan(mesh, options), list = (numbers) => numbers && Uint32Array.from(numbers);
    const given = { indices: list(indices), sourceCorners: list(sourceCorners), mesh: normals && mesh, normals };
    return { words: core.planBuffers(plan, given).words };
  },
  pack: (_, { normals, tangents, format }) =>
    withReport((report) => {
      const bytes = pack.packFrames(Float32Array.from(normals), Float32Array.from(tangents), format, { report });
      return { bytes, ...pack.unpackFrames(bytes, format) };
    }),
};

describe("the cases of all languages", () => {
  for (const { name, call, mesh, change, options = {}, gives, error } of cases) {
    if (!calls[call] || lacks.some((option) => option in options)) continue;
    it(name, () => {
      const arrays = meshOf(Object.fromEntries(Object.entries({ ...meshes[mesh], ...change }).filter(([, list]) => list !== null)));
      const valueOf = (option, value) => (choices.includes(option) ? camel(value) : withAuto.includes(option) && value === -1 ? "auto" : value);
      const given = Object.fromEntries(Object.entries(options).map(([option, value]) => [optionName(option), valueOf(option, value)]));
      const run = () => calls[call](arrays, given);
      if (error) return assert.throws(run, (thrown) => thrown.code === error.code && thrown.element === (error.element ?? thrown.element));
      const made = run();
      for (const [output, wanted] of Object.entries(gives)) {
        if (!(output in made)) continue;
        const got = made[output];
        if (Array.isArray(wanted)) assert.deepEqual(got, got.constructor.from(wanted), output);
        else if (wanted === null) assert.equal(got, null, output);
        else for (const [field, value] of Object.entries(wanted)) assert.equal(inSnakeCase(got)[field.replace(/_deg$/, "")], value, `${output}.${field}`);
      }
    });
  }
});

describe("the cases of all languages, for files", () => {
  const table = textOf("files.json");
  for (const { name, call, change, options = {}, gives, error } of JSON.parse(table).cases) {
    it(name, () => {
      const { model } = JSON.parse(table);
      if (change) {
        const [path, value] = change, keys = path.split("/"), last = keys.pop(), parent = keys.reduce((at, key) => at[key], model);
        parent[last] = value ?? undefined;
      }
      const given = Object.fromEntries(Object.entries(options).map(([option, value]) => [camel(option.replaceAll("-", "_")), value]));
      const bytes = new TextEncoder().encode(JSON.stringify(model));
      const run = () => (call === "diff" ? gltf.diff(bytes, bytes, given) : call === "generate" ? gltf.generate(bytes, given).report : gltf[call](bytes, given));
      if (error) return assert.throws(run, { code: error });
      const report = run();
      for (const [path, wanted] of Object.entries(gives)) assert.deepEqual(path.split("/").reduce((at, key) => at[key], report), wanted, path);
    });
  }
});
