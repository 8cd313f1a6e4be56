// SPDX-License-Identifier: MIT
// Images of a file: which one a normal map is, and what happens to those that the picture cannot show.
import type { GLTF, GLTFLoader, GLTFParser } from "three/examples/jsm/loaders/GLTFLoader.js";
import { plural } from "../dom.js";

interface TextureJson {
  source?: number;
  extensions?: Record<string, { source?: number } | undefined>;
}
interface MaterialJson {
  name?: string;
  normalTexture?: { index: number };
  pbrMetallicRoughness?: { baseColorTexture?: { index: number } };
}

const kBasis = "KHR_texture_basisu";
/** The order in which renderers look for an image. */
const kSources = [kBasis, "EXT_texture_avif", "EXT_texture_webp"];

function imageOf(texture: TextureJson | undefined): number {
  for (const name of kSources) {
    const source = texture?.extensions?.[name]?.source;
    if (source !== undefined) return source;
  }
  return texture?.source ?? -1;
}

/** For each material the index of its normal map's image, or -1. */
export function normalImagesOf(gltf: GLTF): number[] {
  const { materials = [], textures = [] } = gltf.parser.json as { materials?: MaterialJson[]; textures?: TextureJson[] };
  return materials.map(({ normalTexture }) => (normalTexture ? imageOf(textures[normalTexture.index]) : -1));
}

/** A texture in KTX2 that has no other image is left out: without this the loader would refuse the whole model. */
export function leaveOutBasis(loader: GLTFLoader): void {
  loader.register((parser: GLTFParser) => ({
    name: kBasis,
    loadTexture: (index: number) => {
      const texture = parser.json.textures[index] as TextureJson;
      return texture.extensions?.[kBasis] && texture.source === undefined ? (Promise.resolve(null) as unknown as ReturnType<GLTFParser["loadTexture"]>) : null;
    },
  }));
}

/** A sentence on the images that materials name and the picture cannot show, or none. */
export async function missingImages(gltf: GLTF): Promise<string[]> {
  const { materials = [], textures = [], images = [] } = gltf.parser.json as { materials?: MaterialJson[]; textures?: TextureJson[]; images?: { mimeType?: string; uri?: string }[] };
  const lost = new Set<number>();
  for (const { normalTexture, pbrMetallicRoughness } of materials) {
    for (const index of [normalTexture?.index, pbrMetallicRoughness?.baseColorTexture?.index]) {
      if (index === undefined) continue;
      const texture = await (gltf.parser.getDependency("texture", index) as Promise<{ image?: unknown } | null>).catch(() => null);
      if (!texture?.image) lost.add(imageOf(textures[index]));
    }
  }
  if (lost.size === 0) return [];
  const isKtx = [...lost].every((image) => images[image]?.mimeType === "image/ktx2" || /\.ktx2$/i.test(images[image]?.uri ?? ""));
  return [`${plural(lost.size, "image")} cannot be drawn here${isKtx ? ", being KTX2" : ""}, and the model is shown without ${lost.size === 1 ? "it" : "them"}.`];
}
