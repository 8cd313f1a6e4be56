// SPDX-License-Identifier: MIT
// Models that scripts/web makes, and faults put into them. They are in the page, since nothing is loaded later.
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

/** The crate's arrays where they lie in its bytes. */
function crateArrays(): { bytes: Uint8Array<ArrayBuffer>; read: (attribute: string, size: number) => Float32Array<ArrayBuffer> } {
  const bytes = decoded(crate), view = new DataView(bytes.buffer);
  const textBytes = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + textBytes)));
  const read = (attribute: string, size: number) => {
    const { bufferView, count } = json.accessors[json.meshes[0].primitives[0].attributes[attribute]];
    return new Float32Array(bytes.buffer, 28 + textBytes + json.bufferViews[bufferView].byteOffset, size * count);
  };
  return { bytes, read };
}

/** The crate with other tangents: `change` gets the array of all, four numbers a vertex, and a reader of the other arrays. */
function withTangents(change: (tangents: Float32Array, read: (attribute: string, size: number) => Float32Array) => void): () => Uint8Array<ArrayBuffer> {
  return () => {
    const { bytes, read } = crateArrays();
    change(read("TANGENT", 4), read);
    return bytes;
  };
}

/** As an exporter leaves them that forgets the fourth number: every sign is +1. */
const signsLost = withTangents((tangents) => {
  for (let i = 3; i < tangents.length; i += 4) tangents[i] = 1;
});

const signsInverted = withTangents((tangents) => {
  for (let i = 3; i < tangents.length; i += 4) tangents[i] = -tangents[i];
});

const alongNormals = withTangents((tangents, read) => {
  const normals = read("NORMAL", 3);
  for (let v = 0; v < tangents.length / 4; ++v) tangents.set(normals.subarray(3 * v, 3 * v + 3), 4 * v);
});

/** As of a tool that turned the model from Z up to Y up, and its tangents not. */
const wrongAxes = withTangents((tangents) => {
  for (let i = 0; i < tangents.length; i += 4) [tangents[i + 1], tangents[i + 2]] = [-tangents[i + 2], tangents[i + 1]];
});

/** Means over all vertices at a place, on both sides of seams of the UV map. */
const averagedSeams = withTangents((tangents, read) => {
  const positions = read("POSITION", 3), normals = read("NORMAL", 3), sums = new Map<string, number[]>();
  const key = (v: number) => [...positions.subarray(3 * v, 3 * v + 3), ...normals.subarray(3 * v, 3 * v + 3)].map((x) => x.toFixed(5)).join();
  for (let v = 0; v < tangents.length / 4; ++v) {
    const sum = sums.get(key(v)) ?? [0, 0, 0];
    sums.set(key(v), sum.map((x, k) => x + tangents[4 * v + k]));
  }
  for (let v = 0; v < tangents.length / 4; ++v) {
    const sum = sums.get(key(v))!, length = Math.hypot(...sum);
    if (length > 0.01) tangents.set(sum.map((x) => x / length), 4 * v);
  }
});

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

/** Faults as they are found in real files, each on the crate. */
export const faults: readonly Sample[] = [
  sample("every sign inverted", "crate-signs-inverted.glb", "MikkTSpace was fed with v as glTF stores it", signsInverted),
  sample("signs lost", "crate-signs-lost.glb", "The exporter forgot the fourth number of tangents", signsLost),
  sample("averaged over seams", "crate-seams-averaged.glb", "Tangents were averaged over both sides of seams of the UV map", averagedSeams),
  sample("T along N", "crate-along-normals.glb", "Tangents are the normals: cross(N, T) vanishes", alongNormals),
  sample("other axes", "crate-wrong-axes.glb", "The model was turned from Z up to Y up, and its tangents not", wrongAxes),
  sample("green points down", "ring-directx.glb", "A normal map made for DirectX", () => decoded(ring)),
];
