// SPDX-License-Identifier: MIT
// A GLB that tests modify: accessors are read as floats, and new ones are appended.

const kWidths = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
const kReaders = {
  5120: [1, (view, at) => view.getInt8(at), 127], 5121: [1, (view, at) => view.getUint8(at), 255],
  5122: [2, (view, at) => view.getInt16(at, true), 32767], 5123: [2, (view, at) => view.getUint16(at, true), 65535],
  5125: [4, (view, at) => view.getUint32(at, true), 1], 5126: [4, (view, at) => view.getFloat32(at, true), 1],
};
const padded = (bytes, fill) => Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, fill)]);

/** Returns the bytes of a GLB with this JSON, and a buffer of these pieces. `size`: total size of the pieces. */
function glbOf(json, pieces, size) {
  const text = padded(Buffer.from(JSON.stringify(json)), 0x20), head = Buffer.alloc(20), binaryHead = Buffer.alloc(8);
  [0x46546c67, 2, 28 + text.length + size, text.length, 0x4e4f534a].forEach((word, i) => head.writeUInt32LE(word, 4 * i));
  binaryHead.writeUInt32LE(size);
  binaryHead.writeUInt32LE(0x004e4942, 4);
  return Buffer.concat([head, text, binaryHead, ...pieces]);
}

export class Glb {
  #pieces;
  #size;

  constructor(bytes) {
    const length = bytes.readUInt32LE(12);
    this.json = JSON.parse(bytes.toString("utf8", 20, 20 + length));
    this.#pieces = [padded(bytes.subarray(28 + length, 28 + length + bytes.readUInt32LE(20 + length)), 0)];
    this.#size = this.#pieces[0].length;
  }

  bytesOfView(index) {
    const { byteOffset = 0, byteLength } = this.json.bufferViews[index];
    return this.binary().subarray(byteOffset, byteOffset + byteLength);
  }

  bytesOfImage(index) {
    return this.bytesOfView(this.json.images[index].bufferView);
  }

  /** Returns all values of an accessor; normalized integers are converted to 0 to 1 or -1 to 1. */
  numbers(index) {
    const { bufferView, byteOffset = 0, componentType, count, type, normalized } = this.json.accessors[index];
    const width = kWidths[type], [size, read, most] = kReaders[componentType];
    const view = this.json.bufferViews[bufferView], stride = view.byteStride ?? width * size;
    const binary = this.binary(), data = new DataView(binary.buffer, binary.byteOffset, binary.length);
    const start = (view.byteOffset ?? 0) + byteOffset;
    const at = (i) => read(data, start + stride * Math.floor(i / width) + size * (i % width));
    return Float64Array.from({ length: width * count }, (_, i) => (normalized ? Math.max(-1, at(i) / most) : at(i)));
  }

  addView(bytes) {
    const index = this.json.bufferViews.push({ buffer: 0, byteOffset: this.#size, byteLength: bytes.length }) - 1;
    this.#pieces.push(padded(Buffer.from(bytes), 0));
    this.#size += this.#pieces.at(-1).length;
    return index;
  }

  addFloats(numbers, type) {
    const bytes = Buffer.from(Float32Array.from(numbers).buffer);
    return this.json.accessors.push({ bufferView: this.addView(bytes), componentType: 5126, count: numbers.length / kWidths[type], type }) - 1;
  }

  addIndices(numbers) {
    const bytes = Buffer.from(Uint32Array.from(numbers).buffer);
    return this.json.accessors.push({ bufferView: this.addView(bytes), componentType: 5125, count: numbers.length, type: "SCALAR" }) - 1;
  }

  /** Returns the triangle primitives that have these attributes. */
  primitives(...attributes) {
    return this.json.meshes.flatMap((mesh) => mesh.primitives).filter((one) => (one.mode ?? 4) === 4 && attributes.every((name) => name in one.attributes));
  }

  indices(primitive) {
    if (primitive.indices !== undefined) return this.numbers(primitive.indices);
    return Float64Array.from({ length: this.json.accessors[primitive.attributes.POSITION].count }, (_, i) => i);
  }

  finish() {
    this.json.buffers = [{ byteLength: this.#size }];
    return glbOf(this.json, this.#pieces, this.#size);
  }

  /** Returns the contents of the buffer. */
  binary() {
    if (this.#pieces.length > 1) this.#pieces = [Buffer.concat(this.#pieces)];
    return this.#pieces[0];
  }
}

/** Returns a wavy square with about `vertices` vertices of 96 bytes each (including triangles), plus 16 bytes for each of `more` unused attributes. */
export function gridGlb(vertices, more = 0) {
  const side = Math.ceil(Math.sqrt(vertices)), count = side * side, cells = side - 1;
  const widths = { POSITION: 3, NORMAL: 3, TANGENT: 4, TEXCOORD_0: 2, TEXCOORD_1: 2, COLOR_0: 4, ...Object.fromEntries(Array.from({ length: more }, (_, i) => [`_DATA_${i}`, 4])) }, arrays = Object.fromEntries(Object.entries(widths).map(([name, width]) => [name, new Float32Array(width * count)]));
  for (let i = 0; i < count; ++i) {
    const u = (i % side) / cells, v = Math.floor(i / side) / cells, slope = 0.5 * Math.cos(20 * u), length = Math.hypot(slope, 1);
    arrays.POSITION.set([u, 0.025 * Math.sin(20 * u), v], 3 * i);
    arrays.NORMAL.set([-slope / length, 1 / length, 0], 3 * i);
    arrays.TANGENT.set([1 / length, slope / length, 0, 1], 4 * i);
    arrays.TEXCOORD_0.set([u, v], 2 * i);
    arrays.TEXCOORD_1.set([v, u], 2 * i);
    arrays.COLOR_0.set([u, v, 0.5, 1], 4 * i);
  }
  const indices = new Uint32Array(6 * cells * cells);
  for (let i = 0; i < cells * cells; ++i) {
    const a = Math.floor(i / cells) * side + (i % cells);
    indices.set([a, a + side, a + 1, a + 1, a + side, a + side + 1], 6 * i);
  }
  const pieces = [...Object.values(arrays), indices].map(({ buffer }) => Buffer.from(buffer));
  let byteOffset = 0;
  const bufferViews = pieces.map(({ length: byteLength }) => ({ buffer: 0, byteOffset: (byteOffset += byteLength) - byteLength, byteLength }));
  const accessors = Object.values(widths).map((width, i) => ({ bufferView: i, componentType: 5126, count, type: width === 2 ? "VEC2" : width === 3 ? "VEC3" : "VEC4" }));
  Object.assign(accessors[0], { min: [0, -0.025, 0], max: [1, 0.025, 1] });
  accessors.push({ bufferView: pieces.length - 1, componentType: 5125, count: indices.length, type: "SCALAR" });
  const attributes = Object.fromEntries(Object.keys(widths).map((name, i) => [name, i]));
  const json = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], meshes: [{ primitives: [{ attributes, indices: pieces.length - 1 }] }], buffers: [{ byteLength: byteOffset }], bufferViews, accessors };
  return glbOf(json, pieces, byteOffset);
}
