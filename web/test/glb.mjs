// SPDX-License-Identifier: MIT
// A GLB that tests change: accessors as floats, and new ones behind the old.

const kWidths = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
const kReaders = {
  5120: [1, (view, at) => view.getInt8(at), 127], 5121: [1, (view, at) => view.getUint8(at), 255],
  5122: [2, (view, at) => view.getInt16(at, true), 32767], 5123: [2, (view, at) => view.getUint16(at, true), 65535],
  5125: [4, (view, at) => view.getUint32(at, true), 1], 5126: [4, (view, at) => view.getFloat32(at, true), 1],
};
const padded = (bytes, fill) => Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, fill)]);

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

  /** All numbers of an accessor; those that stand for 0 to 1 or -1 to 1 are that. */
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

  /** Primitives of triangles that have these attributes. */
  primitives(...attributes) {
    return this.json.meshes.flatMap((mesh) => mesh.primitives).filter((one) => (one.mode ?? 4) === 4 && attributes.every((name) => name in one.attributes));
  }

  indices(primitive) {
    if (primitive.indices !== undefined) return this.numbers(primitive.indices);
    return Float64Array.from({ length: this.json.accessors[primitive.attributes.POSITION].count }, (_, i) => i);
  }

  finish() {
    this.json.buffers = [{ byteLength: this.#size }];
    const text = padded(Buffer.from(JSON.stringify(this.json)), 0x20);
    const head = Buffer.alloc(20), binaryHead = Buffer.alloc(8);
    [0x46546c67, 2, 28 + text.length + this.#size, text.length, 0x4e4f534a].forEach((word, i) => head.writeUInt32LE(word, 4 * i));
    binaryHead.writeUInt32LE(this.#size);
    binaryHead.writeUInt32LE(0x004e4942, 4);
    return Buffer.concat([head, text, binaryHead, ...this.#pieces]);
  }

  /** All that is in its buffer. */
  binary() {
    if (this.#pieces.length > 1) this.#pieces = [Buffer.concat(this.#pieces)];
    return this.#pieces[0];
  }
}
