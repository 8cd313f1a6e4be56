// SPDX-License-Identifier: MIT
// Converts an OBJ to a GLB: corners as read by three.js, colors and maps of its MTL file.
import { Mesh, type BufferGeometry, type Material } from "three";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { Refusal, type ModelFiles } from "../files.js";
import { GlbBuilder } from "./glb.js";

interface ObjMaterial {
  color: [number, number, number];
  colorMap?: string;
  normalMap?: string;
}

const kMostBytes = 200 << 20;
const text = (bytes: Uint8Array): string => new TextDecoder().decode(bytes);

/** Returns the file name: the last word of a line of options. */
const fileOf = (words: string[]): string => words[words.length - 1].replace(/\\/g, "/").replace(/^\.\//, "");

function readMaterials(model: ModelFiles): Map<string, ObjMaterial> {
  const materials = new Map<string, ObjMaterial>();
  for (const [path, bytes] of model.others) {
    if (!/\.mtl$/i.test(path)) continue;
    let current: ObjMaterial | undefined;
    for (const line of text(bytes).split("\n")) {
      const [key, ...words] = line.trim().split(/\s+/);
      if (words.length === 0) continue;
      if (key === "newmtl") materials.set(words.join(" "), (current = { color: [0.8, 0.8, 0.8] }));
      else if (key === "Kd" && current) current.color = [0, 1, 2].map((i) => Math.min(1, Math.max(0, Number(words[i]) || 0))) as [number, number, number];
      else if (key === "map_Kd" && current) current.colorMap = fileOf(words);
      else if (key.toLowerCase() === "norm" && current) current.normalMap = fileOf(words);
    }
  }
  return materials;
}

class ObjWriter {
  #builder = new GlbBuilder();
  #images = new Map<string, number>();
  #imageList: object[] = [];
  #materials: object[] = [];
  #numbers = new Map<string, number>();

  constructor(private model: ModelFiles, private known: Map<string, ObjMaterial>) {}

  #texture(path: string | undefined): { index: number } | undefined {
    const bytes = path === undefined ? undefined : this.model.others.get(path);
    if (path === undefined || !bytes) return undefined;
    if (!this.#images.has(path)) {
      const mimeType = bytes[0] === 0xff ? "image/jpeg" : bytes[0] === 0x52 ? "image/webp" : "image/png";
      this.#images.set(path, this.#imageList.push({ name: path, mimeType, bufferView: this.#builder.addView(bytes) }) - 1);
    }
    return { index: this.#images.get(path)! };
  }

  #material(name: string): number {
    if (!this.#numbers.has(name)) {
      const material = this.known.get(name);
      const baseColorTexture = this.#texture(material?.colorMap), normalTexture = this.#texture(material?.normalMap);
      const pbrMetallicRoughness = { baseColorFactor: [...(baseColorTexture ? [1, 1, 1] : (material?.color ?? [0.8, 0.8, 0.8])), 1], metallicFactor: 0, ...(baseColorTexture && { baseColorTexture }) };
      this.#numbers.set(name, this.#materials.push({ name, pbrMetallicRoughness, ...(normalTexture && { normalTexture }) }) - 1);
    }
    return this.#numbers.get(name)!;
  }

  primitive(geometry: BufferGeometry, start: number, count: number, material: string): object {
    const part = (name: string, size: number) => (geometry.getAttribute(name)?.array as Float32Array | undefined)?.slice(size * start, size * (start + count));
    const normals = part("normal", 3), uvs = part("uv", 2);
    // v = 0 is at the bottom in OBJ, and at the top in glTF.
    if (uvs) for (let i = 1; i < uvs.length; i += 2) uvs[i] = 1 - uvs[i];
    const attributes = {
      POSITION: this.#builder.addAccessor(part("position", 3)!, "VEC3"),
      ...(normals && { NORMAL: this.#builder.addAccessor(normals, "VEC3") }),
      ...(uvs && { TEXCOORD_0: this.#builder.addAccessor(uvs, "VEC2") }),
    };
    return { attributes, material: this.#material(material) };
  }

  finish(meshes: object[], translation: number[]): Uint8Array<ArrayBuffer> {
    const isMoved = translation.some((value) => value !== 0);
    const nodes = meshes.map((_, mesh) => ({ mesh, ...(isMoved && { translation }) }));
    const images = this.#imageList.length > 0 && { images: this.#imageList, textures: this.#imageList.map((_, source) => ({ source })) };
    return this.#builder.finish({ scene: 0, scenes: [{ nodes: nodes.map((_, i) => i) }], nodes, meshes, materials: this.#materials, ...images }, "tspace view");
  }
}

/**
 * Coordinates far from the origin (map coordinates in meters) exceed the precision of the floats of three.js. On each
 * axis on which the middle of the central 90 % is more than a hundred times as far away as the model is large, an
 * offset is subtracted, which becomes the translation of the nodes.
 */
function nearOrigin(source: string): { text: string; offset: number[] } {
  const line = /^([ \t]*v[ \t]+)(\S+)[ \t]+(\S+)[ \t]+(\S+)/gm;
  const axes = [[], [], []] as number[][];
  for (const match of source.matchAll(line)) axes.forEach((axis, k) => axis.push(Number(match[k + 2])));
  const sorted = axes.map((axis) => Float64Array.from(axis.filter(Number.isFinite)).sort());
  const at = (k: number, share: number) => sorted[k][Math.floor(share * (sorted[k].length - 1))] ?? 0;
  const size = Math.max(...[0, 1, 2].map((k) => at(k, 0.95) - at(k, 0.05)));
  const unit = size > 0 ? 10 ** Math.floor(Math.log10(size)) : 1;
  const offset = [0, 1, 2].map((k) => {
    const middle = (at(k, 0.05) + at(k, 0.95)) / 2;
    return Math.abs(middle) > 100 * size ? Math.round(middle / unit) * unit : 0;
  });
  if (offset.every((value) => value === 0)) return { text: source, offset };
  return { text: source.replace(line, (_, start: string, ...words: string[]) => start + [0, 1, 2].map((k) => Number(words[k]) - offset[k]).join(" ")), offset };
}

export function glbOfObj(model: ModelFiles): ModelFiles {
  if (model.bytes.length > kMostBytes) throw new Refusal(`${model.name} is too large for this page, which supports OBJ files of up to 200 MB.`);
  const near = nearOrigin(text(model.bytes));
  const root = new OBJLoader().parse(near.text);
  const writer = new ObjWriter(model, readMaterials(model));
  const meshes: object[] = [];
  root.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    const geometry = object.geometry as BufferGeometry, materials = [object.material].flat() as Material[];
    const count = geometry.getAttribute("position")?.count ?? 0;
    const groups = geometry.groups.length > 0 ? geometry.groups : [{ start: 0, count, materialIndex: 0 }];
    const primitives = groups.filter((group) => group.count >= 3).map((group) => writer.primitive(geometry, group.start, group.count, materials[group.materialIndex ?? 0]?.name ?? ""));
    if (primitives.length > 0) meshes.push({ name: object.name, primitives });
  });
  if (meshes.length === 0) throw new Refusal(`${model.name} has no faces.`);
  return { name: model.name.replace(/\.obj$/i, ".glb"), bytes: writer.finish(meshes, near.offset), others: new Map() };
}
