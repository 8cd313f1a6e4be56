// SPDX-License-Identifier: MIT
// Converts the arrays of a three.js geometry to plain numbers.
import type { BufferAttribute, BufferGeometry, InterleavedBufferAttribute, Matrix3 } from "three";
import type { Arrays } from "../worker/protocol.js";

type Attribute = BufferAttribute | InterleavedBufferAttribute;

/** Returns an attribute as `size` floats per element; normalized integers are converted to 0 to 1 or -1 to 1. */
function floats(attribute: Attribute, size: number): Float32Array<ArrayBuffer> {
  if (attribute.array instanceof Float32Array && !("isInterleavedBufferAttribute" in attribute) && attribute.itemSize === size) return Float32Array.from(attribute.array);
  const out = new Float32Array(size * attribute.count);
  for (let i = 0; i < attribute.count; ++i) {
    for (let k = 0; k < size; ++k) out[size * i + k] = attribute.getComponent(i, k);
  }
  return out;
}

const named = (geometry: BufferGeometry, name: string, size: number): Float32Array<ArrayBuffer> | null => {
  const attribute = geometry.getAttribute(name) as Attribute | undefined;
  return attribute && attribute.itemSize >= size ? floats(attribute, size) : null;
};

export const uvName = (channel: number): string => (channel === 0 ? "uv" : `uv${channel}`);

function transformed(uvs: Float32Array<ArrayBuffer>, matrix: Matrix3 | null): Float32Array<ArrayBuffer> {
  if (!matrix) return uvs;
  const m = matrix.elements, out = new Float32Array(uvs.length);
  for (let i = 0; i < uvs.length; i += 2) {
    out[i] = m[0] * uvs[i] + m[3] * uvs[i + 1] + m[6];
    out[i + 1] = m[1] * uvs[i] + m[4] * uvs[i + 1] + m[7];
  }
  return out;
}

export function uvsOf(geometry: BufferGeometry, channel: number, matrix: Matrix3 | null): Float32Array<ArrayBuffer> | null {
  const uvs = named(geometry, uvName(channel), 2);
  return uvs && transformed(uvs, matrix);
}

/** Returns two numbers per vertex, after the transform of a texture. */
export const uvsThrough = (attribute: Attribute, matrix: Matrix3 | null): Float32Array<ArrayBuffer> => transformed(floats(attribute, 2), matrix);

export function arraysOf(geometry: BufferGeometry, channel: number, matrix: Matrix3 | null): Arrays | null {
  const positions = named(geometry, "position", 3);
  if (!positions || positions.length === 0) return null;
  const count = positions.length / 3;
  const fits = (array: Float32Array<ArrayBuffer> | null, size: number) => (array && array.length === size * count ? array : null);
  return {
    positions,
    normals: fits(named(geometry, "normal", 3), 3),
    uvs: fits(uvsOf(geometry, channel, matrix), 2),
    tangents: fits(named(geometry, "tangent", 4), 4),
    indices: geometry.index ? Uint32Array.from(geometry.index.array) : null,
  };
}
