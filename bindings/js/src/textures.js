// SPDX-License-Identifier: MIT
// The entry "tspace/textures": decodes KTX2 and DDS to pixels, and encodes normal maps as KTX2 and DDS.
import { source } from "#textures";
import { boolean, bytes as bytesOf, choice, count, fail, failType, isMissing, number, object, valueOr } from "./check.js";
import { textAt, Wasm } from "./wasm.js";

export { TspaceError } from "./error.js";

/** Options of the current call, with its decompression functions unzstd and unzlib. */
let unpackers = {};

const wasm = new Wasm({
  canUnpack: (isZlib) => (unpackers[isZlib ? "unzlib" : "unzstd"] ? 1 : 0),
  unpack(isZlib, from, size, to, wanted) {
    const name = isZlib ? "unzlib" : "unzstd";
    let unpacked;
    try {
      unpacked = unpackers[name](new Uint8Array(wasm.exports.memory.buffer, from >>> 0, size).slice(), wanted);
    } catch {
      return 0; // the codec throws for corrupt data
    }
    if (!(unpacked instanceof Uint8Array)) failType(unpacked, `the result of ${name}`, "a Uint8Array");
    if (unpacked.length !== wanted) return 0;
    new Uint8Array(wasm.exports.memory.buffer, to >>> 0, wanted).set(unpacked);
    return 1;
  },
});
export const ready = wasm.start(source);

const unpacking = ["unzstd", "unzlib"];

/** Checks that a value is a function or missing. */
function checkFunction(value, option) {
  if (!isMissing(value) && typeof value !== "function") failType(value, option, "a function");
}

/**
 * Calls wasm.run with the caller's decompression functions. Releases the instance afterwards, because its memory never
 * shrinks.
 */
function run(options, body) {
  for (const name of unpacking) checkFunction(options[name], name);
  const before = unpackers;
  unpackers = options;
  try {
    return wasm.run(body);
  } finally {
    unpackers = before;
    wasm.release();
  }
}

/** Names of number types in the order of their size, and the array type of each. */
const numberKinds = ["uint8", "uint16", "float"];
const arrayTypes = [Uint8ClampedArray, Uint16Array, Float32Array];
const channelNames = ["red", "green", "blue", "alpha", null];

export function readTexture(file, options = {}) {
  object(options, "options", ["level", "numbers", "vectors", ...unpacking]);
  const data = bytesOf(file, "the texture");
  const level = count(valueOr(options.level, 0), "level");
  const kind = options.numbers === undefined ? -1 : choice(options.numbers, "numbers", numberKinds);
  const makesVectors = boolean(valueOr(options.vectors, true), "vectors");
  return run(options, (call) => {
    const exports = call.wasm;
    call.check(exports.readTexture(call.put(data), data.length, level, kind, makesVectors));
    const words = call.get(Uint32Array, exports.textureWords(), 16);
    const [width, height, levels, channels, bits, isFloat, isSrgb, isGuessed, x, y, z, format, container, howRead, pixels, made] = words;
    const text = (place) => textAt(exports, place);
    const isPlain = x === 0 && y === 1 && z === 2;
    return {
      width, height, levels, channels, bits, isFloat: isFloat !== 0, isSrgb: isSrgb !== 0,
      container: text(container), format: text(format),
      layout: isPlain ? null : { x: channelNames[x], y: channelNames[y], z: channelNames[z], isGuessed: isGuessed !== 0 },
      howRead: text(howRead),
      numbers: numberKinds[made],
      rgba: call.get(arrayTypes[made], pixels, 4 * width * height),
    };
  });
}

const curves = ["none", "srgb", "linearized"];

export function convertMap(image, options = {}) {
  object(options, "options", ["channels", "curve", "flipRed", "flipGreen", "decodeImage", ...unpacking]);
  const { channels, decodeImage } = options;
  checkFunction(decodeImage, "decodeImage");
  if (!isMissing(channels) && typeof channels !== "string") failType(channels, "channels", "a string");
  const curve = choice(valueOr(options.curve, "none"), "curve", curves);
  const flipsRed = boolean(valueOr(options.flipRed, false), "flipRed"), flipsGreen = boolean(valueOr(options.flipGreen, false), "flipGreen");
  const map = imageOf(image, "the map", decodeImage);
  return run(options, (call) => {
    const exports = call.wasm, letters = isMissing(channels) ? 0 : call.put(new TextEncoder().encode(`${channels}\0`));
    call.check(exports.convertMap(putImage(call, map), letters, curve, flipsRed, flipsGreen));
    const words = call.get(Uint32Array, exports.textureWords(), 16), [width, height] = words, [howRead, pixels, made] = words.slice(13);
    return { width, height, bitsBefore: words[4], howRead: textAt(exports, howRead), numbers: numberKinds[made], rgba: call.get(arrayTypes[made], pixels, 4 * width * height) };
  });
}

/** Order of the tool's enumerations. */
const formats = ["bc5", "eac-rg11", "rg8", "astc-4x4"];
const qualities = ["fast", "best", "quick"];
const containers = ["ktx2", "dds"];
const alphas = ["auto", "coverage", "data"];
const headers = ["dx10", "legacy", "bc5u"];
const reportNumbers = [
  "width", "height", "bitsBefore", "levels", "outputBytes", "roughnessBytes", "meanErrorDeg", "p99ErrorDeg", "maxErrorDeg", "maxErrorX", "maxErrorY",
  "belowHorizon", "notUnit", "meanRoughness", "meanWidenedRoughness",
];

/** Returns whether the data starts like KTX2 or DDS, which the module reads itself. */
const isTexture = (data) => (data[0] === 0xab && data[1] === 0x4b) || (data[0] === 0x44 && data[1] === 0x44 && data[2] === 0x53 && data[3] === 0x20);

/** Returns the MIME type of a file that the caller decodes, from its first bytes. */
function mimeTypeOf(data) {
  if (data[0] === 0x89 && data[1] === 0x50) return "image/png";
  if (data[0] === 0xff && data[1] === 0xd8) return "image/jpeg";
  if (data[0] === 0x52 && data[8] === 0x57) return "image/webp";
  if (data[0] === 0x76 && data[1] === 0x2f) return "image/x-exr";
  return "";
}

/** Returns a texture file as bytes, or pixels: the given ones, or those of a file that the caller decodes. */
function imageOf(image, what, decodeImage) {
  let pixels = image;
  if (ArrayBuffer.isView(image) || /ArrayBuffer$/.test(image?.[Symbol.toStringTag])) {
    const data = bytesOf(image, what);
    if (isTexture(data)) return { array: data, bytes: data.length, width: 0, height: 0, bits: 0 };
    if (isMissing(decodeImage)) fail("unsupportedFile", `${what} is neither KTX2 nor DDS; use the option decodeImage to read it`);
    pixels = decodeImage(data, mimeTypeOf(data));
    if (typeof pixels?.then === "function") fail("wrongType", "decodeImage returned a Promise; decode the image before the call, and return its pixels");
    if (isMissing(pixels)) fail("unsupportedFile", `decodeImage returned no pixels for ${what}`);
  }
  const { width, height, rgba } = object(pixels, what);
  const place = [[Uint8Array, 8], [Uint8ClampedArray, 8], [Uint16Array, 16], [Float32Array, 32]].find(([Type]) => rgba?.[Symbol.toStringTag] === Type.name);
  if (!place) failType(rgba, `rgba of ${what}`, "a Uint8Array, a Uint8ClampedArray, a Uint16Array or a Float32Array");
  for (const [name, side] of [["width", width], ["height", height]]) if (count(side, `${name} of ${what}`) === 0) fail("countMismatch", `${what} has no pixels`);
  if (rgba.length !== 4 * width * height)
    fail("countMismatch", `${what} has ${rgba.length} numbers for ${width} x ${height} pixels, but needs 4 per pixel`);
  return { array: rgba, bytes: 0, width, height, bits: place[1] };
}

function putImage(call, image) {
  if (!image) return 0;
  const { array, bytes, width, height, bits } = image;
  const place = call.put(array);
  return call.put(new Uint32Array([place, bytes, width, height, bits]));
}

const ofCompression = ["format", "quality", "signed", "noLevels", "container", "alpha", "ddsHeader", "roughness", "roughnessFactor", "decodeImage", ...unpacking];

export function compressMap(image, options = {}) {
  object(options, "options", ofCompression);
  const { decodeImage } = options;
  checkFunction(decodeImage, "decodeImage");
  const format = choice(valueOr(options.format, "bc5"), "format", formats), quality = choice(valueOr(options.quality, "fast"), "quality", qualities);
  const isSigned = boolean(valueOr(options.signed, false), "signed"), hasLevels = !boolean(valueOr(options.noLevels, false), "noLevels");
  const isDds = choice(valueOr(options.container, "ktx2"), "container", containers) === 1;
  const alpha = choice(valueOr(options.alpha, "auto"), "alpha", alphas);
  const header = choice(valueOr(options.ddsHeader, "dx10"), "ddsHeader", headers);
  if (header !== 0 && !isDds) fail("invalidOption", "ddsHeader can only be used with the container dds");
  const factor = number(valueOr(options.roughnessFactor, 1), "roughnessFactor");
  if (isMissing(options.roughness) && !isMissing(options.roughnessFactor)) fail("invalidOption", "roughnessFactor needs roughness");
  const map = imageOf(image, "the map", decodeImage);
  const rough = isMissing(options.roughness) ? null : imageOf(options.roughness, "the roughness", decodeImage);
  return run(options, (call) => {
    const exports = call.wasm;
    call.check(exports.compressMap(putImage(call, map), putImage(call, rough), format, quality, isSigned, hasLevels, factor, isDds, alpha, header));
    const report = call.report(reportNumbers, {});
    report.format = textAt(exports, exports.madeFormat());
    report.warnings = textAt(exports, exports.madeWarnings()).split("\n").slice(0, -1);
    const made = { bytes: call.get(Uint8Array, exports.madeBytes(), report.outputBytes), report };
    if (rough) made.roughness = call.get(Uint8Array, exports.madeRoughness(), report.roughnessBytes);
    return made;
  });
}
