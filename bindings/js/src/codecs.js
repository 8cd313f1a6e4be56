// SPDX-License-Identifier: MIT
// Codecs from npm and image decoders that callers of "tspace/gltf" pass in with a model. The module calls them during a
// call.
import { fail, failType, isMissing, object } from "./check.js";
import { decodeDraco, encodeDraco } from "./draco.js";

/** Names of codecs, in the order of the module's enumeration (wasm/codecs.h). */
const codecs = ["meshoptDecoder", "meshoptEncoder", "dracoDecoder", "dracoEncoder", "decodeImage", "encodeImage"];

/** Modes and filters of meshopt compression, in the order of tspace's enumerations. */
const modes = ["ATTRIBUTES", "TRIANGLES", "INDICES"];
const filters = ["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"];

/** Checks an option { decoder, encoder }, and returns its members as `${option}Decoder` and `${option}Encoder`. */
function pairOf(option, value, { decoder: decoding, encoder: encoding }, from) {
  if (isMissing(value)) return {};
  const { decoder, encoder } = object(value, option, ["decoder", "encoder"]);
  if (isMissing(decoder)) fail("wrongType", `${option} must have the member decoder: ${from}`);
  if (typeof decoder[decoding] !== "function") fail("wrongType", `${option}.decoder has no function ${decoding}; it must be ${from}`);
  if (!isMissing(encoder) && typeof encoder[encoding] !== "function")
    fail("wrongType", `${option}.encoder has no function ${encoding}; it must be ${from}`);
  return { [`${option}Decoder`]: decoder, [`${option}Encoder`]: encoder };
}

function functionOf(option, value) {
  if (!isMissing(value) && typeof value !== "function") failType(value, option, "a function");
  return { [option]: value };
}

/** Checks the codec options. */
export const codecsOf = ({ meshopt, draco, decodeImage, encodeImage }) => ({
  ...pairOf("meshopt", meshopt, { decoder: "decodeGltfBuffer", encoder: "encodeGltfBuffer" }, "MeshoptDecoder or MeshoptEncoder of the npm package meshoptimizer"),
  ...pairOf("draco", draco, { decoder: "Decoder", encoder: "ExpertEncoder" }, "a module of the npm package draco3d, created by createDecoderModule() or createEncoderModule()"),
  ...functionOf("decodeImage", decodeImage),
  ...functionOf("encodeImage", encodeImage),
});

/** Returns why the caller's pixels are invalid, or undefined if they are valid. */
function faultOfPixels(image, width, height, sampleBytes) {
  if (typeof image?.then === "function")
    fail("wrongType", "decodeImage returned a Promise; use decodeImages(model, decode, options) to decode the images before the call");
  if (isMissing(image)) return "decodeImage returned no pixels for the image";
  const pixels = object(image, "the result of decodeImage").rgba;
  if (![Uint8Array, Uint8ClampedArray, Uint16Array].some((Type) => pixels instanceof Type))
    fail("wrongType", "decodeImage must return an object whose rgba is a Uint8Array, a Uint8ClampedArray or a Uint16Array");
  if (image.width !== width || image.height !== height)
    return `decodeImage returned ${image.width} x ${image.height} pixels instead of ${width} x ${height}`;
  if (pixels.length !== 4 * width * height)
    fail("countMismatch", `decodeImage returned ${pixels.length} numbers for ${width} x ${height} pixels, but needs 4 per pixel`);
  if (sampleBytes === 2 && !(pixels instanceof Uint16Array)) return "the image has 16 bits per channel, but decodeImage returned 8";
  return undefined;
}

/** Imports of the module for one call. Views are created on each access, because memory moves when it grows. */
export class Codecs {
  constructor(call, given) {
    this.call = call;
    this.given = given;
    this.images = [];
  }

  #view(Type, place, count) {
    return new Type(this.call.wasm.memory.buffer, place >>> 0, count);
  }

  /** Copies bytes to new memory, which the module frees. `size`: address that receives the number of bytes. */
  #give(bytes, size) {
    const place = this.call.wasm.allocate(bytes.byteLength + 1) >>> 0;
    if (place === 0) fail("outOfMemory", "out of memory");
    this.#view(Uint8Array, place, bytes.byteLength).set(new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength));
    this.#view(Uint8Array, place + bytes.byteLength, 1)[0] = 0;
    if (size !== undefined) this.#view(Uint32Array, size, 1)[0] = bytes.byteLength;
    return place;
  }

  #giveText(text) {
    return this.#give(new TextEncoder().encode(text.replace(/\s+/g, " ")));
  }

  hasCodec(number) {
    return isMissing(this.given[codecs[number]]) ? 0 : 1;
  }

  decodeMeshopt(data, bytes, to, count, stride, mode, filter) {
    const rows = new Uint8Array(count * stride);
    try {
      this.given.meshoptDecoder.decodeGltfBuffer(rows, count, stride, this.#view(Uint8Array, data, bytes), modes[mode], filters[filter]);
    } catch (error) {
      if (error instanceof TypeError) fail("notReady", `meshopt.decoder is not ready: ${error.message}`);
      return 0; // the codec throws for corrupt data
    }
    this.#view(Uint8Array, to, rows.length).set(rows);
    return 1;
  }

  encodeMeshopt(rows, count, stride, mode, isKhr, size) {
    const source = this.#view(Uint8Array, rows, count * stride).slice();
    return this.#give(this.given.meshoptEncoder.encodeGltfBuffer(source, count, stride, modes[mode], isKhr), size);
  }

  /** Reads a mesh in the struct layout of wasm/codecs.cpp. */
  #readMesh(place) {
    const [corners, cornerCount, pointCount, count, first] = this.#view(Uint32Array, place, 5);
    const attributes = Array.from({ length: count }, (_, i) => {
      const words = this.#view(Uint32Array, first + 60 * i, 15), numbers = this.#view(Float32Array, first + 60 * i, 15);
      return {
        id: words[0], kind: words[1], component: words[2], componentCount: words[3], normalized: words[4] !== 0,
        values: this.#view(Uint8Array, words[5], words[6]).slice(),
        rounding: { bits: words[7], isOctahedral: words[8] !== 0, origin: [...numbers.slice(10, 10 + words[9])], range: numbers[14] },
      };
    });
    return { first, pointCount, corners: this.#view(Uint32Array, corners, cornerCount).slice(), attributes };
  }

  decodeDraco(data, bytes, isEdgebreaker, corners, points, place) {
    const { dracoDecoder, dracoEncoder } = this.given;
    const { first, attributes } = this.#readMesh(place);
    const source = this.#view(Uint8Array, data, bytes).slice();
    const limits = { corners: corners >>> 0, points: points >>> 0 };
    const mesh = decodeDraco(dracoDecoder, source, isEdgebreaker !== 0, limits, attributes, !isMissing(dracoEncoder));
    if (mesh.fault) return this.#giveText(mesh.fault);
    const at = this.#give(mesh.corners);
    this.#view(Uint32Array, place, 3).set([at, mesh.corners.length, mesh.pointCount]);
    mesh.attributes.forEach(({ values, rounding }, i) => {
      const words = first + 60 * i, valuesAt = this.#give(values);
      this.#view(Uint32Array, words + 20, 2).set([valuesAt, values.byteLength]);
      if (!rounding) return;
      this.#view(Uint32Array, words + 28, 3).set([rounding.bits, rounding.isOctahedral ? 1 : 0, rounding.origin.length]);
      this.#view(Float32Array, words + 40, 5).set([...rounding.origin, 0, 0, 0, 0].slice(0, 4).concat(rounding.range));
    });
    return 0;
  }

  encodeDraco(place, size) {
    const mesh = this.#readMesh(place);
    const encoded = encodeDraco(this.given.dracoEncoder, mesh);
    if (!encoded) return 0;
    encoded.ids.forEach((id, i) => (this.#view(Uint32Array, mesh.first + 60 * i, 1)[0] = id));
    return this.#give(encoded.data, size);
  }

  /** Decodes pixels with the given number of channels, of 8 or 16 bits. */
  decodeImage(data, bytes, mimeType, width, height, channels, sampleBytes, to) {
    const file = this.#view(Uint8Array, data, bytes).slice();
    let image;
    try {
      image = this.given.decodeImage(file, mimeType);
    } catch (error) {
      return this.#giveText(`decodeImage threw: ${error?.message ?? error}`);
    }
    const fault = faultOfPixels(image, width, height, sampleBytes);
    if (fault) return this.#giveText(fault);
    const { rgba } = image;
    const count = channels * width * height;
    const pixels = sampleBytes === 2 ? this.#view(Uint16Array, to, count) : this.#view(Uint8Array, to, count);
    const shift = rgba instanceof Uint16Array && sampleBytes === 1 ? 8 : 0;
    for (let from = 0, i = 0; i < count; from += 4) for (let c = 0; c < channels; ++c) pixels[i++] = rgba[from + c] >> shift;
    return 0;
  }

  takeImage(data, bytes, mimeType) {
    this.images.push({ bytes: this.#view(Uint8Array, data, bytes).slice(), mimeType });
  }

  encodeImage(pixels, mimeType, width, height, channels, sampleBytes, quality, size) {
    const count = channels * width * height;
    const Type = sampleBytes === 2 ? Uint16Array : Uint8Array;
    const data = this.#view(Type, pixels, count).slice();
    const image = { width, height, channels, bits: 8 * sampleBytes, data, quality };
    const file = this.given.encodeImage(image, mimeType);
    if (!(file instanceof Uint8Array)) failType(file, "the result of encodeImage", "a Uint8Array");
    return this.#give(file, size);
  }
}
