// SPDX-License-Identifier: MIT
// The entry "tspace/gltf": processes models in memory. Options and reports correspond to the command-line tool and its
// JSON.
import { source } from "#gltf";
import { bytes, fail, failType, isMissing, object } from "./check.js";
import { Codecs, codecsOf } from "./codecs.js";
import { camelCase, TspaceError } from "./error.js";
import { optionNames } from "./file_options.js";
import { textAt, Wasm } from "./wasm.js";

export { TspaceError };
export { remedyText } from "./remedies.js";

const namesOfAll = new Set(Object.values(optionNames).flat());

/** Replaces names of options in a message: memoryLimit for --memory-limit. Quoted words, such as paths, are unchanged. */
function inJavaScriptOptions(text) {
  return text.replace(/(?<!\w)'.*?'(?!\w)|(?<![\w-])--([a-z-]+)/g, (all, name = "") => (namesOfAll.has(camelCase(name)) ? camelCase(name) : all));
}

/** State of the current call: `files` provides the files that its models reference; `codecs` decodes and encodes. */
let current;

const wasm = new Wasm({
  findFile: (model, path, data, size) => current.files.findFile(model, path, data, size),
  hasCodec: (number) => current.codecs.hasCodec(number),
  decodeMeshopt: (...given) => current.codecs.decodeMeshopt(...given),
  encodeMeshopt: (...given) => current.codecs.encodeMeshopt(...given),
  decodeDraco: (...given) => current.codecs.decodeDraco(...given),
  encodeDraco: (...given) => current.codecs.encodeDraco(...given),
  decodeImage: (data, size, type, ...given) => current.codecs.decodeImage(data, size, textAt(wasm.exports, type), ...given),
  encodeImage: (pixels, type, ...given) => current.codecs.encodeImage(pixels, textAt(wasm.exports, type), ...given),
  tell: (what, done, total) => current.watch.tell(textAt(wasm.exports, what), done, total),
  goOn: () => current.watch.goOn(),
  takeImage: (data, size, type) => current.codecs.takeImage(data, size, textAt(wasm.exports, type)),
  parseNumber: (text) => Number(textAt(wasm.exports, text)),
  now: () => performance.now(),
}, inJavaScriptOptions);
export const ready = wasm.start(source);
export const release = () => wasm.release();

const verbs = ["generate", "check", "inspect", "identify", "diff"];
const ofAll = ["resources", "meshopt", "draco", "signal", ...optionNames.inspect];
const ofImages = ["decodeImage", "onProgress"];

/** Names of the options of each verb. */
const known = {
  generate: ["name", ...ofAll, ...ofImages, "encodeImage", ...optionNames.generate],
  check: ["name", ...ofAll, ...ofImages, ...optionNames.check],
  inspect: ["name", ...ofAll],
  identify: ["name", ...ofAll, ...optionNames.identify],
  diff: [...ofAll, ...optionNames.diff],
};
const cannotRead = 103;

const utf8 = new TextEncoder();
const textDecoder = new TextDecoder();

/** Returns a function that maps a path to the bytes of a file referenced by the model, or undefined. */
function finderOf(resources) {
  if (isMissing(resources)) return undefined;
  if (typeof resources === "function") return resources;
  if (resources instanceof Map) return (path) => resources.get(path);
  object(resources, "resources");
  return (path) => (Object.hasOwn(resources, path) ? resources[path] : undefined);
}

/** Converts an option name to the tool's: memoryLimit -> "memory-limit". */
const toolName = (name) => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);

/** Checks options, and formats them as the text that the module parses. */
function textOfOptions(options) {
  const given = {};
  for (const [name, value] of Object.entries(options)) {
    const parts = Array.isArray(value) ? value : [value];
    for (const part of parts)
      if (!["string", "boolean", "undefined"].includes(typeof part) && part !== null && !Number.isFinite(part))
        failType(part, name, "text, a number, true or false");
    given[toolName(name)] = value;
  }
  return JSON.stringify(given);
}

class Files {
  #found = new Map();

  constructor(call, finders) {
    this.call = call;
    this.finders = finders;
  }

  findFile(model, path, data, size) {
    const name = textAt(this.call.wasm, path);
    const key = `${model} ${name}`;
    if (!this.#found.has(key)) {
      const content = this.finders[model](name);
      if (isMissing(content)) return cannotRead;
      const array = bytes(content, `the result of resources for ${JSON.stringify(name)}`);
      this.#found.set(key, [this.call.put(array, Uint8Array), array.length]);
    }
    new Uint32Array(this.call.wasm.memory.buffer, data, 1)[0] = this.#found.get(key)[0];
    new Uint32Array(this.call.wasm.memory.buffer, size, 1)[0] = this.#found.get(key)[1];
    return 0;
  }
}

/** Reports progress, and stops a call that its caller has aborted. */
class Watch {
  constructor(onProgress, signal) {
    if (!isMissing(onProgress) && typeof onProgress !== "function") failType(onProgress, "onProgress", "a function");
    if (!isMissing(signal) && typeof object(signal, "signal").aborted !== "boolean")
      fail("wrongType", "signal must be an AbortSignal: its property aborted is not a boolean");
    this.onProgress = onProgress ?? undefined;
    this.signal = signal ?? undefined;
  }

  tell(what, done, total) {
    this.onProgress?.({ what, done, total });
    this.goOn();
  }

  goOn() {
    if (this.signal?.aborted) throw this.signal.reason ?? new TspaceError("stopped", "stopped by its signal");
  }
}

/** Runs body(call, addresses of models, address of the options) with the codecs of a call. */
function run(models, { resources, meshopt, draco, decodeImage, encodeImage, onProgress, signal, ...options }, body) {
  const text = textOfOptions(options);
  const finder = finderOf(resources);
  const codecs = codecsOf({ meshopt, draco, decodeImage, encodeImage });
  const watch = new Watch(onProgress, signal);
  watch.goOn();
  if (current !== undefined) fail("invalidOption", "a function that was passed to a call must not call tspace/gltf");
  return wasm.run((call) => {
    current = { files: new Files(call, models.map(() => finder)), codecs: new Codecs(call, codecs), watch };
    call.wasm.setCanStop(watch.signal !== undefined);
    try {
      const table = call.allocate(16 * models.length);
      const words = models.flatMap(({ data, name }) => [call.put(data, Uint8Array), data.length, call.put(utf8.encode(`${name}\0`)), finder ? 1 : 0]);
      const given = call.put(utf8.encode(`${text}\0`));
      new Uint32Array(call.wasm.memory.buffer, table, words.length).set(words);
      return body(call, table, given, current.codecs);
    } finally {
      current = undefined;
    }
  });
}

/** Calls a function of the C API; returns its output and report. */
function callFiles(verb, models, options) {
  return run(models, options, (call, table, given) => {
    const results = call.put(new Uint32Array(4));
    call.check(call.wasm.callFiles(verbs.indexOf(verb), table, given, results));
    const [output, outputBytes, report, reportBytes] = call.get(Uint32Array, results, 4);
    const made = output === 0 ? new Uint8Array(0) : call.take(Uint8Array, output, outputBytes);
    return { bytes: made, report: JSON.parse(textDecoder.decode(call.take(Uint8Array, report, reportBytes))) };
  });
}

function modelOf(data, name, what = "the model") {
  if (!isMissing(name) && (typeof name !== "string" || name.includes("\0")))
    failType(name, "name", "text without null characters");
  return { data: bytes(data, what), name: name ?? "" };
}

/** Returns the entry of the only file, with the exit code of the run. */
const ofFile = ({ files, exitCode }) => ({ ...files[0], exitCode });

function ask(verb, data, options) {
  const { name, ...others } = object(options, "options", known[verb]);
  const made = callFiles(verb, [modelOf(data, name)], others);
  return { ...made, report: ofFile(made.report) };
}

export const generate = (data, options = {}) => ask("generate", data, options);
export const check = (data, options = {}) => ask("check", data, options).report;
export const inspect = (data, options = {}) => ask("inspect", data, options).report;
export const identify = (data, options = {}) => ask("identify", data, options).report;
export const diff = (a, b, options = {}) =>
  callFiles("diff", [modelOf(a, "a", "the first model"), modelOf(b, "b", "the second model")], object(options, "options", known.diff)).report;

const isSame = (a, b) => a.length === b.length && a.every((byte, i) => byte === b[i]);

/** Returns the option decodeImage for this model, from decode(bytes, mimeType), which may return promises. */
export async function decodeImages(data, decode, options = {}) {
  if (typeof decode !== "function") failType(decode, "decode", "a function");
  const { resources, meshopt, draco, memoryLimit, allowExternal, signal, name } = object(options, "options");
  const files = run([modelOf(data, name)], { resources, meshopt, draco, memoryLimit, allowExternal, signal }, (call, table, given, codecs) => {
    call.wasm.findImages(table, given);
    return codecs.images;
  });
  const images = await Promise.all(files.map(async ({ bytes: file, mimeType }) => {
    try {
      return { file, image: await decode(file, mimeType) };
    } catch (error) {
      return { file, error };
    }
  }));
  return (file) => {
    const found = images.find((one) => isSame(one.file, file));
    if (found?.error !== undefined) throw found.error;
    return found?.image;
  };
}

/**
 * Decode function for decodeImages, based on browser features. Returns 8 bits per channel even for 16-bit images;
 * transparent colors are not exact.
 */
export async function decodeByCanvas(file, mimeType) {
  const bitmap = await createImageBitmap(new Blob([file], { type: mimeType }), { colorSpaceConversion: "none", premultiplyAlpha: "none" });
  const { width, height } = bitmap;
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return { width, height, rgba: context.getImageData(0, 0, width, height).data };
}
