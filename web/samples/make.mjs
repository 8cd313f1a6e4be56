// SPDX-License-Identifier: MIT
// node make.mjs CRATE.glb FOLDER: writes the samples of the page. CRATE.glb is the output of tspace_demo_model, with small
// textures and without tangents; other models are generated.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { makeIndexedFrames, ready } from "tspace";
import { GlbBuilder, readGlb } from "../src/model/glb.js";
import { png } from "./png.mjs";

const [, , cratePath, folder] = process.argv;
const kRingSize = 256;

function floatsOf({ json, binary }, index) {
  const { bufferView, count, type } = json.accessors[index];
  const at = json.bufferViews[bufferView].byteOffset, width = Number(type[3]);
  return Float32Array.from({ length: count * width }, (_, i) => binary.readFloatLE(at + 4 * i));
}

function indicesOf({ json, binary }, index) {
  const { bufferView, count } = json.accessors[index];
  const at = json.bufferViews[bufferView].byteOffset;
  return Uint32Array.from({ length: count }, (_, i) => binary.readUInt16LE(at + 2 * i));
}

const gathered = (data, size, sources) => Float32Array.from({ length: size * sources.length }, (_, i) => data[size * sources[Math.floor(i / size)] + (i % size)]);

/** Returns a GLB of the crate with mikktspace's tangents. */
function makeCrate(source) {
  const { attributes, indices } = source.json.meshes[0].primitives[0];
  const mesh = {
    positions: floatsOf(source, attributes.POSITION), normals: floatsOf(source, attributes.NORMAL),
    uvs: floatsOf(source, attributes.TEXCOORD_0), indices: indicesOf(source, indices),
  };
  const frames = makeIndexedFrames(mesh, { convention: "gltf" });
  const builder = new GlbBuilder();
  const made = {
    POSITION: builder.addAccessor(gathered(mesh.positions, 3, frames.sourceVertices), "VEC3"),
    NORMAL: builder.addAccessor(frames.normals, "VEC3"),
    TANGENT: builder.addAccessor(frames.tangents, "VEC4"),
    TEXCOORD_0: builder.addAccessor(gathered(mesh.uvs, 2, frames.sourceVertices), "VEC2"),
  };
  const index = builder.addAccessor(frames.indices, "SCALAR");
  const images = source.json.images.map((image) => {
    const { byteOffset, byteLength } = source.json.bufferViews[image.bufferView];
    return { ...image, bufferView: builder.addView(source.binary.subarray(byteOffset, byteOffset + byteLength)) };
  });
  const { scene, scenes, nodes, materials, textures, samplers } = source.json;
  return builder.finish({ scene, scenes, nodes, materials, textures, samplers, images, meshes: [{ name: "crate", primitives: [{ attributes: made, indices: index, material: 0 }] }] }, "tspace samples");
}

/** Returns the height of tiling bricks with rounded edges and a stud each, at UVs from 0 to 1. */
function brickHeight(u, v) {
  const rows = 4, columns = 4, row = Math.floor(v * rows);
  const x = (u * columns + 0.5 * (row % 2)) % 1, y = (v * rows) % 1;
  const ramp = (d) => Math.min(1, Math.max(0, d / 0.1)) ** 2 * (3 - 2 * Math.min(1, Math.max(0, d / 0.1)));
  const brick = ramp(Math.min(x, 1 - x) * 1.4 - 0.03) * ramp(Math.min(y, 1 - y) - 0.03);
  const stud = Math.max(0, 1 - ((x - 0.5) ** 2 + ((y - 0.5) * 0.7) ** 2) / 0.02);
  return 0.02 * brick + 0.012 * Math.sqrt(stud);
}

/** Returns a texel of the bricks' normal map, in the DirectX convention (green points down). */
function ringNormal(x, y) {
  const e = 1 / kRingSize, u = (x + 0.5) * e, v = (y + 0.5) * e;
  const slopeU = (brickHeight((u + e) % 1, v) - brickHeight((u - e + 1) % 1, v)) / (2 * e);
  const slopeV = (brickHeight(u, (v + e) % 1) - brickHeight(u, (v - e + 1) % 1)) / (2 * e);
  const n = [-slopeU, -slopeV, 1], length = Math.hypot(...n);
  return n.map((k) => Math.round((k / length) * 127.5 + 127.5));
}

/** Returns a GLB of a ring with 8 by 3 tiles of bricks. */
function makeRing() {
  const kAround = 64, kAcross = 16, positions = [], normals = [], uvs = [], indices = [];
  for (let i = 0; i <= kAround; ++i) {
    for (let j = 0; j <= kAcross; ++j) {
      const a = (2 * Math.PI * i) / kAround, b = (2 * Math.PI * j) / kAcross;
      const out = [Math.cos(a) * Math.cos(b), Math.sin(b), Math.sin(a) * Math.cos(b)];
      positions.push(Math.cos(a) + 0.38 * out[0], 0.38 * out[1], Math.sin(a) + 0.38 * out[2]);
      normals.push(...out);
      uvs.push((-8 * i) / kAround, (-3 * j) / kAcross);
    }
  }
  for (let i = 0; i < kAround; ++i) {
    for (let j = 0; j < kAcross; ++j) {
      const a = i * (kAcross + 1) + j, b = a + kAcross + 1;
      indices.push(a, a + 1, b + 1, a, b + 1, b);
    }
  }
  const builder = new GlbBuilder();
  const attributes = {
    POSITION: builder.addAccessor(Float32Array.from(positions), "VEC3"),
    NORMAL: builder.addAccessor(Float32Array.from(normals), "VEC3"),
    TEXCOORD_0: builder.addAccessor(Float32Array.from(uvs), "VEC2"),
  };
  const index = builder.addAccessor(Uint32Array.from(indices), "SCALAR");
  const image = builder.addView(png(kRingSize, ringNormal));
  return builder.finish({
    scene: 0, scenes: [{ nodes: [0] }], nodes: [{ name: "ring", mesh: 0 }],
    meshes: [{ name: "ring", primitives: [{ attributes, indices: index, material: 0 }] }],
    materials: [{ name: "bricks", pbrMetallicRoughness: { baseColorFactor: [0.72, 0.36, 0.22, 1], metallicFactor: 0 }, normalTexture: { index: 0 } }],
    textures: [{ source: 0 }], images: [{ name: "bricks-directx", mimeType: "image/png", bufferView: image }],
  }, "tspace samples");
}

await ready;
mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, "crate.glb"), makeCrate(readGlb(readFileSync(cratePath))));
writeFileSync(join(folder, "ring-directx.glb"), makeRing());
