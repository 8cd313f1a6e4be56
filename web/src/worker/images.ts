// SPDX-License-Identifier: MIT
// Decodes and encodes normal maps. PNG is handled here, because browsers decode it to 8 bits and multiply colors by
// alpha; JPEG and WebP are left to the browser.
import { convertIndexedToRgb, decode, encode } from "fast-png";
import { decodeByCanvas, type ImageType, type Pixels, type PixelsToEncode } from "tspace/gltf";

const isOpaque = (rgba: ArrayLike<number>): boolean => {
  for (let i = 3; i < rgba.length; i += 4) if (rgba[i] !== 255) return false;
  return true;
};

/** Decodes PNG; null for rare kinds, which the browser decodes. */
function pixelsOfPng(file: Uint8Array): Pixels | null {
  const image = decode(file, { checkCrc: true }), { width, height, depth } = image;
  if (depth < 8 && !image.palette) return null;
  const data = image.palette ? convertIndexedToRgb(image) : image.data;
  const channels = data.length / (width * height), hasColor = channels > 2, hasAlpha = channels % 2 === 0;
  const rgba = new (depth === 16 ? Uint16Array : Uint8Array)(4 * width * height);
  for (let to = 0, from = 0; to < rgba.length; to += 4, from += channels) {
    for (let k = 0; k < 3; ++k) rgba[to + k] = data[hasColor ? from + k : from];
    rgba[to + 3] = hasAlpha ? data[from + channels - 1] : depth === 16 ? 65535 : 255;
  }
  return { width, height, rgba };
}

export async function decodeImage(file: Uint8Array, type: ImageType): Promise<Pixels> {
  const png = type === "image/png" ? pixelsOfPng(file) : null;
  if (png) return png;
  const pixels = await decodeByCanvas(file, type);
  if (!isOpaque(pixels.rgba)) throw new Error("the image is transparent, and browsers do not return the exact colors of transparent images");
  return pixels;
}

export const pngOf = ({ width, height, channels, bits, data }: Omit<PixelsToEncode, "quality">): Uint8Array => encode({ width, height, channels, depth: bits, data }, { zlib: { level: 6 } });

async function fileByCanvas({ width, height, channels, data }: PixelsToEncode, type: ImageType): Promise<Uint8Array> {
  const image = new ImageData(width, height);
  for (let i = 0; i < width * height; ++i) {
    for (let k = 0; k < 3; ++k) image.data[4 * i + k] = data[channels * i + k];
    image.data[4 * i + 3] = channels === 4 ? data[channels * i + 3] : 255;
  }
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext("2d")!.putImageData(image, 0, 0);
  // The best quality: lower ones average colors, and therefore directions, over neighboring pixels. WebP is then
  // lossless.
  const blob = await canvas.convertToBlob({ type, quality: 1 });
  if (blob.type !== type) throw new Error(`This browser cannot write ${type.slice(6)}. Use tspace generate --flip-green instead.`);
  return new Uint8Array(await blob.arrayBuffer());
}

class NotYet extends Error {
  constructor(readonly pixels: PixelsToEncode, readonly type: ImageType) {
    super("an image is already being written");
  }
}

/**
 * Runs `call` with a function that encodes images. Calls of tspace are synchronous, but browsers encode asynchronously:
 * a call is aborted at the first image that is not encoded yet, and repeated when it is.
 */
export async function withEncoder<T>(call: (encodeImage: (pixels: PixelsToEncode, type: ImageType) => Uint8Array) => T): Promise<T> {
  const files: Uint8Array[] = [];
  for (;;) {
    let next = 0;
    const encodeImage = (pixels: PixelsToEncode, type: ImageType): Uint8Array => {
      if (type === "image/png") return pngOf(pixels);
      if (next === files.length) throw new NotYet(pixels, type);
      return files[next++];
    };
    try {
      return call(encodeImage);
    } catch (error) {
      if (!(error instanceof NotYet)) throw error;
      files.push(await fileByCanvas(error.pixels, error.type));
    }
  }
}
