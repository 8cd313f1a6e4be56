// SPDX-License-Identifier: MIT
// The entry "tspace/webgpu": computes normals and tangents of each pose with WebGPU from a plan. Buffers belong to the
// caller; nothing is read back.
import { count, fail, failType, isMissing, number, object, valueOr } from "./check.js";
import { shader } from "./evaluate_shader.js";

export { TspaceError } from "./error.js";

const STORAGE = 0x80, COPY_DST = 0x08; // flags of GPUBufferUsage, which does not exist in node
const THREADS = 64, MOST_GROUPS = 65535, SETTINGS = 32, RANGE_ALIGNMENT = 256;

/** Formats: number in the settings, bytes per element, and alignment. */
const positionFormats = { float32x3: { number: 0, bytes: 12, unit: 4 }, snorm16x3: { number: 1, bytes: 6, unit: 2 } };
const normalFormats = { float32x3: { number: 1, bytes: 12, unit: 4 } };
const tangentFormats = {
  float32x4: { number: 0, bytes: 16, unit: 4 }, frame32: { number: 1, bytes: 4, unit: 4 },
  oct32: { number: 2, bytes: 4, unit: 4 }, snorm8_pair: { number: 3, bytes: 8, unit: 4 },
};

/** Pipelines by device: the shader is compiled once per device. */
const pipelines = new WeakMap();

function pipelineOf(device) {
  if (!pipelines.has(device)) {
    const module = device.createShaderModule({ label: "tspace_evaluate", code: shader });
    const made = device.createComputePipelineAsync({ label: "tspace_evaluate", layout: "auto", compute: { module, entryPoint: "tspace_evaluate" } });
    made.catch(() => pipelines.delete(device));
    pipelines.set(device, made);
  }
  return pipelines.get(device);
}

/** Returns the words of a plan: from planBuffers, or from a Plan. */
function wordsOf(plan, options) {
  const written = plan?.[Symbol.for("tspace.planBuffers")]?.(options) ?? plan;
  const words = written?.words ?? written;
  if (words?.[Symbol.toStringTag] !== "Uint32Array") failType(plan, "plan", "a Plan, or the result of planBuffers");
  if (words[0] !== 1 || words.length < 12) fail("invalidOption", "plan.words does not have version 1, the only version that this shader reads");
  if (written === plan && options !== undefined) fail("invalidOption", "options cannot be combined with the result of planBuffers; pass them to planBuffers instead");
  return words;
}

/** Returns the maximum vertex index of the triangles, plus 1. */
function vertexCountOf(words) {
  let most = -1;
  for (let t = 0, at = words[10]; t < words[6]; ++t, at += words[7]) most = Math.max(most, words[at], words[at + 1], words[at + 2]);
  return most + 1;
}

/** Returns a checked array descriptor { buffer, offset, stride, format } of the caller; also accepts a GPUBuffer. */
function arrayOf(given, name, formats, elements) {
  const isBuffer = typeof given?.usage === "number" && typeof given.size === "number";
  const array = isBuffer ? { buffer: given } : object(given, name, ["buffer", "offset", "stride", "format", "scale"]);
  const known = Object.keys(formats), format = valueOr(array.format, known[0]);
  if (!known.includes(format)) fail("invalidOption", `${name}.format must be one of ${known.join(", ")}, not ${format}`);
  const { number: code, bytes, unit } = formats[format];
  const offset = count(valueOr(array.offset, 0), `${name}.offset`), stride = count(valueOr(array.stride, bytes), `${name}.stride`);
  if (offset % unit !== 0 || stride % unit !== 0) fail("misaligned", `${name}: offset and stride must be multiples of ${unit} bytes`);
  if (stride < bytes) fail("strideTooSmall", `${name}.stride is ${stride} bytes, but elements of ${format} have ${bytes} bytes`);
  const { buffer } = array;
  if ((buffer?.usage & STORAGE) === 0) fail("invalidOption", `the buffer of ${name} must have GPUBufferUsage.STORAGE`);
  const end = elements === 0 ? offset : offset + stride * (elements - 1) + bytes;
  if (!(end <= buffer.size)) fail("countMismatch", `the buffer of ${name} has ${buffer.size} bytes, but ${elements} elements need ${end}`);
  const begin = offset - (offset % RANGE_ALIGNMENT);
  const size = Math.max(4, Math.min(buffer.size - begin, Math.ceil((end - begin) / 4) * 4));
  return { code, stride, offset: offset - begin, range: { buffer, offset: begin, size }, scale: array.scale };
}

/** Returns words 12 to 19 of the settings: the locations of morph targets and joints. */
function deformation(deform, vertexCount) {
  const words = new Uint32Array(8);
  if (isMissing(deform)) return words;
  const { buffer, morph, skin } = object(deform, "deform", ["buffer", "morph", "skin"]);
  const place = (offset, name, bytes) => {
    if (count(offset, name) % 4 !== 0) fail("misaligned", `${name} must be a multiple of 4 bytes`);
    if (offset + bytes > buffer.size) fail("countMismatch", `${name} needs ${offset + bytes} bytes of the buffer, which has only ${buffer.size}`);
    return offset / 4;
  };
  if (!isMissing(morph)) {
    const { count: targets, weights, deltas } = object(morph, "deform.morph", ["count", "weights", "deltas"]);
    count(targets, "deform.morph.count");
    words.set([
      targets, place(weights, "deform.morph.weights", 4 * targets), place(deltas, "deform.morph.deltas", 12 * targets * vertexCount), vertexCount,
    ]);
  }
  if (!isMissing(skin)) {
    const { joints, weights, matrices } = object(skin, "deform.skin", ["joints", "weights", "matrices"]);
    words.set([
      1, place(joints, "deform.skin.joints", 16 * vertexCount), place(weights, "deform.skin.weights", 16 * vertexCount),
      place(matrices, "deform.skin.matrices", 48),
    ], 4);
  }
  return words;
}

export class GpuFrames {
  #device;
  #pipeline;
  #plan;
  #none;
  /**
   * Settings buffers by contents. Each setting has its own buffer, because commands of one submission may use different
   * settings.
   */
  #settings = new Map();
  #isDestroyed = false;

  static async create(device, plan, options) {
    if (typeof device?.createComputePipelineAsync !== "function") failType(device, "device", "a GPUDevice");
    const words = wordsOf(plan, options), most = device.limits.maxStorageBufferBindingSize;
    if (words.byteLength > most) fail("tooLarge", `the plan has ${words.byteLength} bytes, but the maxStorageBufferBindingSize of the device is ${most}`);
    return new GpuFrames(device, await pipelineOf(device), words);
  }

  /** Called only by `create`. */
  constructor(device, pipeline, words) {
    this.#device = device;
    this.#pipeline = pipeline;
    this.#plan = this.#upload(words, "tspace plan");
    this.#none = [0, 1].map(() => device.createBuffer({ label: "tspace placeholder", size: 16, usage: STORAGE }));
    this.vertexCount = vertexCountOf(words);
    this.resultCount = words[4];
    this.makesNormals = (words[2] & 1) !== 0;
    // Normals that a pose provides are read per vertex.
    this.normalCount = this.makesNormals ? this.resultCount : this.vertexCount;
  }

  #upload(words, label) {
    const buffer = this.#device.createBuffer({ label, size: words.byteLength, usage: STORAGE | COPY_DST });
    this.#device.queue.writeBuffer(buffer, 0, words);
    return buffer;
  }

  #settingsOf(positions, normals, tangents, deformed) {
    const words = new Uint32Array(SETTINGS), floats = new Float32Array(words.buffer);
    words.set([positions.code, positions.offset, positions.stride]);
    floats.set(positions.scale ?? [1, 1, 1], 3);
    words.set([normals?.code ?? 0, normals?.offset ?? 0, normals?.stride ?? 0, tangents.code, tangents.offset, tangents.stride], 6);
    words.set(deformed, 12);
    const key = words.join();
    if (!this.#settings.has(key)) this.#settings.set(key, this.#upload(words, "tspace settings"));
    return this.#settings.get(key);
  }

  encode(encoder, arrays) {
    if (this.#isDestroyed) fail("planMismatch", "these GpuFrames were destroyed");
    const { deform, ...given } = object(arrays, "arrays", ["positions", "normals", "tangents", "deform"]);
    const positions = arrayOf(given.positions, "positions", positionFormats, this.vertexCount);
    positions.scale?.forEach((factor) => number(factor, "positions.scale"));
    if (isMissing(given.normals) && !this.makesNormals) fail("missingAttribute", "normals are missing: this plan does not compute them, so each pose must provide them");
    const normals = isMissing(given.normals) ? undefined : arrayOf(given.normals, "normals", normalFormats, this.normalCount);
    const tangents = arrayOf(given.tangents, "tangents", tangentFormats, this.resultCount);
    const settings = this.#settingsOf(positions, normals, tangents, deformation(deform, this.vertexCount));
    const ranges = [
      { buffer: this.#plan }, { buffer: settings }, positions.range, { buffer: deform?.buffer ?? this.#none[0] },
      normals?.range ?? { buffer: this.#none[1] }, tangents.range,
    ];
    const group = this.#device.createBindGroup({
      layout: this.#pipeline.getBindGroupLayout(0),
      entries: ranges.map((resource, binding) => ({ binding, resource })),
    });
    const isPass = typeof encoder?.dispatchWorkgroups === "function";
    const pass = isPass ? encoder : encoder.beginComputePass({ label: "tspace_evaluate" });
    const groups = Math.ceil(this.resultCount / THREADS);
    pass.setPipeline(this.#pipeline);
    pass.setBindGroup(0, group);
    if (groups !== 0) pass.dispatchWorkgroups(Math.min(groups, MOST_GROUPS), Math.ceil(groups / MOST_GROUPS));
    if (!isPass) pass.end();
  }

  destroy() {
    for (const buffer of [this.#plan, ...this.#none, ...this.#settings.values()]) buffer.destroy();
    this.#settings.clear();
    this.#isDestroyed = true;
  }
}
