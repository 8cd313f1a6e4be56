// SPDX-License-Identifier: MIT
// The whole core, shared by the entries that load its module.
import { givenMesh, ignoredOptions, makeCalls, meshOf, mikktspaceOptions, setMesh, tangentArguments, withIgnored, writeTangents } from "./calls.js";
import { boolean, fail, failType, floats, integers, isMissing, object, optionsOf, valueOr } from "./check.js";
import { TspaceError } from "./error.js";
import { methodNames, ngonsNames, normalReportNames, sanitizeReportNames, tangentReportNames } from "./names.js";
import { ignoredNormalOptions, normalSetter, normalOptions, normalsOf } from "./normal_calls.js";
import { Wasm } from "./wasm.js";

const wasm = new Wasm();
/** Loads the module once, from `source`. */
export const start = (source) => wasm.start(source);

const tangentOptions = [...mikktspaceOptions, "frame", "refine"];
const choices = { methods: methodNames, ngons: ngonsNames, options: tangentOptions };
const steps = ["makeNormals", "sanitize", "orthogonalizeAll"];

export const { generateTangents, sanitizeTangents, splitVertices } = makeCalls(wasm, choices);
export const generateNormals = normalsOf(wasm, false);

export function generateTangentsOfMeshes(jobs) {
  if (!Array.isArray(jobs)) failType(jobs, "jobs", "an array of { mesh, options }");
  return jobs.map((job) => {
    const { mesh, options } = object(job, "job", ["mesh", "options"]);
    try {
      return generateTangents(mesh, options);
    } catch (error) {
      if (error instanceof TspaceError) return error;
      throw error;
    }
  });
}

export function triangulate(mesh) {
  const { positions, uvs, indices, faceSizes, uvIndices } = givenMesh(mesh);
  if (uvIndices) fail("invalidOption", "triangulate does not support uvIndices");
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

/** Returns the names of given options of makeIndexedFrames that have no effect. */
function ignoredFrameOptions(options, makesNormals) {
  const normals = options.normals ?? {};
  const ofNormals = makesNormals ? ignoredNormalOptions(normals) : Object.keys(normals).filter((name) => !isMissing(normals[name]));
  const ofSanitize = options.sanitize === false && options.orthogonalizeAll ? ["orthogonalizeAll"] : [];
  return [...ignoredOptions(options), ...ofSanitize, ...ofNormals.map((name) => `normals.${name}`)];
}

export function makeIndexedFrames(mesh, options = {}) {
  optionsOf(options, [...tangentOptions, ...steps, "normals", "report"]);
  const tangents = tangentArguments(options, choices);
  const chosen = steps.map((name) => boolean(valueOr(options[name], name === "sanitize"), name));
  const setNormalOptions = normalSetter(object(valueOr(options.normals, {}), "normals", normalOptions), false);
  const checked = meshOf(mesh);
  return wasm.run((call) => {
    setMesh(call, checked);
    const result = call.allocate(40);
    call.wasm.setTangentOptions(...tangents);
    setNormalOptions(call);
    call.check(call.wasm.makeIndexedFrames(...chosen, result));
    const words = call.get(Uint32Array, result, 10);
    const take = (Type, i, size) => call.take(Type, words[2 * i], size * words[2 * i + 1]);
    const makesNormals = chosen[0] || !checked.normals;
    const report = withIgnored({
      normals: makesNormals ? call.report(normalReportNames, {}, tangentReportNames.length + sanitizeReportNames.length) : null,
      tangents: call.report(tangentReportNames, {}),
      sanitize: chosen[1] ? call.report(sanitizeReportNames, {}, tangentReportNames.length) : null,
    }, ignoredFrameOptions(options, makesNormals));
    if (options.report) Object.assign(withIgnored(options.report, []), report);
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

/** An exported plan: its words, and views of the arrays in them. */
class PlanBuffers {
  constructor(words) {
    const array = (first, count) => words.subarray(words[first], words[first] + count);
    this.words = words;
    this.results = array(8, 3 * words[4]);
    this.entries = array(9, words[5]);
    this.triangles = array(10, words[6] * words[7]);
    this.resultCount = words[4];
    this.triangleCount = words[6];
    this.makesNormals = (words[2] & 1) !== 0;
  }
}

/** Set by the class, which keeps the address of a plan private. */
export let planBuffers;

export class Plan {
  static {
    planBuffers = (plan, options = {}) => {
      if (!(#place in Object(plan))) failType(plan, "plan", "a Plan");
      object(options, "options", ["indices", "sourceCorners", "mesh", "normals"]);
      const lists = ["indices", "sourceCorners"].map((name) => integers(options[name], name));
      const checked = isMissing(options.mesh) ? undefined : meshOf(options.mesh);
      const setNormalOptions = normalSetter(object(valueOr(options.normals, {}), "normals", [...normalOptions, "convention"]), false);
      plan.#held();
      return wasm.run((call) => {
        if (checked) setMesh(call, checked);
        const arrays = lists.flatMap((list) => [call.put(list, Uint32Array), list?.length ?? 0]);
        const result = call.allocate(8);
        setNormalOptions(call);
        call.check(call.wasm.planBuffers(plan.#place, ...arrays, checked !== undefined, result));
        return new PlanBuffers(call.take(Uint32Array, ...call.get(Uint32Array, result, 2)));
      });
    };
  }

  #instance;
  #place = 0;
  #end;

  constructor(mesh, options = {}) {
    optionsOf(options, tangentOptions);
    const given = tangentArguments(options, choices);
    const checked = meshOf(mesh);
    wasm.run((call) => {
      setMesh(call, checked);
      const to = call.allocate(4);
      call.wasm.setTangentOptions(...given);
      call.check(call.wasm.makePlan(to));
      this.#instance = wasm.instance;
      [this.#place] = call.get(Uint32Array, to, 1);
    });
    const [instance, place] = [this.#instance, this.#place];
    this.#end = () => instance.exports?.destroyPlan(place);
    this.ignoredOptions = ignoredOptions(options);
    this.vertexCount = checked.vertexCount;
    this.cornerCount = checked.cornerCount;
    forgotten.register(this, this.#end, this);
  }

  /** Returns the module that holds the plan. */
  #held() {
    if (this.#place === 0) fail("planMismatch", "this plan was destroyed");
    const module = this.#instance.exports;
    if (!module) fail("planMismatch", "this plan was invalidated by release() or by an out-of-memory error; create a new plan");
    return module;
  }

  get memoryBytes() {
    return this.#held().planBytes(this.#place) >>> 0;
  }

  evaluate(pose, options = {}) {
    givenMesh(pose, "pose");
    optionsOf(options, ["hasTangent", "report"]);
    const positions = floats(pose.positions, "positions", 3, true);
    const normals = floats(pose.normals, "normals", 3, true);
    this.#held();
    return writeTangents(wasm, { positions, normals }, this.cornerCount, options, (module, ...places) =>
      module.evaluatePlan(this.#place, ...places));
  }

  /** Called by "tspace/webgpu", which does not load this module, to export a plan. */
  [Symbol.for("tspace.planBuffers")](options) {
    return planBuffers(this, options);
  }

  destroy() {
    if (this.#place === 0) return;
    forgotten.unregister(this);
    this.#end();
    this.#place = 0;
  }
}

/**
 * Returns the size of the module's memory in bytes: it grows to the size that the largest call and all plans need, and
 * is 0 after release().
 */
export const memoryBytes = () => wasm.memoryBytes();

/** Releases the module's memory, and invalidates all plans. The next call starts with little memory. */
export const release = () => wasm.release();
