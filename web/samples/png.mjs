// SPDX-License-Identifier: MIT
// Images out of nothing.
import { encode } from "fast-png";

/** A square PNG, 8 bits, RGB: texel(x, y) gives three numbers. */
export function png(size, texel) {
  const data = new Uint8Array(3 * size * size);
  for (let y = 0; y < size; ++y) {
    for (let x = 0; x < size; ++x) data.set(texel(x, y), 3 * (y * size + x));
  }
  return encode({ width: size, height: size, channels: 3, depth: 8, data }, { zlib: { level: 9 } });
}
