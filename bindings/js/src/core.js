// SPDX-License-Identifier: MIT
// The whole core, for the entries that load its module.
import { keepReport, makeCalls, meshOf, mikktspaceOptions, setMesh, tangentArguments, tangentCounts, writeTangents } from "./calls.js";
import { boolean, choice, count, fail, floats, integers, number, object, optionsOf } from "./check.js";
import { conventionBits } from "./convention.js";
import { Wasm } from "./wasm.js";

const wasm = new Wasm();
/** Loads the module, once, from where `source` says. */
export const start = (source) => wasm.start(source);

const methods = ["mikktspace", "lengyel", "uniform", "angle", "area", "flat", "basis", "fast", "best"];
const tangentOptions = [...mikktspaceOptions, "frame", "refine"];
const choices = { methods, ngons: ["triangulate", "skip"], options: tangentOptions };
const weightings = ["flat", "uniform", "area", "angle", "angleArea", "max", "best"];
const normalOptions = ["weighting", "creaseAngle", "smoothingGroups", "smoothingGroupsAreMasks", "weldPositions", "refine", "denoise"];
const steps = ["makeNormals", "sanitize", "orthogonalizeAll"];
const windingCounts = [
  "faceCount", "turnedCount", "conflictCountBefore", "conflictCountAfter", "componentCount", "turnedComponentCount", "byNormalsCount",
  "byVolumeCount", "byNestingCount", "byWindingNumberCount", "byMajorityCount", "smallCount", "oneSidedCount",
];
const normalCounts = ["faceCount", "degenerateFaceCount", "fallbackCornerCount", "noise", "creaseAngle"];

export const { generateTangents, sanitizeTangents, splitVertices } = makeCalls(wasm, choices);

const numberOrAuto = (value, name) => (value === "auto" ? -1 : number(value, name));

/** What the module takes for options of normals: a function, since groups are copied for a call. */
function normalArguments(options) {
  const groups = integers(options.smoothingGroups, "smoothingGroups");
  const before = [choice(options.weighting ?? "angle", "weighting", weightings), numberOrAuto(options.creaseAngle ?? 180, "creaseAngle")];
  const after = [
    boolean(options.smoothingGroupsAreMasks ?? false, "smoothingGroupsAreMasks"),
    boolean(options.weldPositions ?? true, "weldPositions"),
    conventionBits(options.convention ?? "gltf"), // of which handedness and winding count here
    count(options.refine ?? 2, "refine"),
    numberOrAuto(options.denoise ?? 0, "denoise"),
  ];
  return (call) => [...before, call.put(groups, Uint32Array), groups?.length ?? 0, ...after];
}

export function generateNormals(mesh, options = {}) {
  optionsOf(options, [...normalOptions, "convention", "report"]);
  const given = normalArguments(options);
  const { positions, indices, faceSizes } = object(mesh, "mesh");
  const checked = meshOf({ positions, indices, faceSizes });
  return wasm.run((call) => {
    setMesh(call, checked);
    const out = call.allocate(checked.cornerCount * 12 + 16);
    call.check(call.wasm.generateNormals(...given(call), out));
    keepReport(call, options, normalCounts);
    return call.get(Float32Array, out, checked.cornerCount * 3);
  });
}

export function makeIndexedFrames(mesh, options = {}) {
  optionsOf(options, [...tangentOptions, ...steps, "normals", "report"]);
  const tangents = tangentArguments(options, choices);
  const chosen = steps.map((name) => boolean(options[name] ?? name === "sanitize", name));
  const normals = normalArguments(object(options.normals ?? {}, "normals", normalOptions));
  const checked = meshOf(mesh);
  return wasm.run((call) => {
    setMesh(call, checked);
    const result = call.allocate(40);
    call.check(call.wasm.makeIndexedFrames(...tangents, ...chosen, ...normals(call), result));
    const words = call.get(Uint32Array, result, 10);
    const take = (Type, i, size) => call.take(Type, words[2 * i], size * words[2 * i + 1]);
    const report = {};
    call.report(tangentCounts, report);
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

/** The same indices, with the corners of faces that are turned in reverse order behind the first. */
function turnedIndices({ indices, faceSizes, cornerCount }, turned) {
  const made = indices ? indices.slice() : Uint32Array.from({ length: cornerCount }, (_, corner) => corner);
  for (let face = 0, first = 0; face < turned.length; ++face) {
    const size = faceSizes ? faceSizes[face] : 3;
    if (turned[face]) made.subarray(first + 1, first + size).reverse();
    first += size;
  }
  return made;
}

export function mendWinding(mesh, options = {}) {
  optionsOf(options, ["useNormals", "weldPositions", "convention"]);
  const given = [
    boolean(options.useNormals ?? true, "useNormals"),
    boolean(options.weldPositions ?? true, "weldPositions"),
    conventionBits(options.convention ?? "gltf"), // of which handedness and winding count here
  ];
  const { positions, normals, indices, faceSizes, normalIndices } = object(mesh, "mesh");
  const checked = meshOf({ positions, normals, indices, faceSizes, normalIndices });
  return wasm.run((call) => {
    setMesh(call, checked);
    const faceCount = checked.faceSizes ? checked.faceSizes.length : Math.floor(checked.cornerCount / 3);
    const out = call.allocate(faceCount + 16);
    call.check(call.wasm.mendWinding(...given, out));
    const report = {};
    call.report(windingCounts, report);
    const turned = call.get(Uint8Array, out, faceCount);
    return { indices: turnedIndices(checked, turned), turned, report };
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
