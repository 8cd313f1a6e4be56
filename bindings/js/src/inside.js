// SPDX-License-Identifier: MIT
// Modules that lie in JavaScript, as text of what gzip makes of them.

export function unpacked(text) {
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
