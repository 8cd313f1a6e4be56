// SPDX-License-Identifier: MIT
// KTX2 and DDS as pixels, by the decoders of tspace in a module of their own, which is compiled when a model has such an image.
import { unzlibSync } from "fflate";
import { ZSTDDecoder } from "three/examples/jsm/libs/zstddec.module.js";
import wasm from "../../textures.wasm?packed";
import { load } from "./load_packed.js";
import type { TexturePixels } from "./protocol.js";

interface Exports {
  memory: WebAssembly.Memory;
  __wasm_call_ctors(): void;
  allocate(bytes: number): number;
  release(place: number): void;
  decodeTexture(place: number, bytes: number): number;
  errorText(): number;
}

let compiled: Promise<WebAssembly.Module> | undefined;
let zstd: Promise<ZSTDDecoder> | undefined;

async function zstdDecoder(): Promise<ZSTDDecoder> {
  const decoder = new ZSTDDecoder();
  await decoder.init();
  return decoder;
}

/** KTX2 says at byte 44 what its levels are packed with. */
const isZstd = (file: Uint8Array): boolean => file.length > 48 && file[0] === 0xab && new DataView(file.buffer, file.byteOffset).getUint32(44, true) === 2;

/** What the page cannot read and the tool, with other libraries, can: said with what to do. */
const inWords = (why: string): string =>
  why.includes("ASTC") ? "it is a KTX2 of ASTC, which the page cannot show: export it as PNG, JPEG or WebP, or as KTX2 of UASTC or ETC1S" : why;

/** A new instance for each file: what a hostile one leaves behind is thrown away with it. */
export async function decodeTexture(file: Uint8Array<ArrayBuffer>): Promise<TexturePixels> {
  compiled ??= load(wasm).then((bytes) => WebAssembly.compile(bytes));
  const decoder = isZstd(file) ? await (zstd ??= zstdDecoder()) : null;
  let exports: Exports;
  const unpack = (isZlib: number, from: number, bytes: number, to: number, size: number): number => {
    try {
      const packed = new Uint8Array(exports.memory.buffer, from, bytes).slice();
      const unpacked = isZlib ? unzlibSync(packed, { out: new Uint8Array(size) }) : decoder!.decode(packed, size);
      if (unpacked.length !== size) return 0;
      new Uint8Array(exports.memory.buffer, to, size).set(unpacked);
      return 1;
    } catch {
      return 0;
    }
  };
  const endCall = (code: number) => {
    throw new Error(code === 9 ? "there is no memory for its pixels" : "it is broken");
  };
  exports = (await WebAssembly.instantiate(await compiled, { env: { unpack, endCall } })).exports as unknown as Exports;
  exports.__wasm_call_ctors();
  const place = exports.allocate(file.length);
  if (place === 0) throw new Error("there is no memory for it");
  new Uint8Array(exports.memory.buffer, place, file.length).set(file);
  const head = exports.decodeTexture(place, file.length);
  if (head === 0) {
    const text = exports.errorText(), all = new Uint8Array(exports.memory.buffer);
    throw new Error(inWords(new TextDecoder().decode(all.slice(text, all.indexOf(0, text)))));
  }
  const [width, height, pixels] = new Uint32Array(exports.memory.buffer, head, 3);
  return { width, height, rgba: new Uint8ClampedArray(exports.memory.buffer, pixels, 4 * width * height).slice() };
}
