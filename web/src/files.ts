// SPDX-License-Identifier: MIT
// Files that the user dropped or chose: determines the model, and the files that it references.
import { unzipSync } from "fflate";
import { isMapName } from "./model/lone_map.js";
import type { CheckReport } from "tspace/gltf";

export interface ModelFiles {
  /** What reports call it. */
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
  /** Files that the model may name, by their path below the model's folder. */
  others: Map<string, Uint8Array<ArrayBuffer>>;
  /** A normal map that came without a model, and what `check` says of it; `bytes` is then a surface that shows it. */
  loneMap?: { file: Uint8Array<ArrayBuffer>; check: CheckReport };
}

/** A sentence for the person. */
export class Refusal extends Error {}

export const kMostBytes = 1 << 30;
export const kMostFiles = 2000;
const kModel = /\.(glb|vrm|gltf|obj)$/i;

/** What can be read of a file: one of the disk, or one out of an archive. */
interface Readable {
  size: number;
  arrayBuffer(): Promise<ArrayBuffer>;
}

export interface Named {
  path: string;
  file: Readable;
}

/** What a folder holds, by one of the two interfaces that browsers have for it. */
type Folder = { path: string; handle: FileSystemDirectoryHandle } | { path: string; entry: FileSystemDirectoryEntry };

/** A page opened from disk may read folders in Chromium by handles, and by entries in all others. */
async function contentsOf(folder: Folder): Promise<(Named | Folder)[]> {
  const found: (Named | Folder)[] = [];
  if ("handle" in folder) {
    for await (const handle of (folder.handle as unknown as { values(): AsyncIterable<FileSystemFileHandle | FileSystemDirectoryHandle> }).values()) {
      const path = `${folder.path}/${handle.name}`;
      found.push(handle.kind === "directory" ? { path, handle } : { path, file: await handle.getFile() });
    }
    return found;
  }
  const reader = folder.entry.createReader();
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((done, failed) => reader.readEntries(done, failed));
    if (some.length === 0) return found;
    for (const entry of some) {
      const path = `${folder.path}/${entry.name}`;
      if (entry.isDirectory) found.push({ path, entry: entry as FileSystemDirectoryEntry });
      else found.push({ path, file: await new Promise<File>((done, failed) => (entry as FileSystemFileEntry).file(done, failed)) });
    }
  }
}

/** Items of a drop can be asked for only during its event, so this happens before the first await. */
function droppedItems(data: DataTransfer): Promise<Named | Folder | null>[] {
  type Handles = { getAsFileSystemHandle?: () => Promise<FileSystemHandle | null> };
  return [...data.items].map(async (item) => {
    const entry = item.webkitGetAsEntry?.(), file = item.getAsFile();
    if (!entry?.isDirectory) return file && { path: file.name, file };
    const handle = await (item as Handles).getAsFileSystemHandle?.().catch(() => null);
    if (handle?.kind === "directory") return { path: handle.name, handle: handle as FileSystemDirectoryHandle };
    return { path: entry.name, entry: entry as FileSystemDirectoryEntry };
  });
}

/** Files of a drop, those in folders too. */
export async function droppedFiles(data: DataTransfer): Promise<Named[]> {
  const found: Named[] = [];
  const waiting = await Promise.all(droppedItems(data));
  while (waiting.length > 0) {
    const one = waiting.shift();
    if (!one) continue;
    if ("file" in one) found.push(one);
    else waiting.push(...(await contentsOf(one)));
    if (found.length > kMostFiles) throw new Refusal(`These are more than ${kMostFiles} files. Drop the folder of one model.`);
  }
  return found;
}

export const pickedFiles = (files: FileList): Named[] => [...files].map((file) => ({ path: file.webkitRelativePath || file.name, file }));

/** What an archive holds, below a folder of its name. Sizes are held against the limits before anything is unpacked. */
async function unpacked({ path, file }: Named): Promise<Named[]> {
  const packed = new Uint8Array(await file.arrayBuffer());
  let files = 0, bytes = 0, entries: Record<string, Uint8Array>;
  try {
    entries = unzipSync(packed, {
      filter: ({ name, originalSize }) => {
        files += 1;
        bytes += originalSize;
        return !name.endsWith("/") && files <= kMostFiles && bytes <= kMostBytes;
      },
    });
  } catch (error) {
    throw new Refusal(`${path} is no zip file that can be read: ${(error as Error).message}.`);
  }
  if (files > kMostFiles || bytes > kMostBytes) throw new Refusal(`${path} holds more than ${kMostFiles} files, or more than 1 GB.`);
  const folder = path.replace(/\.zip$/i, "");
  return Object.entries(entries).map(([name, content]) => ({
    path: `${folder}/${name}`,
    file: { size: content.length, arrayBuffer: async () => content.slice().buffer as ArrayBuffer },
  }));
}

/** The files that are there: those of a later drop without a model belong to the model of an earlier one. */
export class Pile {
  #files: Named[] = [];

  get isEmpty(): boolean {
    return this.#files.length === 0;
  }

  async add(dropped: Named[]): Promise<Named[]> {
    const found = (await Promise.all(dropped.map((one) => (/\.zip$/i.test(one.path) ? unpacked(one) : [one])))).flat();
    const isMore = modelsIn(found).length === 0 && modelsIn(this.#files).some((path) => /\.(gltf|obj)$/i.test(path)) && found.some(({ path }) => /\.(bin|mtl|png|jpe?g|webp|ktx2)$/i.test(path));
    const names = new Set(found.map(({ path }) => path));
    this.#files = isMore ? [...this.#files.filter(({ path }) => !names.has(path)), ...found] : found;
    return this.#files;
  }
}

/** Models among files, those nearest to the top first. */
export function modelsIn(named: Named[]): string[] {
  const depth = (path: string) => path.split("/").length;
  return named.map(({ path }) => path).filter((path) => kModel.test(path)).sort((a, b) => depth(a) - depth(b) || a.localeCompare(b, "en"));
}

/** Files that a .gltf names, as it writes them. */
export function fileUris(bytes: Uint8Array): string[] {
  try {
    const { buffers = [], images = [] } = JSON.parse(new TextDecoder().decode(bytes)) as { buffers?: { uri?: unknown }[]; images?: { uri?: unknown }[] };
    const uris = [...buffers, ...images].map(({ uri }) => uri).filter((uri): uri is string => typeof uri === "string" && !/^[a-z][a-z0-9+.-]*:/i.test(uri));
    for (const uri of uris) decodeURIComponent(uri);
    return [...new Set(uris)];
  } catch {
    return []; // the readers report the fault
  }
}

/** Files that a .gltf names and that did not come with it. */
export function missingFiles({ name, bytes, others }: ModelFiles): string[] {
  if (!/\.gltf$/i.test(name)) return [];
  return [...new Set(fileUris(bytes).map((uri) => decodeURIComponent(uri).replace(/^\.\//, "")))].filter((path) => !others.has(path));
}

/** One of the models among the files, the first where none is named, with all files that it may name. */
export async function chooseModel(named: Named[], chosen?: string): Promise<ModelFiles> {
  if (named.length > kMostFiles) throw new Refusal(`These are more than ${kMostFiles} files. Choose the folder of one model.`);
  const path = chosen ?? modelsIn(named)[0] ?? named.map(({ path }) => path).find(isMapName), models = named.filter((one) => one.path === path);
  if (models.length === 0) {
    throw new Refusal(named.length === 1 ? `${named[0].path} is no file that this page reads: it reads models (.glb, .vrm, .gltf, .obj) and normal maps (PNG, JPEG, WebP, KTX2, DDS).` : "There is no .glb, .vrm, .gltf or .obj and no image among these files.");
  }
  const total = named.reduce((sum, { file }) => sum + file.size, 0);
  if (models[0].file.size > kMostBytes || total > 2 * kMostBytes) throw new Refusal(`${models[0].path} is too large for this page, which reads models of up to 1 GB. The tool has no such limit.`);
  const folder = models[0].path.slice(0, models[0].path.lastIndexOf("/") + 1);
  const others = new Map<string, Uint8Array<ArrayBuffer>>();
  const read = async (file: Readable) => new Uint8Array(await file.arrayBuffer());
  const isGlb = /\.(glb|vrm)$/i.test(path);
  for (const { path, file } of named) {
    if (path !== models[0].path && path.startsWith(folder) && !(isGlb && kModel.test(path))) others.set(path.slice(folder.length), await read(file));
  }
  const model = { name: path.slice(folder.length), bytes: await read(models[0].file), others };
  // A file at a different location than the model states is matched by its name, if only one file has it.
  for (const wanted of missingFiles(model)) {
    const own = named.filter(({ path }) => path.split("/").pop() === wanted.split("/").pop());
    if (own.length === 1) others.set(wanted, await read(own[0].file));
  }
  return model;
}
