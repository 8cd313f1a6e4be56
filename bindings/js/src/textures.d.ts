// SPDX-License-Identifier: MIT
import type { NewFloat32Array, NewUint8Array } from "./types.js";

export { TspaceError } from "./types.js";

/** Resolves when calls can be made. */
export const ready: Promise<void>;

/** Unpacks into `size` bytes, at once; what is broken throws. */
export type Unpacker = (packed: Uint8Array, size: number) => Uint8Array;

/** What a KTX2 may be packed with once more. */
export interface Unpackers {
  /** Zstandard: `decode` of npm's zstddec or fzstd's `decompress`; in node `zlib.zstdDecompressSync`. */
  unzstd?: Unpacker | null;
  /** zlib: fflate's `unzlibSync`; in node `zlib.inflateSync`. */
  unzlib?: Unpacker | null;
}

/** Numbers of a channel: 0 to 255, 0 to 65535, or 0 to 1 (floats of the file as they are). */
export type Numbers = "uint8" | "uint16" | "float";

export interface ReadTextureOptions extends Unpackers {
  /** 0, the first, is the largest. */
  level?: number;
  /** As the format resolves them unless given: BC4, BC5 and EAC give 16 bits, and so does a z that is made. */
  numbers?: Numbers;
  /** Whether a map of two channels becomes vectors, x, y and a z made of them in red, green and blue. True unless given; false for pictures. */
  vectors?: boolean;
}

export type ChannelName = "red" | "green" | "blue" | "alpha";

export interface Texture {
  /** Of the level. */
  width: number;
  height: number;
  /** In the file. */
  levels: number;
  /** Of the format, 1 to 4. */
  channels: number;
  /** What a channel resolves: 8, 16 or 32. */
  bits: number;
  isFloat: boolean;
  /** The file says that its numbers have the sRGB curve, which normal maps must not have. */
  isSrgb: boolean;
  container: "KTX2" | "DDS";
  /** "BC5", "EAC RG11", "R8G8B8A8". */
  format: string;
  /** Where x and y are, of a format of two channels or of texels that look so (`isGuessed`), and z (null: it is the root of 1 - x² - y²); null where red, green and blue are what they seem. */
  layout: { x: ChannelName; y: ChannelName; z: ChannelName | null; isGuessed: boolean } | null;
  /** A sentence that says how vectors were read; empty where nothing was done. */
  howRead: string;
  /** What `rgba` holds. */
  numbers: Numbers;
  /** Four numbers for each pixel, the top row first. */
  rgba: ReturnType<typeof Uint8ClampedArray.of> | ReturnType<typeof Uint16Array.of> | NewFloat32Array;
}

/**
 * A level of a KTX2 or DDS as pixels: BC1 to BC5, BC7, EAC, UASTC, ETC1S and what is not packed, as docs/reference/image-files.md lists; not ASTC.
 * Throws a TspaceError: "unsupportedFile" for other files, "invalidFile" for what is broken or has a format that is not read.
 */
export function readTexture(file: Uint8Array | ArrayBuffer, options?: ReadTextureOptions): Texture;

/** Four numbers for each pixel, the top row first. Floats are from 0 to 1, as integers divided by the largest one. */
export interface MapPixels {
  width: number;
  height: number;
  rgba: Uint8Array | Uint8ClampedArray | Uint16Array | Float32Array;
}

/** Pixels, the bytes of a KTX2 or DDS, or with `decodeImage` of any other image. */
export type MapImage = MapPixels | Uint8Array | ArrayBuffer;

export interface CompressMapOptions extends Unpackers {
  /** "bc5" for desktops and consoles, "eac-rg11" for phones, "rg8" is not compressed. */
  format?: "bc5" | "eac-rg11" | "rg8";
  quality?: "quick" | "fast" | "best";
  /** Numbers with a sign (SNORM). */
  signed?: boolean;
  /** The first level alone. */
  noLevels?: boolean;
  container?: "ktx2" | "dds";
  /** Meaning of alpha: how much of a texel is surface, which weights smaller levels; anything else; or, unless given, by the texels. */
  alpha?: "auto" | "coverage" | "data";
  /** Of a DDS: Direct3D 10's, unless given; Direct3D 9's with BC5 as ATI2 (with a sign BC5S), or as BC5U. */
  ddsHeader?: "dx10" | "legacy" | "bc5u";
  /** A texture of occlusion, roughness (green) and metalness. Its levels become wider by what the normals of each texel spread. */
  roughness?: MapImage | null;
  /** The material's roughnessFactor, which becomes a part of that texture; 1 unless given. */
  roughnessFactor?: number;
  /** Pixels of images that are neither KTX2 nor DDS, at once. */
  decodeImage?: ((file: Uint8Array, mimeType: string) => MapPixels | null | undefined) | null;
}

/** As the tool's JSON has it (docs/reference/json.md). */
export interface CompressMapReport {
  width: number;
  height: number;
  /** Of a channel of the input. */
  bitsBefore: number;
  /** What was written: "BC5", "BC5 signed". */
  format: string;
  levels: number;
  outputBytes: number;
  roughnessBytes: number;
  /** Between the map as three channels and the first level, as both are filtered, in degrees. */
  meanErrorDeg: number;
  p99ErrorDeg: number;
  maxErrorDeg: number;
  /** Where, in texels from the top left corner. */
  maxErrorX: number;
  maxErrorY: number;
  /** Texels whose z is below 0, laid on the horizon. */
  belowHorizon: number;
  /** Texels that are a tenth or more longer or shorter than unit vectors. */
  notUnit: number;
  /** Means of the roughness of the last level, as plain means and as written; 0 without roughness. */
  meanRoughness: number;
  meanWidenedRoughness: number;
  warnings: string[];
}

/** Packs a normal map in tangent space as `tspace compress-map` does, and gives the same bytes. `roughness` is there where the option is. */
export function compressMap(
  image: MapImage, options?: CompressMapOptions,
): { bytes: NewUint8Array; roughness?: NewUint8Array; report: CompressMapReport };
