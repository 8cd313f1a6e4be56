// SPDX-License-Identifier: MIT
// The entry "tspace/pack": whole frames in 4 to 16 bytes.
import { choice, fail, floats, object } from "./check.js";
import { Wasm } from "./wasm.js";

export { TspaceError } from "./error.js";

const wasm = new Wasm(new URL("./pack.wasm", import.meta.url));
export const ready = wasm.ready;

/** In the order of tspace::FrameFormat. */
export const frameFormats = Object.freeze([
  "frame32", "frame48", "frame64", "oct32", "qtangent64", "snorm8_pair", "snorm16_pair", "gltf_snorm8", "gltf_snorm16",
]);
const packCounts = [
  "badNormalCount", "notFiniteCount", "zeroCount", "parallelCount", "notUnitCount", "notOrthogonalCount", "badSignCount",
  "mendedCount",
];

const numberOf = (format) => choice(format, "format", frameFormats);

export const frameBytes = (format) => wasm.exports.frameBytes(numberOf(format));

export function packFrames(format, normals, tangents, options = {}) {
  const number = numberOf(format);
  object(options, "options");
  floats(normals, "normals", 3, true);
  floats(tangents, "tangents", 4, true);
  const count = normals.length / 3;
  return wasm.run((call) => {
    const bytes = count * call.wasm.frameBytes(number);
    const [n, t, out] = [call.put(normals), call.put(tangents), call.allocate(bytes + 16)];
    call.check(call.wasm.packFrames(number, n, count, t, tangents.length / 4, out, bytes));
    if (options.report !== undefined) call.report(packCounts, object(options.report, "report"));
    return call.get(Uint8Array, out, bytes);
  });
}

export function unpackFrames(format, frames) {
  const number = numberOf(format);
  if (!(frames instanceof Uint8Array)) fail("wrongType", "frames is not a Uint8Array");
  return wasm.run((call) => {
    const size = call.wasm.frameBytes(number);
    if (frames.length % size !== 0)
      fail("countMismatch", `frames has ${frames.length} bytes, which is no multiple of the ${size} of a frame`);
    const count = frames.length / size;
    const [from, n, t] = [call.put(frames), call.allocate(count * 12 + 16), call.allocate(count * 16 + 16)];
    call.check(call.wasm.unpackFrames(number, from, frames.length, n, t, count));
    return { normals: call.get(Float32Array, n, count * 3), tangents: call.get(Float32Array, t, count * 4) };
  });
}
