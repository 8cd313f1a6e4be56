// SPDX-License-Identifier: MIT
// Files that the user dropped or chose: determines the model, and the files that it references.
import { unzipSync } from "fflate";
import type { CheckReport } from "tspace/gltf";

export interface ModelFiles {
  /** Name in reports. */
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
  /** Files that the model may reference, by path relative to the model's folder. */
  others: Map<string, Uint8Array<ArrayBuffer>>;
  /**
   * A normal map that was opened without a model, and its check report; `bytes` is then a surface that shows the map.
   */
  loneMap?: { file: Uint8Array<ArrayBuffer>; check: CheckReport };
}

/** An error with a message for the user. */
export class Refusal extends Error {}

export const kMostBytes = 1 << 30;
export const kMostFiles = 2000;
/** Media types of images, by ending; KTX2 and DDS are converted to PNG. */
const kMapTypes: Record<string, string> = { png: "image/png", jpg: "image/jpeg", jpeg: "image/jpeg", webp: "image/webp", ktx2: "image/png", dds: "image/png" };
const kModel = /\.(glb|vrm|gltf|obj)$/i;

/** A readable file, on disk or in an archive. */
interface Readable {
  size: number;
  arrayBuffer(): Promise<ArrayBuffer>;
}

export interface Named {
  path: string;
  file: Readable;
}

/** A folder, accessed by one of the two interfaces of browsers. */
type Folder = { path: string; handle: FileSystemDirectoryHandle } | { path: string; entry: FileSystemDirectoryEntry };

/**
 * Lists a folder. On a page opened from disk, Chromium can only read folders by handles, and other browsers only by
 * entries.
 */
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

/** Returns the items of a drop. They are only accessible during the event, so this runs before the first await. */
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

/** Returns the files of a drop, including files in folders. */
export async function droppedFiles(data: DataTransfer): Promise<Named[]> {
  const found: Named[] = [];
  const waiting = await Promise.all(droppedItems(data));
  while (waiting.length > 0) {
    const one = waiting.shift();
    if (!one) continue;
    if ("file" in one) found.push(one);
    else waiting.push(...(await contentsOf(one)));
    if (found.length > kMostFiles) throw new Refusal(`More than ${kMostFiles} files were dropped. Drop the folder of a single model.`);
  }
  return found;
}

export const pickedFiles = (files: File[]): Named[] => files.map((file) => ({ path: file.webkitRelativePath || file.name, file }));

/** Returns the files of an archive, in a folder with its name. Sizes are checked before anything is unpacked. */
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
    throw new Refusal(`${path} is not a readable zip file: ${(error as Error).message}.`);
  }
  if (files > kMostFiles || bytes > kMostBytes) throw new Refusal(`${path} contains more than ${kMostFiles} files or more than 1 GB.`);
  const folder = path.replace(/\.zip$/i, "");
  return Object.entries(entries).map(([name, content]) => ({
    path: `${folder}/${name}`,
    file: { size: content.length, arrayBuffer: async () => content.slice().buffer as ArrayBuffer },
  }));
}

/** All opened files. Files of a later drop without a model are added to those of the current model. */
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

/** Returns the models among the files, those closest to the top folder first. */
export function modelsIn(named: Named[]): string[] {
  const depth = (path: string) => path.split("/").length;
  return named.map(({ path }) => path).filter((path) => kModel.test(path)).sort((a, b) => depth(a) - depth(b) || a.localeCompare(b, "en"));
}

/** Returns the URIs of files that a .gltf references, unchanged. */
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

/** Returns the files that a .gltf references and that are missing. */
export function missingFiles({ name, bytes, others }: ModelFiles): string[] {
  if (!/\.gltf$/i.test(name)) return [];
  return [...new Set(fileUris(bytes).map((uri) => decodeURIComponent(uri).replace(/^\.\//, "")))].filter((path) => !others.has(path));
}

/** Returns the chosen model, or the first one, with all files that it may reference. */
export async function chooseModel(named: Named[], chosen?: string): Promise<ModelFiles> {
  if (named.length > kMostFiles) throw new Refusal(`The folder contains more than ${kMostFiles} files. Choose the folder of a single model.`);
  const path = chosen ?? modelsIn(named)[0] ?? named.map(({ path }) => path).find(isMapName), models = named.filter((one) => one.path === path);
  if (models.length === 0) {
    throw new Refusal(named.length === 1 ? `${named[0].path} has a format that this page does not support. It supports models (.glb, .vrm, .gltf, .obj) and normal maps (PNG, JPEG, WebP, KTX2, DDS).` : "None of these files is a model (.glb, .vrm, .gltf, .obj) or an image.");
  }
  const total = named.reduce((sum, { file }) => sum + file.size, 0);
  if (models[0].file.size > kMostBytes || total > 2 * kMostBytes) throw new Refusal(`${models[0].path} is too large for this page, which supports models of up to 1 GB. The command-line tool has no such limit.`);
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

const ending = (name: string): string => name.slice(name.lastIndexOf(".") + 1).toLowerCase();
export const isMapName = (name: string): boolean => ending(name) in kMapTypes;
/** Media type of a map as the page shows it. */
export const mapType = (name: string): string => kMapTypes[ending(name)];

/** Returns the name of the fixed map: `bricks.dds` becomes `bricks-fixed.png`. */
export const fixedMapName = (name: string): string => name.replace(/^.*\//, "").replace(/\.[^.]*$/, `-fixed.${kMapTypes[ending(name)] === "image/png" ? "png" : ending(name)}`);
