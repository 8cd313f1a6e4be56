// SPDX-License-Identifier: MIT
// The entry "tspace/pack": complete frames in 4 to 16 bytes.
import { source } from "#pack";
import { bytes as bytesOf, choice, fail, floats, optionsOf } from "./check.js";
import { frameFormatNames } from "./names.js";
import { packReportNames } from "./report_names.js";
import { Wasm } from "./wasm.js";

export { TspaceError } from "./error.js";

const wasm = new Wasm();
export const ready = wasm.start(source);
export const release = () => wasm.release();

export const frameFormats = Object.freeze([...frameFormatNames]);

const numberOf = (format) => choice(format, "format", frameFormats);

export const frameBytes = (format) => wasm.exports.frameBytes(numberOf(format));

export function packFrames(normals, tangents, format, options = {}) {
  const number = numberOf(format);
  optionsOf(options, ["report"]);
  const [givenNormals, givenTangents] = [floats(normals, "normals", 3, true), floats(tangents, "tangents", 4, true)];
  const count = givenNormals.length / 3;
  return wasm.run((call) => {
    const bytes = count * call.wasm.frameBytes(number);
    const [n, t, out] = [call.put(givenNormals), call.put(givenTangents), call.allocate(bytes + 16)];
    call.check(call.wasm.packFrames(n, count, t, givenTangents.length / 4, number, out, bytes));
    if (options.report) call.report(packReportNames, options.report);
    return call.get(Uint8Array, out, bytes);
  });
}

export function unpackFrames(frames, format) {
  const number = numberOf(format);
  const bytes = bytesOf(frames, "frames");
  return wasm.run((call) => {
    const size = call.wasm.frameBytes(number);
    if (bytes.length % size !== 0)
      fail("countMismatch", `frames has ${bytes.length} bytes, which is not a multiple of the ${size} bytes of a frame`);
    const count = bytes.length / size;
    const [from, n, t] = [call.put(bytes), call.allocate(count * 12 + 16), call.allocate(count * 16 + 16)];
    call.check(call.wasm.unpackFrames(from, bytes.length, number, n, t, count));
    return { normals: call.get(Float32Array, n, count * 3), tangents: call.get(Float32Array, t, count * 4) };
  });
}
