// SPDX-License-Identifier: MIT
// A model for tests.
import { grid } from "./meshes.mjs";

/** Returns a .gltf with one primitive, and its buffer. `uri`: file name of the buffer. Default: a data URI. */
export function gridModel({ uri, tangents, image, size = 3 } = {}) {
  const { positions, normals, uvs, indices } = grid(size);
  const arrays = { POSITION: positions, NORMAL: normals, TEXCOORD_0: uvs, ...(tangents && { TANGENT: tangents }) };
  const [accessors, bufferViews, parts] = [[], [], []];
  let bytes = 0;
  const add = (array, accessor) => {
    bufferViews.push({ buffer: 0, byteOffset: bytes, byteLength: array.byteLength });
    parts.push(Buffer.from(array.buffer, array.byteOffset, array.byteLength));
    bytes += array.byteLength;
    return accessors.push({ bufferView: bufferViews.length - 1, ...accessor }) - 1;
  };
  const sizes = { POSITION: 3, NORMAL: 3, TEXCOORD_0: 2, TANGENT: 4 };
  const attributes = {};
  for (const [name, array] of Object.entries(arrays))
    attributes[name] = add(array, { componentType: 5126, count: positions.length / 3, type: `VEC${sizes[name]}`,
      ...(name === "POSITION" && { min: [-1e3, -1e3, -1e3], max: [1e3, 1e3, 1e3] }) });
  const corners = Uint32Array.from(indices);
  const buffer = () => Buffer.concat(parts);
  const json = {
    asset: { version: "2.0", generator: "a test" },
    meshes: [{ primitives: [{ attributes, indices: add(corners, { componentType: 5125, count: corners.length, type: "SCALAR" }), material: 0 }] }],
    materials: [{ normalTexture: { index: 0 } }], textures: [{ source: 0 }], images: [{ uri: image ?? "normal.png" }],
    accessors, bufferViews,
    buffers: [{ byteLength: bytes, uri: uri ?? `data:application/octet-stream;base64,${buffer().toString("base64")}` }],
  };
  return { model: Buffer.from(JSON.stringify(json)), buffer: buffer() };
}
