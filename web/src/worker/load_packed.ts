// SPDX-License-Identifier: MIT
// The page embeds WebAssembly compressed with gzip, which halves its size.

/** Returns the bytes of a data URL that vite.config.ts created. */
export async function load(url: URL | string): Promise<ArrayBuffer> {
  const { body } = await fetch(url);
  return new Response(body!.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
