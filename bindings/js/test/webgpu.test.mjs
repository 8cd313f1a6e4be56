// SPDX-License-Identifier: MIT
// Tests "tspace/webgpu" in Chromium with WebGPU on SwiftShader: compares poses of models of ../shared with the module,
// and makes calls without a GPU.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, it } from "node:test";
import { Plan, planBuffers, ready } from "tspace";
import { GpuFrames } from "tspace/webgpu";
import { missing, runPage } from "./browser.mjs";
import { grid } from "./meshes.mjs";
import { hasModels, shared } from "./tool.mjs";

const core = await import("@gltf-transform/core").catch(() => null);

/** Models without deformation, with morph targets, and with a skin. */
const models = ["khronos/BoomBoxWithAxes.glb", "khronos/Lantern.glb", "khronos/MorphStressTest.glb", "khronos/CesiumMan.glb"];

/** Returns the primitives of these models as one array of bytes, with an index of offsets. */
async function meshesOf() {
  const list = [], parts = [];
  let bytes = 0;
  const add = (array) => {
    const offset = bytes;
    parts.push(Buffer.from(array.buffer, array.byteOffset, array.byteLength));
    bytes += array.byteLength;
    return { type: array.constructor.name, offset, length: array.length };
  };
  const numbers = (accessor, Type = Float32Array) => {
    const size = accessor.getElementSize(), made = new Type(accessor.getCount() * size);
    for (let i = 0; i < accessor.getCount(); ++i) made.set(accessor.getElement(i, []), size * i);
    return add(made);
  };
  for (const path of models) {
    const document = await new core.NodeIO().read(join(shared, "models", path));
    for (const mesh of document.getRoot().listMeshes()) mesh.listPrimitives().forEach((primitive, i) => {
      const [positions, uvs] = ["POSITION", "TEXCOORD_0"].map((name) => primitive.getAttribute(name)), indices = primitive.getIndices();
      if (!uvs || !indices || primitive.getMode() !== 4) return;
      const joints = primitive.getAttribute("JOINTS_0"), weights = primitive.getAttribute("WEIGHTS_0");
      list.push({
        name: `${path} ${i}`, positions: numbers(positions), uvs: numbers(uvs), indices: numbers(indices, Uint32Array),
        targets: primitive.listTargets().flatMap((target) => target.getAttribute("POSITION") ?? []).map((target) => numbers(target)),
        ...(joints && { joints: numbers(joints, Uint32Array), jointWeights: numbers(weights) }),
      });
    });
  }
  return { "/meshes.json": Buffer.from(JSON.stringify(list)), "/meshes.bin": Buffer.concat(parts) };
}

describe("GpuFrames in Chromium", { skip: missing || (!hasModels && "no ../shared here") || (!core && "glTF-Transform is not installed") }, () => {
  it("gives the tangents and normals of the module", { timeout: 300_000 }, async (t) => {
    const page = readFileSync(new URL("./webgpu_page.js", import.meta.url), "utf8");
    const { noAdapter, outcomes, spoiled } = await runPage({ page, files: await meshesOf() });
    if (noAdapter) return t.skip("this Chromium has no WebGPU adapter");
    for (const one of outcomes) t.diagnostic(JSON.stringify(one));
    assert.ok(outcomes.length >= 30);
    for (const { name, method, wrongSigns, tangents, normals } of outcomes)
      for (const { most, worst } of [tangents, normals])
        assert.ok(wrongSigns === 0 && most < 0.0005 && worst < 0.01, `${name} ${method}: ${most}, ${worst} degrees, ${wrongSigns} signs`);
    // If two codes are equally near, rounding decides; both are then within the bounds of the format, 0.15 and 0.165 degrees.
    for (const { name, packed } of outcomes) {
      for (const { wrongSigns, normals, tangents } of packed)
        assert.ok(wrongSigns === 0 && normals.most < 0.001 && normals.worst < 0.3 && tangents.worst < 0.33, `${name}: ${JSON.stringify(packed)}`);
    }
    assert.ok(spoiled.tangents.most > 1, "a wrong shader is noticed");
  });
});

describe("GpuFrames without a GPU", () => {
  /** Returns a mock device that records calls; buffers are objects with a size. */
  function deviceOf(calls) {
    const pass = { setPipeline() {}, setBindGroup: (_, group) => calls.push(group), dispatchWorkgroups: (...groups) => calls.push(groups), end: () => calls.push("end") };
    return {
      limits: { maxStorageBufferBindingSize: 1 << 27 }, pass,
      queue: { writeBuffer: (buffer, _, words) => (buffer.words = words) },
      createShaderModule: ({ code }) => ({ code }), createBuffer: ({ size, usage }) => ({ size, usage, destroy() { this.size = 0; } }),
      createComputePipelineAsync: async () => ({ getBindGroupLayout: () => 0 }), createBindGroup: ({ entries }) => entries.map(({ resource }) => resource),
      createCommandEncoder: () => ({ beginComputePass: () => pass }),
    };
  }
  const buffer = (size, usage = 0x80) => ({ size, usage, destroy() {} });

  it("binds ranges of the caller's buffers, and dispatches one thread per result", async () => {
    await ready;
    const mesh = grid(30), calls = [], device = deviceOf(calls);
    const plan = new Plan(mesh, { convention: "gltf" });
    const frames = await GpuFrames.create(device, plan, { mesh });
    assert.deepEqual([frames.vertexCount, frames.resultCount, frames.normalCount, frames.makesNormals], [961, 5400, 5400, true]);
    const positions = buffer(20000), out = buffer(300000);
    frames.encode(device.createCommandEncoder(), { positions: { buffer: positions, stride: 16, offset: 4 }, tangents: { buffer: out, offset: 1284 } });
    const [group, groups, end] = calls;
    assert.deepEqual([groups, end], [[85, 1], "end"]);
    assert.deepEqual([group[2], group[5]], [{ buffer: positions, offset: 0, size: 15376 }, { buffer: out, offset: 1280, size: 86404 }]);
    assert.deepEqual([...group[1].buffer.words.slice(0, 12)], [0, 4, 16, 0x3f800000, 0x3f800000, 0x3f800000, 0, 0, 0, 0, 4, 16]);
    frames.encode(device.pass, { positions, tangents: out });
    assert.equal(calls.length, 5); // the caller's pass stays open
    frames.destroy();
    assert.throws(() => frames.encode(device.pass, { positions, tangents: out }), /destroyed/);
    assert.equal(out.size, 300000);
  });

  it("rejects buffers that the shader cannot read", async () => {
    await ready;
    const mesh = grid(3), device = deviceOf([]), plan = new Plan(mesh, { convention: "gltf" });
    const frames = await GpuFrames.create(device, planBuffers(plan));
    const good = { positions: buffer(192), normals: buffer(192), tangents: buffer(864) };
    frames.encode(device.createCommandEncoder(), good);
    for (const [changed, pattern] of [
      [{ positions: buffer(188) }, /188 bytes, but 16 elements need 192/], [{ tangents: buffer(860) }, /elements need 864/], [{ normals: null }, /normals are missing/],
      [{ positions: { buffer: buffer(999), stride: 8 } }, /have 12 bytes/], [{ positions: { buffer: buffer(999), offset: 2 } }, /multiples of 4/],
      [{ positions: { buffer: buffer(999), format: "half" } }, /must be one of float32x3, snorm16x3/], [{ tangents: buffer(864, 8) }, /STORAGE/],
      [{ tangent: buffer(864) }, /known names are/], [{ deform: { buffer: buffer(16), morph: { count: 2, weights: 0, deltas: 8 } } }, /has only 16/],
      [{ deform: { buffer: buffer(16), skin: { joints: 2, weights: 0, matrices: 8 } } }, /multiple of 4/],
    ]) assert.throws(() => frames.encode(device.createCommandEncoder(), { ...good, ...changed }), pattern);
    await assert.rejects(GpuFrames.create(device, {}), /a Plan, or the result of planBuffers/);
    await assert.rejects(GpuFrames.create({}, plan), /GPUDevice/);
    await assert.rejects(GpuFrames.create(device, new Uint32Array(20)), /version 1/);
    await assert.rejects(GpuFrames.create({ ...device, limits: { maxStorageBufferBindingSize: 100 } }, plan), /maxStorageBufferBindingSize of the device is 100/);
  });
});
