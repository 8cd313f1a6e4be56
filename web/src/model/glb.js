// SPDX-License-Identifier: MIT
// Writes and reads GLB. Plain JavaScript, because samples/make.mjs runs it in node without compilation.

const kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementArrayBuffer = 34963;

export class GlbBuilder {
  /** @type {Uint8Array[]} */ #pieces = [];
  #size = 0;
  /** @type {object[]} */ views = [];
  /** @type {object[]} */ accessors = [];

  /**
   * @param {Uint8Array} bytes
   * @param {number} [target]
   * @returns {number} index of the buffer view
   */
  addView(bytes, target) {
    this.views.push({ buffer: 0, byteOffset: this.#size, byteLength: bytes.length, ...(target && { target }) });
    const padded = new Uint8Array(Math.ceil(bytes.length / 4) * 4);
    padded.set(bytes);
    this.#pieces.push(padded);
    this.#size += padded.length;
    return this.views.length - 1;
  }

  /**
   * @param {Float32Array | Uint32Array} data
   * @param {"SCALAR" | "VEC2" | "VEC3" | "VEC4"} type
   * @returns {number} index of the accessor
   */
  addAccessor(data, type) {
    const width = type === "SCALAR" ? 1 : Number(type[3]), isIndex = data instanceof Uint32Array;
    const bufferView = this.addView(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), isIndex ? kElementArrayBuffer : kArrayBuffer);
    const accessor = { bufferView, componentType: isIndex ? kUnsignedInt : kFloat, count: data.length / width, type };
    if (type === "VEC3") {
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      data.forEach((x, i) => {
        low[i % 3] = Math.min(low[i % 3], x);
        high[i % 3] = Math.max(high[i % 3], x);
      });
      Object.assign(accessor, { min: low, max: high });
    }
    this.accessors.push(accessor);
    return this.accessors.length - 1;
  }

  /**
   * @param {object} json all but asset, accessors, views and the buffer
   * @param {string} generator
   * @returns {Uint8Array<ArrayBuffer>}
   */
  finish(json, generator) {
    const all = { asset: { version: "2.0", generator }, ...json, accessors: this.accessors, bufferViews: this.views, buffers: [{ byteLength: this.#size }] };
    let text = new TextEncoder().encode(JSON.stringify(all));
    const padding = (4 - (text.length % 4)) % 4;
    text = Uint8Array.from([...text, ...new Array(padding).fill(0x20)]);
    const out = new Uint8Array(12 + 8 + text.length + 8 + this.#size), view = new DataView(out.buffer);
    [0x46546c67, 2, out.length, text.length, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
    out.set(text, 20);
    let at = 20 + text.length;
    view.setUint32(at, this.#size, true);
    view.setUint32(at + 4, 0x004e4942, true);
    at += 8;
    for (const piece of this.#pieces) {
      out.set(piece, at);
      at += piece.length;
    }
    return out;
  }
}

/**
 * The members of a glTF file that the page edits.
 * @typedef {{
 *   buffers?: { byteLength: number; uri?: string }[];
 *   bufferViews?: { buffer: number; byteOffset?: number; byteLength: number }[];
 *   images?: { uri?: string; mimeType?: string; bufferView?: number }[];
 *   extensionsUsed?: string[];
 *   [name: string]: unknown;
 * }} Json
 */

/**
 * Returns the JSON and the binary chunk of a valid GLB. Without a binary chunk, `binary` is empty.
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @returns {{ json: Json; binary: Uint8Array<ArrayBuffer> }}
 */
export function readGlb(bytes) {
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true);
  return { json: JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length))), binary: bytes.subarray(Math.min(bytes.length, 28 + length)) };
}
