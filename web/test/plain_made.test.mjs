// SPDX-License-Identifier: MIT
// Compares pictures of generated models with those of three.js' loader and renderer: transforms, encodings of
// attributes, poses, texture transforms and materials, one model for each.
import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { Glb } from "./glb.mjs";
import { ball, fieldMap, glbOfMesh, knobMap, torus } from "./shapes.mjs";
import { difference, drawn, missing, openBytes, overGray, ownPicture, screenshots, withPage } from "./support.mjs";

const plain = process.env.TSPACE_PLAIN;
/** Largest mean difference of a model, of 255. */
const kMost = 3;

const images = [knobMap(), fieldMap()];
const material = { normalTexture: { index: 0 }, pbrMetallicRoughness: { baseColorTexture: { index: 1 }, metallicFactor: 0.2, roughnessFactor: 0.5 } };
const bumpy = (options = {}, mesh = torus()) => glbOfMesh(mesh, { material, images, ...options });

/** Returns unsigned or signed integers whose normalized values are the nearest to these numbers. */
const normalized = (Type, most, numbers) => Type.from(numbers, (x) => Math.round(most * x));

/** Replaces attributes of the model by normalized integers, each vertex at a multiple of four bytes. */
function quantized(bytes, encodings) {
  const glb = new Glb(bytes), [{ attributes }] = glb.primitives();
  for (const [name, [Type, componentType, most]] of Object.entries(encodings)) {
    const width = { POSITION: 3, NORMAL: 3, TANGENT: 4, TEXCOORD_0: 2, COLOR_0: 4 }[name], numbers = glb.numbers(attributes[name]), count = numbers.length / width;
    const stride = Math.ceil((width * Type.BYTES_PER_ELEMENT) / 4) * 4, all = new Type((stride * count) / Type.BYTES_PER_ELEMENT);
    for (let i = 0; i < count; ++i) all.set(normalized(Type, most, numbers.subarray(width * i, width * (i + 1))), (i * stride) / Type.BYTES_PER_ELEMENT);
    const bufferView = glb.addView(new Uint8Array(all.buffer)), { type, min, max } = glb.json.accessors[attributes[name]];
    Object.assign(glb.json.bufferViews[bufferView], { byteStride: stride });
    const limits = min && { min: [...normalized(Type, most, min)], max: [...normalized(Type, most, max)] };
    attributes[name] = glb.json.accessors.push({ bufferView, componentType, normalized: true, count, type, ...(name === "POSITION" && limits) }) - 1;
  }
  glb.json.extensionsUsed = glb.json.extensionsRequired = ["KHR_mesh_quantization"];
  return glb.finish();
}

/** Returns a mesh whose positions are in the cube from -1 to 1. */
const inCube = (mesh) => ({ ...mesh, positions: mesh.positions.map((x) => x / 1.5) });

/** Returns a half ring on two bones, the second one bent. */
function skinned() {
  const mesh = torus(96, 32, 0.25), count = mesh.positions.length / 3, joints = new Uint8Array(4 * count), weights = new Float32Array(4 * count);
  for (let i = 0; i < count; ++i) {
    const share = Math.min(1, Math.max(0, 0.5 + mesh.positions[3 * i]));
    joints.set([0, 1, 0, 0], 4 * i);
    weights.set([1 - share, share, 0, 0], 4 * i);
  }
  const glb = new Glb(bumpy({ attributes: { WEIGHTS_0: [weights, "VEC4"] } }, mesh)), [{ attributes }] = glb.primitives();
  attributes.JOINTS_0 = glb.json.accessors.push({ bufferView: glb.addView(joints), componentType: 5121, count, type: "VEC4" }) - 1;
  glb.json.nodes = [{ mesh: 0, skin: 0, translation: [5, 5, 5] }, { children: [2] }, { translation: [0.1, 0, 0], rotation: [0, 0, Math.sin(0.35), Math.cos(0.35)] }];
  glb.json.scenes[0].nodes = [0, 1];
  glb.json.skins = [{ joints: [1, 2] }];
  return glb.finish();
}

/** Returns a ring with two morph targets, both partly applied. */
function morphed() {
  const mesh = torus(), glb = new Glb(bumpy({}, mesh)), [primitive] = glb.primitives(), { positions: p } = mesh;
  const moves = [(i) => [0, 0.3 * Math.sin(3 * p[i]), 0], (i) => [0.4 * p[i], 0, -0.2 * p[i + 2]]];
  const turns = [(i) => [-0.4 * Math.cos(3 * p[i]), 0, 0], (i) => [-0.2 * mesh.normals[i], 0, 0.1 * mesh.normals[i + 2]]];
  const all = (of) => Array.from({ length: p.length / 3 }, (_, v) => of(3 * v)).flat();
  primitive.targets = moves.map((move, k) => ({ POSITION: glb.addFloats(all(move), "VEC3"), NORMAL: glb.addFloats(all(turns[k]), "VEC3") }));
  glb.json.meshes[0].weights = [0.7, 0.4];
  return glb.finish();
}

/** Returns a ring some of whose positions come from a sparse accessor. */
function sparse() {
  const mesh = torus(), glb = new Glb(bumpy({}, mesh)), [{ attributes }] = glb.primitives(), accessor = glb.json.accessors[attributes.POSITION];
  const moved = Array.from({ length: mesh.positions.length / 3 }, (_, i) => i).filter((i) => mesh.positions[3 * i + 1] > 0.3), values = moved.flatMap((i) => [mesh.positions[3 * i], 0.3, mesh.positions[3 * i + 2]]);
  accessor.sparse = { count: moved.length, indices: { bufferView: glb.addView(new Uint8Array(Uint32Array.from(moved).buffer)), componentType: 5125 }, values: { bufferView: glb.addView(new Uint8Array(Float32Array.from(values).buffer)) } };
  return glb.finish();
}

/** Returns a ball drawn four times, each instance turned and scaled. */
function instanced() {
  const glb = new Glb(bumpy({}, ball(48, 24))), s = Math.SQRT1_2;
  const attributes = {
    TRANSLATION: glb.addFloats([-1.2, 0, 0, 1.2, 0, 0, 0, 1.6, 0.4, 0, -1.4, 0], "VEC3"),
    ROTATION: glb.addFloats([0, 0, 0, 1, s, 0, 0, s, 0, s, 0, s, 0, 0, s, s], "VEC4"),
    SCALE: glb.addFloats([1, 1, 1, 0.7, 1.2, 0.7, 0.5, 0.5, 0.5, 0.9, 0.4, 0.9], "VEC3"),
  };
  glb.json.nodes[0].extensions = { EXT_mesh_gpu_instancing: { attributes } };
  glb.json.extensionsUsed = glb.json.extensionsRequired = ["EXT_mesh_gpu_instancing"];
  return glb.finish();
}

const transform = (index, KHR_texture_transform) => ({ index, extensions: { KHR_texture_transform } });
const colors = (mesh) => Float32Array.from({ length: (4 * mesh.positions.length) / 3 }, (_, i) => (i % 4 === 3 ? 1 : 0.5 + 0.5 * mesh.normals[3 * Math.floor(i / 4) + (i % 4)]));
const { tangents: _, ...withoutTangents } = torus();

const models = {
  "a scale of 250 below one of 0.01, turned": () => bumpy({ json: { nodes: [{ children: [1], scale: [0.01, 0.01, 0.01], rotation: [0.3, 0.2, 0.1, Math.sqrt(0.86)] }, { mesh: 0, scale: [250, 250, 250], translation: [3, 0, 0] }] } }),
  "a nonuniform scale below a rotation": () => bumpy({ json: { nodes: [{ children: [1], scale: [2, 0.7, 1] }, { mesh: 0, rotation: [0, 0, Math.sin(0.4), Math.cos(0.4)] }] } }),
  "16-bit positions and UVs, 8-bit frames, scaled back by the node": () => quantized(bumpy({ node: { scale: [150, 150, 150], translation: [10, 20, 30] } }, inCube(torus())), { POSITION: [Int16Array, 5122, 32767], NORMAL: [Int8Array, 5120, 127], TANGENT: [Int8Array, 5120, 127], TEXCOORD_0: [Uint16Array, 5123, 65535] }),
  "8-bit positions under a nonuniform scale": () => quantized(bumpy({ node: { scale: [3, 1, 2] } }, inCube(torus(48, 24))), { POSITION: [Int8Array, 5120, 127], NORMAL: [Int16Array, 5122, 32767], TANGENT: [Int16Array, 5122, 32767] }),
  "a mirroring node, without tangents": () => bumpy({ node: { scale: [-1, 1.5, 1] } }, withoutTangents),
  "a skin with a bent bone": skinned,
  "two morph targets": morphed,
  "texture transforms that differ": () => bumpy({ material: { normalTexture: transform(0, { offset: [0.3, 0.1], rotation: 0.4, scale: [2, 3] }), pbrMetallicRoughness: { baseColorTexture: transform(1, { offset: [0.1, 0.6], scale: [0.5, 2] }) } }, json: { extensionsUsed: ["KHR_texture_transform"] } }),
  "8-bit vertex colors": () => quantized(bumpy({ attributes: { COLOR_0: [colors(torus()), "VEC4"] } }), { COLOR_0: [Uint8Array, 5121, 255] }),
  "a second UV set for colors, both sides, a weak normal map": () => bumpy({ attributes: { TEXCOORD_1: [torus().uvs.map((x, i) => (i % 2 === 0 ? 3 * x : 1 - x)), "VEC2"] }, material: { doubleSided: true, normalTexture: { index: 0, scale: 0.4 }, pbrMetallicRoughness: { baseColorTexture: { index: 1, texCoord: 1 }, metallicFactor: 0 } } }),
  "positions of a sparse accessor": sparse,
  "instances": instanced,
  "clear coat, emission and occlusion": () => bumpy({ material: { ...material, emissiveFactor: [0.1, 0.2, 0], emissiveTexture: { index: 1 }, occlusionTexture: { index: 1, strength: 0.7 }, extensions: { KHR_materials_clearcoat: { clearcoatFactor: 1, clearcoatRoughnessFactor: 0.1 } } }, json: { extensionsUsed: ["KHR_materials_clearcoat"] } }),
};

const save = (name, text) => {
  mkdirSync(screenshots, { recursive: true });
  writeFileSync(join(screenshots, `made-${name}.png`), Buffer.from(text, "base64"));
};

test(`${Object.keys(models).length} generated models look like in three.js: mean difference of at most ${kMost} of 255`, { skip: missing || (!plain && "the page of three.js alone is not built"), timeout: 1_200_000 }, async (t) => {
  const own = new Map();
  await withPage(async (tab) => {
    for (const [name, make] of Object.entries(models)) {
      const bytes = make();
      await openBytes(tab, "made.glb", bytes);
      assert.equal(await tab.evaluate(() => document.documentElement.dataset.picture), "drawn", name);
      await drawn(tab);
      own.set(name, { bytes, ...(await ownPicture(tab)) });
    }
  }, { width: 900, height: 700, allowMessages: true });
  await withPage(async (tab) => {
    for (const [i, [name, { bytes, text, view }]] of [...own].entries()) {
      const theirs = await tab.evaluate(([content, view]) => window.renderPlain("made.glb", { "made.glb": content }, view), [bytes.toString("base64"), view]);
      const { mean, count } = difference(overGray(text), overGray(theirs));
      save(`${i + 1}`, text);
      save(`${i + 1}-three`, theirs);
      t.diagnostic(`${i + 1}, ${name}: ${mean.toFixed(2)} of 255 over ${count} pixels`);
      assert.ok(count > 1000, name);
      assert.ok(mean <= kMost, `${name}: ${mean}`);
    }
  }, { url: pathToFileURL(plain).href, allowMessages: true });
});
