// SPDX-License-Identifier: MIT
// The normal map of several figures, a plate with bolts, and pictures of pixels.

import { unit, type Vec3 } from "./vector";

const kSize = 256;

/** Returns the height of the surface: a plate with a rim, four bolts and a groove. */
function height(u: number, v: number): number {
  const rise = (x: number, width: number) => Math.min(1, Math.max(0, x / width + 0.5));
  const plate = rise(Math.min(u - 0.1, 0.9 - u, v - 0.1, 0.9 - v), 0.04);
  let at = 0.045 * plate;
  for (const [x, y] of [[0.24, 0.24], [0.76, 0.24], [0.24, 0.76], [0.76, 0.76]] as const) {
    at += 0.9 * Math.max(0, Math.sqrt(Math.max(0, 0.0075 - (u - x) ** 2 - (v - y) ** 2)) - 0.02);
  }
  return at - 0.05 * Math.max(0, 1 - Math.abs(Math.hypot(u - 0.5, v - 0.5) - 0.2) / 0.035);
}

/** Returns the normal of this height field; its components are along u, v and the surface normal. */
function normalAt(u: number, v: number): Vec3 {
  const step = 0.004, slope = (a: number, b: number) => (a - b) / (2 * step);
  return unit([-slope(height(u + step, v), height(u - step, v)), -slope(height(u, v + step), height(u, v - step)), 1]);
}

let texels: Vec3[] | undefined;

/** Returns the texel at a UV; the map repeats. */
export function texelAt(u: number, v: number): Vec3 {
  texels ??= Array.from({ length: kSize * kSize }, (_, i) => normalAt(((i % kSize) + 0.5) / kSize, (Math.floor(i / kSize) + 0.5) / kSize));
  const column = Math.floor((u - Math.floor(u)) * kSize), row = Math.floor((v - Math.floor(v)) * kSize);
  return texels[Math.min(row, kSize - 1) * kSize + Math.min(column, kSize - 1)]!;
}

export const colorOf = (n: Vec3): number[] => n.map((x) => Math.round(255 * (0.5 * x + 0.5)));

/** Returns the gray level of a lit surface: ambient light, and Lambert's law for the lamp. */
export const grayOf = (cosine: number): number => Math.round(255 * Math.sqrt(0.03 + 0.92 * Math.max(0, cosine)));

/** Returns a picture as a data URL. `at` receives positions from 0 to 1, y up, and returns a color, or null for a transparent pixel. */
export function picture(width: number, height: number, at: (x: number, y: number) => readonly number[] | null): string {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const pixels = canvas.getContext("2d");
  if (!pixels) return "";
  const image = pixels.createImageData(width, height);
  for (let i = 0; i < width * height; ++i) {
    const color = at(((i % width) + 0.5) / width, 1 - (Math.floor(i / width) + 0.5) / height);
    if (color) image.data.set([...color, 255], 4 * i);
  }
  pixels.putImageData(image, 0, 0);
  return canvas.toDataURL();
}
