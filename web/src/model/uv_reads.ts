// SPDX-License-Identifier: MIT
// The UV maps of a part: each UV set of the file after the transforms of its textures.
import { Matrix3, type Texture } from "three";
import { uvName, uvsThrough } from "./arrays.js";
import type { Part } from "./part.js";

export interface UvRead {
  label: string;
  /** Two numbers per vertex. */
  uvs: Float32Array<ArrayBuffer>;
  /** True if these UVs are those of `arrays.uvs`, which tangents follow. */
  isLeading: boolean;
  /** Images that use these UVs, the normal map first. */
  images: { name: string; image: CanvasImageSource & { width: number; height: number } }[];
}

const names: Record<string, string> = { normalMap: "normal map", map: "base color", metalnessMap: "metallic and roughness", roughnessMap: "metallic and roughness", aoMap: "occlusion", emissiveMap: "emission" };
/** Returns the display name of a material property of three.js. */
export const nameOfMap = (property: string): string => names[property] ?? property.replace(/Map$/, "");
const kMostSets = 4;

/** Textures that use the same UV set with the same transform. */
interface Read {
  channel: number;
  matrix: Matrix3 | null;
  images: UvRead["images"];
  names: string[];
}

function textureReads(part: Part): Map<string, Read> {
  const reads = new Map<string, Read>();
  const textures = Object.entries(part.surface).filter((entry): entry is [string, Texture] => Boolean((entry[1] as Texture | null)?.isTexture) && entry[0] !== "envMap");
  const rank = (property: string) => (property === "normalMap" ? 0 : property === "map" ? 1 : 2);
  textures.sort(([a], [b]) => rank(a) - rank(b) || a.localeCompare(b, "en"));
  for (const [property, texture] of textures) {
    const name = nameOfMap(property), matrix = texture.matrix.equals(new Matrix3()) ? null : texture.matrix;
    const key = keyOf(texture.channel, matrix);
    const read = reads.get(key) ?? { channel: texture.channel, matrix, images: [], names: [] };
    const image = texture.image as UvRead["images"][number]["image"] | null;
    if (image?.width && !read.images.some((known) => known.image === image)) read.images.push({ name, image });
    if (!read.names.includes(name)) read.names.push(name);
    reads.set(key, read);
  }
  return reads;
}

const keyOf = (channel: number, matrix: Matrix3 | null): string => `${channel} ${matrix?.elements.join() ?? ""}`;

/**
 * Returns all UV maps of a part, that of the normal map first. Sets that no texture uses are included untransformed.
 */
export function uvReadsOf(part: Part): UvRead[] {
  const reads = textureReads(part);
  for (let channel = 0; channel < kMostSets; ++channel) {
    if (part.attributes[uvName(channel)] && ![...reads.values()].some((read) => read.channel === channel)) reads.set(keyOf(channel, null), { channel, matrix: null, images: [], names: [] });
  }
  const { normalMap, map } = part.surface as { normalMap?: Texture | null; map?: Texture | null }, leading = normalMap ?? map;
  const leadingKey = keyOf(leading?.channel ?? 0, !leading || leading.matrix.equals(new Matrix3()) ? null : leading.matrix);
  const found: UvRead[] = [];
  for (const { channel, matrix, images, names } of reads.values()) {
    const attribute = part.attributes[uvName(channel)];
    if (!attribute) continue;
    const isLeading = part.arrays.uvs !== null && keyOf(channel, matrix) === leadingKey;
    const readBy = names.length > 0 ? `, used by ${names.slice(0, 3).join(", ")}${names.length > 3 ? " and others" : ""}` : ", used by no texture";
    found.push({ label: `TEXCOORD_${channel}${matrix ? " transformed" : ""}${readBy}`, uvs: isLeading ? part.arrays.uvs! : uvsThrough(attribute, matrix), isLeading, images });
  }
  return found;
}
