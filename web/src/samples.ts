// SPDX-License-Identifier: MIT
// Models that scripts/web generates, and faults inserted into them. They are embedded, because the page loads nothing
// later. samples/pictures.mjs renders their pictures.
import { fromBase64 } from "./base64.js";
import { bear } from "./bear.js";
import ring from "../samples/ring-directx.glb?inline";
import crate from "../samples/crate.glb?inline";
import pictureAlong from "../samples/pictures/crate-along-normals.webp?inline";
import pictureInverted from "../samples/pictures/crate-signs-inverted.webp?inline";
import pictureSignsLost from "../samples/pictures/crate-signs-lost.webp?inline";
import pictureSeams from "../samples/pictures/crate-seams-shared.webp?inline";
import pictureAxes from "../samples/pictures/crate-wrong-axes.webp?inline";
import pictureSet from "../samples/pictures/crate-wrong-set.webp?inline";
import pictureCrate from "../samples/pictures/crate.webp?inline";
import pictureBear from "../samples/pictures/bear-by-ai.webp?inline";
import pictureRing from "../samples/pictures/ring-directx.webp?inline";

export interface Sample {
  name: string;
  file: string;
  hint: string;
  /** Small picture of the sample: the file on the left, fixed on the right. */
  picture: string;
  bytes: () => Uint8Array<ArrayBuffer>;
}

const decoded = (url: string): Uint8Array<ArrayBuffer> => fromBase64(url.slice(url.indexOf(",") + 1));

/** Returns the bytes of the crate, and a function that reads an attribute in place. */
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

/**
 * Returns the crate with changed tangents. `change` receives all tangents (four numbers per vertex) and a function that
 * reads other attributes.
 */
function withTangents(change: (tangents: Float32Array, read: (attribute: string, size: number) => Float32Array) => void): () => Uint8Array<ArrayBuffer> {
  return () => {
    const { bytes, read } = crateArrays();
    change(read("TANGENT", 4), read);
    return bytes;
  };
}

/** Every sign is +1, as if written by an exporter that omits the sign. */
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

/** Tangents as if a tool had rotated the model from Z up to Y up, but not its tangents. */
const wrongAxes = withTangents((tangents) => {
  for (let i = 0; i < tangents.length; i += 4) [tangents[i + 1], tangents[i + 2]] = [-tangents[i + 2], tangents[i + 1]];
});

/**
 * Both sides of UV seams share one tangent, as written with the index list from before the split; each side keeps its
 * sign.
 */
const sharedSeams = withTangents((tangents, read) => {
  const positions = read("POSITION", 3), normals = read("NORMAL", 3), firsts = new Map<string, number>();
  const key = (v: number) => [...positions.subarray(3 * v, 3 * v + 3), ...normals.subarray(3 * v, 3 * v + 3)].map((x) => x.toFixed(5)).join();
  for (let v = 0; v < tangents.length / 4; ++v) {
    const first = firsts.get(key(v)) ?? v;
    firsts.set(key(v), first);
    tangents.copyWithin(4 * v, 4 * first, 4 * first + 3);
  }
});

/** Adds a second UV set, rotated by 90 degrees, and tangents along it, although the textures use the first set. */
function wrongSet(): Uint8Array<ArrayBuffer> {
  const { bytes, read } = crateArrays(), view = new DataView(bytes.buffer), textBytes = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + textBytes)));
  const tangents = read("TANGENT", 4), normals = read("NORMAL", 3), uvs = read("TEXCOORD_0", 2);
  // u of the second set increases along B of the first: T' = B = w cross(N, T).
  for (let v = 0; v < tangents.length / 4; ++v) {
    const [x, y, z, w] = tangents.subarray(4 * v, 4 * v + 4), [nx, ny, nz] = normals.subarray(3 * v, 3 * v + 3);
    tangents.set([w * (ny * z - nz * y), w * (nz * x - nx * z), w * (nx * y - ny * x)], 4 * v);
  }
  // In glTF v points down, and B up.
  const second = Float32Array.from(uvs, (_, i) => (i % 2 === 0 ? 1 - uvs[i + 1] : uvs[i - 1]));
  const old = bytes.subarray(28 + textBytes);
  json.bufferViews.push({ buffer: 0, byteOffset: old.length, byteLength: second.byteLength });
  json.accessors.push({ bufferView: json.bufferViews.length - 1, componentType: 5126, count: second.length / 2, type: "VEC2" });
  json.meshes[0].primitives[0].attributes.TEXCOORD_1 = json.accessors.length - 1;
  json.buffers[0].byteLength = old.length + second.byteLength;
  const text = new TextEncoder().encode(JSON.stringify(json)), padded = Math.ceil(text.length / 4) * 4;
  const made = new Uint8Array(28 + padded + old.length + second.byteLength).fill(0x20, 20, 20 + padded), words = new DataView(made.buffer);
  [0x46546c67, 2, made.length, padded, 0x4e4f534a].forEach((word, i) => words.setUint32(4 * i, word, true));
  [old.length + second.byteLength, 0x004e4942].forEach((word, i) => words.setUint32(20 + padded + 4 * i, word, true));
  made.set(text, 20);
  made.set(old, 28 + padded);
  made.set(new Uint8Array(second.buffer), 28 + padded + old.length);
  return made;
}

const sample = (name: string, file: string, hint: string, picture: string, bytes: () => Uint8Array<ArrayBuffer>): Sample => ({ name, file, hint, picture, bytes });

/**
 * Faults that occur in real files, named by their visible effect, and one model without a fault. The first sample is
 * shown when the page opens.
 */
export const samples: readonly Sample[] = [
  sample("Dents on one half", "crate-signs-lost.glb", "The exporter dropped the sign (w) of the tangents, so bumps look like dents on the mirrored half of the crate", pictureSignsLost, signsLost),
  sample("DirectX map", "ring-directx.glb", "A ring without tangents, with a normal map made for DirectX (green points down)", pictureRing, () => decoded(ring)),
  sample("Dents everywhere", "crate-signs-inverted.glb", "Every sign is inverted, because MikkTSpace was given v as glTF stores it", pictureInverted, signsInverted),
  sample("Dark seams", "crate-seams-shared.glb", "Both sides of UV seams share one tangent, because vertices were not split at the seams", pictureSeams, sharedSeams),
  sample("Flat bumps", "crate-along-normals.glb", "The tangents are copies of the normals, so there is no bitangent", pictureAlong, alongNormals),
  sample("Wrong UV set", "crate-wrong-set.glb", "The tangents follow the second UV set (for light maps) instead of that of the normal map", pictureSet, wrongSet),
  sample("Rotated light", "crate-wrong-axes.glb", "The model was converted from z up to y up, but its tangents were not", pictureAxes, wrongAxes),
  sample("AI mesh", "bear-by-ai.glb", "A generated mesh: noisy positions, and patches of triangles that face inward", pictureBear, bear),
  sample("No errors", "crate.glb", "The crate with correct tangents", pictureCrate, () => decoded(crate)),
];
