// SPDX-License-Identifier: MIT
// A normal map without a model: it is shown on a flat surface, so that it can be lit, and so that all functions for
// models work.
import { mapType } from "../files.js";
import { GlbBuilder, readGlb } from "./glb.js";

const kCells = 16;

/** Returns a square that faces +z, with u to the right, v down, and the tangents of glTF. */
export function surfaceWith(name: string, image: Uint8Array): Uint8Array<ArrayBuffer> {
  const builder = new GlbBuilder(), positions: number[] = [], uvs: number[] = [], indices: number[] = [];
  for (let row = 0; row <= kCells; ++row) {
    for (let column = 0; column <= kCells; ++column) {
      const u = column / kCells, v = row / kCells;
      positions.push(u - 0.5, 0.5 - v, 0);
      uvs.push(u, v);
      if (row === kCells || column === kCells) continue;
      const a = row * (kCells + 1) + column, b = a + kCells + 1;
      indices.push(a, b, b + 1, a, b + 1, a + 1);
    }
  }
  const count = positions.length / 3, repeated = (vector: number[]) => Float32Array.from({ length: count * vector.length }, (_, i) => vector[i % vector.length]);
  const attributes = {
    POSITION: builder.addAccessor(Float32Array.from(positions), "VEC3"),
    NORMAL: builder.addAccessor(repeated([0, 0, 1]), "VEC3"),
    TANGENT: builder.addAccessor(repeated([1, 0, 0, 1]), "VEC4"),
    TEXCOORD_0: builder.addAccessor(Float32Array.from(uvs), "VEC2"),
  };
  const index = builder.addAccessor(Uint32Array.from(indices), "SCALAR");
  return builder.finish({
    scene: 0, scenes: [{ nodes: [0] }], nodes: [{ name: "surface", mesh: 0 }],
    meshes: [{ name: "surface", primitives: [{ attributes, indices: index, material: 0 }] }],
    materials: [{ name, doubleSided: true, pbrMetallicRoughness: { baseColorFactor: [0.6, 0.6, 0.6, 1], metallicFactor: 0, roughnessFactor: 0.45 }, normalTexture: { index: 0 } }],
    textures: [{ source: 0 }], images: [{ name, mimeType: mapType(name), bufferView: builder.addView(image) }],
  }, "tspace view");
}

/** Returns the image on such a surface. */
export function imageOf(surface: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> {
  const { json, binary } = readGlb(surface), { byteOffset = 0, byteLength } = json.bufferViews![json.images![0].bufferView!];
  return binary.slice(byteOffset, byteOffset + byteLength) as Uint8Array<ArrayBuffer>;
}
