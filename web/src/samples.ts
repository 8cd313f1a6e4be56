// SPDX-License-Identifier: MIT
// Three models that scripts/web makes. They are in the page, since nothing is loaded later.
import { fromBase64 } from "./base64.js";
import ring from "../samples/ring-directx.glb?inline";
import crate from "../samples/crate.glb?inline";

export interface Sample {
  name: string;
  file: string;
  hint: string;
  bytes: () => Uint8Array<ArrayBuffer>;
}

const decoded = (url: string): Uint8Array<ArrayBuffer> => fromBase64(url.slice(url.indexOf(",") + 1));

/** The crate as an exporter leaves it that forgets the fourth number of tangents: every sign is +1. */
function signsLost(): Uint8Array<ArrayBuffer> {
  const bytes = decoded(crate), view = new DataView(bytes.buffer);
  const textBytes = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + textBytes)));
  const { bufferView, count } = json.accessors[json.meshes[0].primitives[0].attributes.TANGENT];
  const first = 28 + textBytes + json.bufferViews[bufferView].byteOffset;
  for (let vertex = 0; vertex < count; ++vertex) view.setFloat32(first + 16 * vertex + 12, 1, true);
  return bytes;
}

const sample = (name: string, file: string, hint: string, bytes: () => Uint8Array<ArrayBuffer>): Sample => ({
  name,
  file,
  hint,
  bytes,
});

export const samples: readonly Sample[] = [
  sample("Crate, broken", "crate-signs-lost.glb", "A crate whose exporter lost the signs: half of it is mirrored, and lit from the wrong side", signsLost),
  sample("Crate", "crate.glb", "The same crate as it should be", () => decoded(crate)),
  sample("Ring", "ring-directx.glb", "A ring without tangents, and with a normal map whose green points down", () => decoded(ring)),
];
