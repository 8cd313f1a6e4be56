// SPDX-License-Identifier: MIT
// Files that a person dropped or chose: which of them is the model, and how it finds the others.

export interface ModelFiles {
  /** What reports call it. */
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
  /** Files that the model may name, by their path below the model's folder. */
  others: Map<string, Uint8Array<ArrayBuffer>>;
}

/** A sentence for the person. */
export class Refusal extends Error {}

const kMostBytes = 1 << 30;
const kMostFiles = 2000;
const kModel = /\.(glb|vrm|gltf|obj)$/i;

interface Named {
  path: string;
  file: File;
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

/** The model among the files: the one nearest to the top, by name where several are. */
export async function chooseModel(named: Named[]): Promise<ModelFiles> {
  if (named.length > kMostFiles) throw new Refusal(`These are more than ${kMostFiles} files. Choose the folder of one model.`);
  const depth = (path: string) => path.split("/").length;
  const models = named.filter(({ path }) => kModel.test(path)).sort((a, b) => depth(a.path) - depth(b.path) || a.path.localeCompare(b.path, "en"));
  if (models.length === 0) {
    throw new Refusal(named.length === 1 ? `${named[0].path} is no model that this page reads: it reads .glb, .vrm, .gltf and .obj.` : "There is no .glb, .vrm, .gltf or .obj among these files.");
  }
  const total = named.reduce((sum, { file }) => sum + file.size, 0);
  if (models[0].file.size > kMostBytes || total > 2 * kMostBytes) throw new Refusal(`${models[0].path} is too large for this page, which reads models of up to 1 GB. The tool has no such limit.`);
  const folder = models[0].path.slice(0, models[0].path.lastIndexOf("/") + 1);
  const others = new Map<string, Uint8Array<ArrayBuffer>>();
  const read = async (file: File) => new Uint8Array(await file.arrayBuffer());
  const isGlb = /\.(glb|vrm)$/i.test(models[0].path);
  for (const { path, file } of named) {
    if (path !== models[0].path && path.startsWith(folder) && !(isGlb && kModel.test(path))) others.set(path.slice(folder.length), await read(file));
  }
  return { name: models[0].path.slice(folder.length), bytes: await read(models[0].file), others };
}
