// SPDX-License-Identifier: MIT
// Converts a repaired GLB to the form of the original model: a .gltf with its buffer, and its images under their
// original names.
import { zipSync } from "fflate";
import { fileUris, type ModelFiles } from "../files.js";
import { readGlb, type Json } from "./glb.js";

type Bytes = Uint8Array<ArrayBuffer>;

/** Extensions that reference buffer views by other names than `bufferView`. */
const kOwnReferences = /^EXT_(structural|feature|instance)_(metadata|features)$|_meshopt_compression$/;

const pathOf = (uri: string): string => decodeURIComponent(uri).replace(/^\.\//, "");
const isFile = (uri: string | undefined): uri is string => uri !== undefined && !/^[a-z][a-z0-9+.-]*:/i.test(uri);

/** Renumbers all members named `bufferView`, at any depth. */
function renumber(value: unknown, numbers: readonly number[]): void {
  if (typeof value !== "object" || value === null) return;
  for (const [name, inner] of Object.entries(value)) {
    if (name === "bufferView" && typeof inner === "number") (value as Record<string, unknown>)[name] = numbers[inner];
    else renumber(inner, numbers);
  }
}

/** Removes buffer views and their bytes. */
function without(json: Json, binary: Bytes, taken: ReadonlySet<number>): Bytes {
  const pieces: { at: number; bytes: Bytes }[] = [], numbers: number[] = [], kept: NonNullable<Json["bufferViews"]> = [];
  let size = 0;
  // Sorted by position; views that share bytes are kept together.
  const views = json.bufferViews ?? [], order = [...views.keys()].filter((i) => !taken.has(i)).sort((a, b) => (views[a].byteOffset ?? 0) - (views[b].byteOffset ?? 0));
  const starts = new Map<number, number>();
  let end = 0, shift = 0;
  for (const i of order) {
    const { byteOffset = 0, byteLength } = views[i];
    if (byteOffset >= end) {
      size = 4 * Math.ceil(size / 4);
      // Preserves alignment to 16 bytes, which some readers may require.
      while (size % 16 !== byteOffset % 16) size += 4;
      shift = size - byteOffset;
    }
    const from = Math.max(byteOffset, end), to = byteOffset + byteLength;
    if (to > from) pieces.push({ at: from + shift, bytes: binary.subarray(from, to) });
    end = Math.max(end, to);
    size = Math.max(size, to + shift);
    starts.set(i, byteOffset + shift);
  }
  for (const [i, view] of views.entries()) {
    numbers.push(taken.has(i) ? -1 : kept.push({ ...view, byteOffset: starts.get(i)! }) - 1);
  }
  json.bufferViews = kept;
  renumber(json, numbers);
  const packed = new Uint8Array(size);
  for (const { at, bytes } of pieces) packed.set(bytes, at);
  return packed;
}

/**
 * Returns the files of the folder by path, or null if the original model was not a .gltf with files, or cannot be split
 * again.
 */
export function folderOf(fixed: Bytes, source: ModelFiles): Map<string, Bytes> | null {
  if (!/\.gltf$/i.test(source.name) || fileUris(source.bytes).length === 0) return null;
  const { json, binary } = readGlb(fixed), before = JSON.parse(new TextDecoder().decode(source.bytes)) as Json;
  if (json.extensionsUsed?.some((name) => kOwnReferences.test(name))) return null;
  const files = new Map(source.others), taken = new Set<number>();
  for (const { uri } of before.buffers ?? []) if (isFile(uri)) files.delete(pathOf(uri));
  const written = new Map<string, Bytes>();
  for (const [i, image] of (json.images ?? []).entries()) {
    const uri = before.images?.[i]?.uri, view = image.bufferView === undefined ? undefined : json.bufferViews?.[image.bufferView];
    if (!isFile(uri) || !view) continue;
    const bytes = binary.slice(view.byteOffset ?? 0, (view.byteOffset ?? 0) + view.byteLength), path = pathOf(uri), there = written.get(path);
    // If two images share a file and one of them has changed, they cannot have the same name.
    if (there && !isSame(there, bytes)) continue;
    written.set(path, bytes);
    files.set(path, bytes);
    taken.add(image.bufferView!);
    delete image.bufferView;
    if (before.images?.[i].mimeType === undefined) delete image.mimeType;
    image.uri = uri;
  }
  const packed = without(json, binary, taken), stem = source.name.replace(/^.*\//, "").replace(/\.gltf$/i, "");
  const name = (before.buffers ?? []).map(({ uri }) => uri).find(isFile) ?? `${encodeURIComponent(stem)}.bin`;
  json.buffers = [{ byteLength: packed.length, uri: name }];
  files.set(pathOf(name), packed);
  files.set(source.name, new TextEncoder().encode(`${JSON.stringify(json, null, 2)}\n`));
  return files;
}

const isSame = (a: Bytes, b: Bytes): boolean => a.length === b.length && a.every((byte, i) => byte === b[i]);

/**
 * Returns a .zip with all files in a folder. Images are stored without compression, because they are compressed
 * already.
 */
export function zipOf(files: ReadonlyMap<string, Bytes>, folder: string): Bytes {
  const entries = [...files].filter(([path]) => !path.split("/").includes("..")).sort(([a], [b]) => (a < b ? -1 : 1));
  return zipSync(Object.fromEntries(entries.map(([path, bytes]) => [`${folder}/${path}`, [bytes, { level: /\.(png|jpe?g|webp|ktx2|zip)$/i.test(path) ? 0 : 6 }]]))) as Bytes;
}
