// SPDX-License-Identifier: MIT
// Modules embedded in JavaScript, as gzip-compressed text.

export function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
