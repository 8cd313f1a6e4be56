// SPDX-License-Identifier: MIT
// The whole core, for the entries that load its module.
import { makeCalls, meshOf, mikktspaceOptions, sanitizeCounts, setMesh, tangentArguments, tangentCounts, writeTangents } from "./calls.js";
import { boolean, fail, floats, object, optionsOf } from "./check.js";
import { normalArguments, normalCounts, normalOptions, normalsOf } from "./normal_calls.js";
import { Wasm } from "./wasm.js";

const wasm = new Wasm();
/** Loads the module, once, from where `source` says. */
export const start = (source) => wasm.start(source);

const methods = ["mikktspace", "lengyel", "uniform", "angle", "area", "flat", "basis", "fast", "best"];
const tangentOptions = [...mikktspaceOptions, "frame", "refine"];
const choices = { methods, ngons: ["triangulate", "skip"], options: tangentOptions };
const steps = ["makeNormals", "sanitize", "orthogonalizeAll"];

export const { generateTangents, sanitizeTangents, splitVertices } = makeCalls(wasm, choices);
export const generateNormals = normalsOf(wasm, false);

export function triangulate(mesh) {
  const { positions, uvs, indices, faceSizes, uvIndices } = object(mesh, "mesh");
  if (uvIndices) fail("invalidOption", "triangulate takes no uvIndices");
  const checked = meshOf({ positions, uvs, indices, faceSizes });
  return wasm.run((call) => {
    setMesh(call, checked);
    const { cornerCount } = checked, faces = [];
    const out = call.allocate(12 * cornerCount + 16);
    call.check(call.wasm.triangulate(out));
    (checked.faceSizes ?? new Uint8Array(cornerCount / 3).fill(3)).forEach((size, face) => {
      while (size-- > 2) faces.push(face);
    });
    return { corners: call.get(Uint32Array, out, 3 * faces.length), faces: Uint32Array.from(faces) };
  });
}

export function makeIndexedFrames(mesh, options = {}) {
  optionsOf(options, [...tangentOptions, ...steps, "normals", "report"]);
  const tangents = tangentArguments(options, choices);
  const chosen = steps.map((name) => boolean(options[name] ?? name === "sanitize", name));
  const normals = normalArguments(object(options.normals ?? {}, "normals", normalOptions), false);
  const checked = meshOf(mesh);
  return wasm.run((call) => {
    setMesh(call, checked);
    const result = call.allocate(40);
    call.check(call.wasm.makeIndexedFrames(...tangents, ...chosen, ...normals(call), result));
    const words = call.get(Uint32Array, result, 10);
    const take = (Type, i, size) => call.take(Type, words[2 * i], size * words[2 * i + 1]);
    const report = {
      normals: chosen[0] || !checked.normals ? call.report(normalCounts, {}, 22) : null,
      tangents: call.report(tangentCounts, {}),
      sanitize: chosen[1] ? call.report(sanitizeCounts, {}, 9) : null,
    };
    Object.assign(options.report ?? {}, report);
    return {
      indices: take(Uint32Array, 0, 1),
      sourceVertices: take(Uint32Array, 1, 1),
      sourceCorners: take(Uint32Array, 2, 1),
      normals: take(Float32Array, 3, 3),
      tangents: take(Float32Array, 4, 4),
      report,
    };
  });
}

const forgotten = new FinalizationRegistry((end) => end());

export class Plan {
  #module;
  #place = 0;
  #end;

  constructor(mesh, options = {}) {
    optionsOf(options, tangentOptions);
    const given = tangentArguments(options, choices);
    const checked = meshOf(mesh);
    wasm.run((call) => {
      setMesh(call, checked);
      const to = call.allocate(4);
      call.check(call.wasm.makePlan(...given, to));
      this.#module = call.wasm;
      [this.#place] = call.get(Uint32Array, to, 1);
    });
    const [module, place] = [this.#module, this.#place];
    this.#end = () => module.destroyPlan(place);
    this.vertexCount = checked.vertexCount;
    this.cornerCount = checked.cornerCount;
    forgotten.register(this, this.#end, this);
  }

  /** The module that holds the plan. */
  #held() {
    if (this.#place === 0) fail("planMismatch", "this plan was destroyed");
    // A call that runs out of memory ends the instance, and all that lies there.
    if (this.#module !== wasm.exports) fail("planMismatch", "a call ran out of memory, and this plan with it: make it anew");
    return this.#module;
  }

  get memoryBytes() {
    return this.#held().planBytes(this.#place) >>> 0;
  }

  evaluate(pose, options = {}) {
    object(pose, "pose");
    optionsOf(options, ["report"]);
    const positions = floats(pose.positions, "positions", 3, true);
    const normals = floats(pose.normals, "normals", 3, true);
    this.#held();
    return writeTangents(wasm, { positions, normals }, this.cornerCount, options, (module, out) =>
      module.evaluatePlan(this.#place, out));
  }

  destroy() {
    if (this.#place === 0) return;
    forgotten.unregister(this);
    this.#end();
    this.#place = 0;
  }
}

/** Memory of the module, which grows to what the largest call needs, and plans. */
export const memoryBytes = () => wasm.exports.memory.buffer.byteLength;
