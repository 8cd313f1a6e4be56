// SPDX-License-Identifier: MIT
// Stores the user's last model in the browser (OPFS), so that it is available after a reload. It never leaves the
// computer, and one button removes it. Pages opened from disk have no such storage, and private windows may have none.
import type { ModelFiles } from "./files.js";

const kFolder = "model", kIndex = "index.json";
/** Larger models are not stored: writing them would take as long as opening them. */
const kMostBytes = 300 << 20;

interface Index {
  name: string;
  others: string[];
}

const folder = async (create: boolean): Promise<FileSystemDirectoryHandle> => (await navigator.storage.getDirectory()).getDirectoryHandle(kFolder, { create });

async function write(place: FileSystemDirectoryHandle, name: string, content: FileSystemWriteChunkType): Promise<void> {
  const stream = await (await place.getFileHandle(name, { create: true })).createWritable();
  await stream.write(content);
  await stream.close();
}

const read = async (place: FileSystemDirectoryHandle, name: string): Promise<Uint8Array<ArrayBuffer>> =>
  new Uint8Array(await (await (await place.getFileHandle(name)).getFile()).arrayBuffer());

/** Stores the files of a model, replacing the previous one. Returns false if the browser has no storage. */
export async function keepModel({ name, bytes, others }: ModelFiles): Promise<boolean> {
  const size = [bytes, ...others.values()].reduce((sum, file) => sum + file.length, 0);
  try {
    await forgetModel();
    if (size > kMostBytes) return false;
    const place = await folder(true), index: Index = { name, others: [...others.keys()] };
    await write(place, "0", bytes);
    for (const [i, path] of index.others.entries()) await write(place, String(i + 1), others.get(path)!);
    await write(place, kIndex, JSON.stringify(index)); // written last, so that an incomplete model is ignored
    return true;
  } catch {
    return false;
  }
}

/** Returns the stored model, or null. */
export async function keptModel(): Promise<ModelFiles | null> {
  try {
    const place = await folder(false), index = JSON.parse(new TextDecoder().decode(await read(place, kIndex))) as Index;
    const others = await Promise.all(index.others.map(async (path, i) => [path, await read(place, String(i + 1))] as const));
    return { name: index.name, bytes: await read(place, "0"), others: new Map(others) };
  } catch {
    return null;
  }
}

export async function forgetModel(): Promise<void> {
  try {
    await (await navigator.storage.getDirectory()).removeEntry(kFolder, { recursive: true });
  } catch {
    // No model is stored.
  }
}
