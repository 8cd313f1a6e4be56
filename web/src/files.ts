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
const kModel = /\.(glb|gltf|obj)$/i;

interface Named {
  path: string;
  file: File;
}

/** Files of a drop, those in folders too. */
export async function droppedFiles(data: DataTransfer): Promise<Named[]> {
  const entries = [...data.items].map((item) => item.webkitGetAsEntry?.()).filter((entry) => entry !== null && entry !== undefined);
  if (entries.length === 0) return [...data.files].map((file) => ({ path: file.name, file }));
  const found: Named[] = [];
  const waiting = [...entries];
  while (waiting.length > 0) {
    const entry = waiting.shift()!;
    if (entry.isFile) {
      const file = await new Promise<File>((done, failed) => (entry as FileSystemFileEntry).file(done, failed));
      found.push({ path: entry.fullPath.replace(/^\//, ""), file });
      if (found.length > kMostFiles) throw new Refusal(`These are more than ${kMostFiles} files. Drop the folder of one model.`);
    } else {
      const reader = (entry as FileSystemDirectoryEntry).createReader();
      for (;;) {
        const some = await new Promise<FileSystemEntry[]>((done, failed) => reader.readEntries(done, failed));
        if (some.length === 0) break;
        waiting.push(...some);
      }
    }
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
    throw new Refusal(named.length === 1 ? `${named[0].path} is no model that this page reads: it reads .glb, .gltf and .obj.` : "There is no .glb, .gltf or .obj among these files.");
  }
  const total = named.reduce((sum, { file }) => sum + file.size, 0);
  if (models[0].file.size > kMostBytes || total > 2 * kMostBytes) throw new Refusal(`${models[0].path} is too large for this page, which reads models of up to 1 GB. The tool has no such limit.`);
  const folder = models[0].path.slice(0, models[0].path.lastIndexOf("/") + 1);
  const others = new Map<string, Uint8Array<ArrayBuffer>>();
  const read = async (file: File) => new Uint8Array(await file.arrayBuffer());
  const isGlb = /\.glb$/i.test(models[0].path);
  for (const { path, file } of named) {
    if (path !== models[0].path && path.startsWith(folder) && !(isGlb && kModel.test(path))) others.set(path.slice(folder.length), await read(file));
  }
  return { name: models[0].path.slice(folder.length), bytes: await read(models[0].file), others };
}
