// SPDX-License-Identifier: MIT
// Decodes KTX2 and DDS to pixels, and converts normal maps to other files, with the package's decoders, which are loaded when
// they are needed.
import { unzlibSync } from "fflate";
import { ZSTDDecoder } from "three/examples/jsm/libs/zstddec.module.js";
import { mapType } from "../files.js";
import { decodeImage, pngOf } from "./images.js";
import type { Calls, ConvertedMap, TexturePixels } from "./protocol.js";

let zstd: Promise<ZSTDDecoder> | undefined;

async function zstdDecoder(): Promise<ZSTDDecoder> {
  const decoder = new ZSTDDecoder();
  await decoder.init();
  return decoder;
}

const startsWith = (file: Uint8Array, text: string): boolean => [...text].every((letter, i) => file[i] === letter.charCodeAt(0));
const isKtx2 = (file: Uint8Array): boolean => startsWith(file, "\u00abKTX 20");

/** Returns the 32-bit number at a byte of the header of a KTX2; 0 for other files. */
const numberAt = (file: Uint8Array, byte: number): number => (file.length > 48 && isKtx2(file) ? new DataView(file.buffer, file.byteOffset).getUint32(byte, true) : 0);
const isZstd = (file: Uint8Array): boolean => numberAt(file, 44) === 2;
/** Returns whether a KTX2 has one of Vulkan's formats for ASTC: normalized or of floats. */
function isAstc(file: Uint8Array): boolean {
  const format = numberAt(file, 12);
  return (format >= 157 && format <= 184) || (format >= 1000066000 && format <= 1000066013);
}

/** Throws for files that the tool can read but this page cannot. */
function refuse(file: Uint8Array): void {
  if (!isKtx2(file) && !startsWith(file, "DDS ")) throw new Error("it is neither KTX2 nor DDS");
  if (isAstc(file)) throw new Error("it is a KTX2 with ASTC data, which this page cannot show; export it as PNG, JPEG or WebP, or as KTX2 with UASTC or ETC1S");
}

async function unpackersFor(file: Uint8Array) {
  const decoder = isZstd(file) ? await (zstd ??= zstdDecoder()) : null;
  return {
    unzstd: decoder && ((packed: Uint8Array, size: number) => decoder.decode(packed, size)),
    unzlib: (packed: Uint8Array, size: number) => unzlibSync(packed, { out: new Uint8Array(size) }),
  };
}

export async function decodeTexture(file: Uint8Array<ArrayBuffer>): Promise<TexturePixels> {
  refuse(file);
  const { readTexture, ready } = await import("tspace/textures"), unpackers = await unpackersFor(file);
  await ready;
  // Decodes like a renderer: a map of two channels keeps blue = 0.
  const { width, height, rgba } = readTexture(file, { numbers: "uint8", vectors: false, ...unpackers });
  return { width, height, rgba: rgba as Uint8ClampedArray<ArrayBuffer> };
}

const isOpaque = (rgba: ArrayLike<number>, most: number): boolean => {
  for (let i = 3; i < rgba.length; i += 4) if (rgba[i] !== most) return false;
  return true;
};

/** Encodes a PNG of red, green and blue, and of alpha unless it is fully opaque. */
function pngFile({ width, height, rgba }: { width: number; height: number; rgba: Uint8ClampedArray | Uint16Array }): Uint8Array<ArrayBuffer> {
  const bits = rgba instanceof Uint16Array ? 16 : 8, numbers = bits === 16 ? (rgba as Uint16Array) : new Uint8Array(rgba);
  if (!isOpaque(numbers, 2 ** bits - 1)) return pngOf({ width, height, channels: 4, bits, data: numbers }) as Uint8Array<ArrayBuffer>;
  const rgb = new (bits === 16 ? Uint16Array : Uint8Array)(3 * width * height);
  for (let i = 0, from = 0; i < rgb.length; i += 3, from += 4) for (let k = 0; k < 3; ++k) rgb[i + k] = numbers[from + k];
  return pngOf({ width, height, channels: 3, bits, data: rgb }) as Uint8Array<ArrayBuffer>;
}

/** Converts a normal map to another file: first its channels to glTF's, then green, then the format. */
export async function convertMapFile({ name, file, reading, to }: Calls["convertMap"]["ask"]): Promise<ConvertedMap> {
  const isTexture = /\.(ktx2|dds)$/i.test(name);
  if (isTexture) refuse(file);
  const { compressMap, convertMap, ready } = await import("tspace/textures"), unpackers = await unpackersFor(file);
  await ready;
  const image = isTexture ? file : await decodeImage(file, mapType(name) as Parameters<typeof decodeImage>[1]);
  const map = convertMap(image, { ...reading, ...unpackers }), { width, height } = map;
  const notes = map.howRead ? [`${map.howRead}.`] : [];
  if (to === "png") return { bytes: pngFile(map), width, height, format: `${map.numbers === "uint16" ? 16 : 8} bits`, notes };
  const [format, container] = to.split(".") as ["bc5" | "eac-rg11", "ktx2" | "dds"];
  const { bytes, report } = compressMap(map, { format, container });
  return { bytes: bytes as Uint8Array<ArrayBuffer>, width, height, format: `${report.format}, ${report.meanErrorDeg.toFixed(2)}° of error on average`, notes: [...notes, ...report.warnings.map((warning) => `${warning}.`)] };
}
