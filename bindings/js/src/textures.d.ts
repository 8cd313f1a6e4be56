// SPDX-License-Identifier: MIT
import type { NewFloat32Array, NewUint8Array } from "./types.js";

export { TspaceError } from "./types.js";

/** Resolves when the module is ready for calls. */
export const ready: Promise<void>;

/** Decompresses to `size` bytes synchronously; throws for corrupt data. */
export type Unpacker = (packed: Uint8Array, size: number) => Uint8Array;

/** Decompressors for supercompressed KTX2. */
export interface Unpackers {
  /** Zstandard: `decode` of npm's zstddec or fzstd's `decompress`; in node `zlib.zstdDecompressSync`. */
  unzstd?: Unpacker | null;
  /** zlib: fflate's `unzlibSync`; in node `zlib.inflateSync`. */
  unzlib?: Unpacker | null;
}

/** Number type of a channel: 0 to 255, 0 to 65535, or 0 to 1 (floats of the file are unchanged). */
export type Numbers = "uint8" | "uint16" | "float";

export interface ReadTextureOptions extends Unpackers {
  /** Mip level; 0 is the largest. */
  level?: number;
  /** Default: the precision of the format; 16 bits for BC4, BC5, EAC, and maps with a reconstructed z. */
  numbers?: Numbers;
  /**
   * Whether a two-channel map becomes vectors: x, y and a reconstructed z in red, green and blue. Default: true; use
   * false for pictures.
   */
  vectors?: boolean;
}

export type ChannelName = "red" | "green" | "blue" | "alpha";

export interface Texture {
  /** Size of the level. */
  width: number;
  height: number;
  /** Number of levels in the file. */
  levels: number;
  /** Channels of the format, 1 to 4. */
  channels: number;
  /** Precision of a channel: 8, 16 or 32 bits. */
  bits: number;
  isFloat: boolean;
  /** The file declares its values as sRGB, which is wrong for normal maps. */
  isSrgb: boolean;
  container: "KTX2" | "DDS";
  /** Name of the format, such as "BC5", "EAC RG11" or "R8G8B8A8". */
  format: string;
  /**
   * Channels that hold x, y and z; null if these are red, green and blue. Other channels follow from a two-channel
   * format, or from texels that look like one (`isGuessed`). `z` is null if it is the square root of 1 - x² - y².
   */
  layout: { x: ChannelName; y: ChannelName; z: ChannelName | null; isGuessed: boolean } | null;
  /** A sentence on how vectors were interpreted; empty if values are unchanged. */
  howRead: string;
  /** Number type of `rgba`. */
  numbers: Numbers;
  /** Four numbers per pixel, top row first. */
  rgba: ReturnType<typeof Uint8ClampedArray.of> | ReturnType<typeof Uint16Array.of> | NewFloat32Array;
}

/**
 * Decodes a level of a KTX2 or DDS to pixels: BC1 to BC5, BC7, EAC, UASTC, ETC1S and uncompressed formats, as listed in
 * docs/reference/image-files.md; not ASTC. Throws a TspaceError: "unsupportedFile" for other files, "invalidFile" for
 * corrupt files and unsupported formats.
 */
export function readTexture(file: Uint8Array | ArrayBuffer, options?: ReadTextureOptions): Texture;

/** Four numbers per pixel, top row first. Floats are from 0 to 1: integers divided by their maximum. */
export interface MapPixels {
  width: number;
  height: number;
  rgba: Uint8Array | Uint8ClampedArray | Uint16Array | Float32Array;
}

/** Pixels, the bytes of a KTX2 or DDS, or with `decodeImage` of any other image. */
export type MapImage = MapPixels | Uint8Array | ArrayBuffer;

export interface ConvertMapOptions extends Unpackers {
  /** Channels that hold x, y and z, as `tspace convert-map --channels` reads them: "rg", "ag", "bgr" (x, y, z and w mean r, g, b and a); a capital letter inverts a channel; with two letters z is computed. Default: the layout of the file. */
  channels?: string | null;
  /** "srgb" removes an sRGB encoding, "linearized" reapplies it. Default: "none". */
  curve?: "none" | "srgb" | "linearized";
  /** Inverts x. */
  flipRed?: boolean;
  /** Inverts y: DirectX to OpenGL and back. */
  flipGreen?: boolean;
  /** Returns the pixels of images that are neither KTX2 nor DDS. */
  decodeImage?: ((file: Uint8Array, mimeType: string) => MapPixels | null | undefined) | null;
}

export interface ConvertedMap {
  width: number;
  height: number;
  /** Bits of a channel of the input. */
  bitsBefore: number;
  /** A sentence that says how a texture with two channels was read; empty for other images. */
  howRead: string;
  /** "uint8" if the only change to an 8-bit image is an inverted green channel, which is exact; otherwise "uint16". */
  numbers: "uint8" | "uint16";
  /** Four numbers for each pixel, the top row first. */
  rgba: ReturnType<typeof Uint8ClampedArray.of> | ReturnType<typeof Uint16Array.of>;
}

/** Converts a normal map as `tspace convert-map` does without a mesh, and returns the same numbers. */
export function convertMap(image: MapImage, options?: ConvertMapOptions): ConvertedMap;

export interface CompressMapOptions extends Unpackers {
  /** "bc5" for desktops and consoles, "eac-rg11" for phones, "rg8" is uncompressed. */
  format?: "bc5" | "eac-rg11" | "rg8";
  quality?: "quick" | "fast" | "best";
  /** Signed values (SNORM). */
  signed?: boolean;
  /** Write only the first level. */
  noLevels?: boolean;
  container?: "ktx2" | "dds";
  /**
   * Meaning of alpha: coverage of a texel, which weights smaller levels, or other data. Default: determined from the
   * texels.
   */
  alpha?: "auto" | "coverage" | "data";
  /**
   * Header of a DDS. "dx10" (the default): Direct3D 10. "legacy": Direct3D 9, which names BC5 ATI2 (signed: BC5S).
   * "bc5u": Direct3D 9 with the name BC5U.
   */
  ddsHeader?: "dx10" | "legacy" | "bc5u";
  /**
   * A texture of occlusion, roughness (green) and metalness. Its mip levels become rougher where the normals of a texel
   * differ.
   */
  roughness?: MapImage | null;
  /** The material's roughnessFactor, which is applied to that texture. Default: 1. */
  roughnessFactor?: number;
  /** Decodes images other than KTX2 and DDS synchronously. */
  decodeImage?: ((file: Uint8Array, mimeType: string) => MapPixels | null | undefined) | null;
}

/** Same members as the tool's JSON (docs/reference/json.md). */
export interface CompressMapReport {
  width: number;
  height: number;
  /** Bits per channel of the input. */
  bitsBefore: number;
  /** Written format: "BC5", "BC5 signed". */
  format: string;
  levels: number;
  outputBytes: number;
  roughnessBytes: number;
  /** Angle between the three-channel map and the first level, both filtered, in degrees. */
  meanErrorDeg: number;
  p99ErrorDeg: number;
  maxErrorDeg: number;
  /** Position of the maximum error, in texels from the top left corner. */
  maxErrorX: number;
  maxErrorY: number;
  /** Texels with z below 0, which are clamped to the horizon. */
  belowHorizon: number;
  /** Texels whose length deviates from 1 by 0.1 or more. */
  notUnit: number;
  /** Mean roughness of the last level, as a plain mean and as written; 0 without roughness. */
  meanRoughness: number;
  meanWidenedRoughness: number;
  warnings: string[];
}

/**
 * Compresses a normal map in tangent space, with the same bytes as `tspace compress-map`. `roughness` is returned if
 * the option is set.
 */
export function compressMap(
  image: MapImage, options?: CompressMapOptions,
): { bytes: NewUint8Array; roughness?: NewUint8Array; report: CompressMapReport };
