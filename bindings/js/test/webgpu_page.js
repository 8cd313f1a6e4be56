// SPDX-License-Identifier: MIT
// Page of webgpu.test.mjs: computes poses of models with WebGPU and with the module, and compares the results.
import { ready } from "tspace";
import { packFrames, ready as packReady, unpackFrames } from "tspace/pack";
import { GpuFrames } from "tspace/webgpu";
import { compare, expected, posed, prepared } from "../test/planned_poses.mjs";

/** Returns the positions, rotated about y by an angle that increases with x. */
function bent(positions) {
  const made = positions.slice();
  const xs = positions.filter((_, i) => i % 3 === 0), low = Math.min(...xs.slice(0, 60000)), size = Math.max(...xs.slice(0, 60000)) - low;
  for (let i = 0; i < made.length; i += 3) {
    const angle = (0.7 * (positions[i] - low)) / size, [c, s] = [Math.cos(angle), Math.sin(angle)];
    made.set([c * positions[i] - s * positions[i + 2], positions[i + 1], s * positions[i] + c * positions[i + 2]], i);
  }
  return made;
}

/** Returns rotations about the z axis by small angles, one per joint: three rows of four numbers. */
const matricesOf = (count) =>
  Float32Array.from({ length: count }, (_, joint) => joint).reduce((made, joint) => {
    const angle = 0.15 * Math.sin(3 * joint), [c, s] = [Math.cos(angle), Math.sin(angle)];
    made.set([c, -s, 0, 0.01 * (joint % 5), s, c, 0, 0, 0, 0, 1, 0], 12 * joint);
    return made;
  }, new Float32Array(12 * count));

const STORAGE = 0x80, COPY = 0x0c;
const bufferOf = (device, data, size = data.byteLength) => {
  const buffer = device.createBuffer({ size: Math.max(16, Math.ceil(size / 4) * 4), usage: STORAGE | COPY });
  if (data) device.queue.writeBuffer(buffer, 0, data);
  return buffer;
};

async function readBack(device, buffer) {
  const copy = device.createBuffer({ size: buffer.size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
  const encoder = device.createCommandEncoder();
  encoder.copyBufferToBuffer(buffer, 0, copy, 0, buffer.size);
  device.queue.submit([encoder.finish()]);
  await copy.mapAsync(GPUMapMode.READ);
  const bytes = copy.getMappedRange().slice(0);
  copy.destroy();
  return bytes;
}

/** Returns the morph targets and skin of a mesh as one buffer, with offsets. */
function deformOf(device, { targets, joints, jointWeights }, weights, matrices) {
  if (weights.length === 0 && !matrices) return undefined;
  const parts = [Float32Array.from(weights), ...targets.slice(0, weights.length)];
  if (matrices) parts.push(Uint32Array.from(joints), jointWeights, matrices);
  const places = parts.map(((at) => (part) => (at += part.byteLength) - part.byteLength)(0));
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.byteLength, 0));
  parts.forEach((part, i) => all.set(new Uint8Array(part.buffer, part.byteOffset, part.byteLength), places[i]));
  const [first, second, third] = places.slice(-3);
  return {
    buffer: bufferOf(device, all), morph: weights.length ? { count: weights.length, weights: 0, deltas: places[1] } : undefined,
    skin: matrices && { joints: first, weights: second, matrices: third },
  };
}

async function comparePose(device, mesh, method) {
  const made = prepared(mesh, { convention: "gltf", method }), { vertices, buffers } = made;
  const weights = vertices.targets.map((_, t) => 0.3 + 0.2 * (t % 3)), matrices = vertices.joints && matricesOf(1 + Math.max(...vertices.joints));
  const isPlain = weights.length === 0 && !matrices;
  const given = isPlain ? bent(vertices.positions) : vertices.positions;
  const positions = isPlain ? given : posed(vertices, weights, matrices);
  const frames = await GpuFrames.create(device, buffers);
  const count = frames.resultCount;
  const arrays = { positions: bufferOf(device, given), normals: bufferOf(device, null, 12 * count), tangents: bufferOf(device, null, 16 * count), deform: deformOf(device, vertices, weights, matrices) };
  const formats = ["frame32", "oct32"], packed = formats.map(() => bufferOf(device, null, 4 * count));
  device.pushErrorScope("validation");
  const encoder = device.createCommandEncoder();
  frames.encode(encoder, arrays);
  formats.forEach((format, i) => frames.encode(encoder, { ...arrays, normals: undefined, tangents: { buffer: packed[i], format } }));
  device.queue.submit([encoder.finish()]);
  const wrong = await device.popErrorScope();
  if (wrong) throw new Error(wrong.message);
  const [normals, tangents] = [await readBack(device, arrays.normals), await readBack(device, arrays.tangents)].map((bytes) => new Float32Array(bytes));
  const wanted = expected(made, positions, normals.subarray(0, 3 * count));
  const words = await Promise.all(packed.map(async (buffer) => new Uint8Array(await readBack(device, buffer), 0, 4 * count)));
  const outcome = { name: mesh.name, method, triangles: made.plain.indices.length / 3, ...compare(wanted, { normals, tangents }), packed: formats.map((format, i) => compare(unpackFrames(packFrames(normals, tangents, format), format), unpackFrames(words[i], format))) };
  frames.destroy();
  made.plan.destroy();
  return outcome;
}

/** Loads the meshes of the test: one buffer of arrays, and a list that describes them. */
async function loadMeshes() {
  const list = await (await fetch("/meshes.json")).json(), bytes = await (await fetch("/meshes.bin")).arrayBuffer();
  const types = { Float32Array, Uint32Array };
  const view = ({ type, offset, length }) => new types[type](bytes, offset, length);
  return list.map(({ name, targets, ...arrays }) => ({
    name, targets: targets.map(view), ...Object.fromEntries(Object.entries(arrays).map(([key, place]) => [key, view(place)])),
  }));
}

async function newDevice(mutate = (code) => code) {
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  const original = device.createShaderModule.bind(device);
  device.createShaderModule = ({ code, ...rest }) => original({ ...rest, code: mutate(code) });
  return device;
}

export async function main() {
  if (!(await navigator.gpu?.requestAdapter())) return { noAdapter: true };
  await Promise.all([ready, packReady]);
  const meshes = await loadMeshes(), device = await newDevice(), outcomes = [];
  for (const mesh of meshes) for (const method of ["mikktspace", "uniform", "lengyel"]) outcomes.push(await comparePose(device, mesh, method));
  // A mutant of the shader that reads other triangles must have a large error.
  const mutant = await newDevice((code) => code.replaceAll("0x3fffffffu", "0x3ffffffbu"));
  const spoiled = await comparePose(mutant, meshes[0], "mikktspace");
  return { outcomes, spoiled };
}

main().then((result) => (window.result = result), (error) => (window.result = { error: String(error.stack) }));
