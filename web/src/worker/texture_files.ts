// SPDX-License-Identifier: MIT
// Decodes KTX2 and DDS to pixels with the package's decoders, which are loaded when a model has such an image.
import { unzlibSync } from "fflate";
import { ZSTDDecoder } from "three/examples/jsm/libs/zstddec.module.js";
import type { TexturePixels } from "./protocol.js";

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

export async function decodeTexture(file: Uint8Array<ArrayBuffer>): Promise<TexturePixels> {
  const { readTexture, ready } = await import("tspace/textures");
  await ready;
  const decoder = isZstd(file) ? await (zstd ??= zstdDecoder()) : null;
  const unzstd = decoder && ((packed: Uint8Array, size: number) => decoder.decode(packed, size));
  const unzlib = (packed: Uint8Array, size: number) => unzlibSync(packed, { out: new Uint8Array(size) });
  try {
    // Decodes like a renderer: a map of two channels keeps blue = 0.
    const { width, height, rgba } = readTexture(file, { numbers: "uint8", vectors: false, unzstd, unzlib });
    return { width, height, rgba: rgba as Uint8ClampedArray<ArrayBuffer> };
  } catch (error) {
    throw new Error(inWords((error as Error).message));
  }
}
