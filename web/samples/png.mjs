// SPDX-License-Identifier: MIT
// Generates PNG images.
import { encode } from "fast-png";

/** Returns a square PNG with 8-bit RGB; texel(x, y) returns three numbers. */
export function png(size, texel) {
  const data = new Uint8Array(3 * size * size);
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) data.set(texel(x, y), 3 * (y * size + x));
  }
  return encode({ width: size, height: size, channels: 3, depth: 8, data }, { zlib: { level: 9 } });
}
