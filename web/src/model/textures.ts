// SPDX-License-Identifier: MIT
// Images of a file: identifies normal maps, and replaces images that the picture cannot show.
import type { GLTF, GLTFLoader, GLTFParser } from "three/examples/jsm/loaders/GLTFLoader.js";
import { plural } from "../dom.js";
import type { Work } from "../worker/client.js";

interface TextureJson {
  source?: number;
  extensions?: Record<string, { source?: number } | undefined>;
}
interface ImageJson {
  mimeType?: string;
  uri?: string;
}
interface MaterialJson {
  name?: string;
  normalTexture?: { index: number };
  pbrMetallicRoughness?: { baseColorTexture?: { index: number } };
}

const kBasis = "KHR_texture_basisu", kDds = "MSFT_texture_dds";
/** Extensions whose images renderers prefer to `source`, in this order. */
const kSources = [kBasis, "EXT_texture_avif", "EXT_texture_webp"];

function imageOf(texture: TextureJson | undefined): number {
  for (const name of kSources) {
    const source = texture?.extensions?.[name]?.source;
    if (source !== undefined) return source;
  }
  return texture?.source ?? texture?.extensions?.[kDds]?.source ?? -1;
}

const isTextureFile = (image: ImageJson | undefined): boolean => /^image\/(ktx2|vnd-ms\.dds)$/.test(image?.mimeType ?? "") || /^data:image\/(ktx2|vnd-ms\.dds)|\.(ktx2|dds)$/i.test(image?.uri ?? "");

/** Returns the index of the normal map's image for each material, or -1. */
export function normalImagesOf(gltf: GLTF): number[] {
  const { materials = [], textures = [] } = gltf.parser.json as { materials?: MaterialJson[]; textures?: TextureJson[] };
  return materials.map(({ normalTexture }) => (normalTexture ? imageOf(textures[normalTexture.index]) : -1));
}

/** The interface by which the loader loads images by URL. */
interface ImageLoader {
  isImageBitmapLoader: true;
  load(url: string, done: (image: ImageBitmap) => void, progress: unknown, failed: (error: unknown) => void): void;
}

/**
 * Makes the worker decode three kinds of textures, because the glTF loader of three.js would reject the whole model:
 * KTX2 textures; textures whose only image is a DDS; and textures whose `source` is a KTX2 or DDS without the
 * extension. The alternative to a KTX2 may be a placeholder of one texel, so it is drawn only if the KTX2 cannot be
 * decoded. Returns why images were not decoded, by image index.
 */
export function readTextureFiles(loader: GLTFLoader, work: Work): Map<number, string> {
  const why = new Map<number, string>();
  const pixels = async (url: string): Promise<ImageBitmap> => {
    const file = new Uint8Array(await (await fetch(loader.manager.resolveURL(url))).arrayBuffer());
    const { width, height, rgba } = await work.run("texture", { file });
    return createImageBitmap(new ImageData(rgba, width, height), { premultiplyAlpha: "none", colorSpaceConversion: "none" });
  };
  for (const name of [kBasis, kDds]) {
    loader.register((parser: GLTFParser) => ({
      name,
      loadTexture: (index: number) => {
        const texture = parser.json.textures[index] as TextureJson, extended = texture.extensions?.[name]?.source;
        const source = name === kBasis ? extended ?? texture.source : texture.source ?? extended;
        if (source === undefined || (source === texture.source && !isTextureFile(parser.json.images?.[source]))) return null;
        const own: ImageLoader = {
          isImageBitmapLoader: true,
          load: (url, done, _, failed) => void pixels(url).then(done).catch((error: Error) => (why.set(source, error.message), failed(error))),
        };
        const wanted = parser.loadTextureImage(index, source, own as unknown as Parameters<GLTFParser["loadTextureImage"]>[2]) as ReturnType<GLTFParser["loadTexture"]>;
        const beside = texture.source;
        if (beside === undefined || beside === source || isTextureFile(parser.json.images?.[beside])) return wanted;
        return wanted.then((found) => {
          if (found) return found;
          why.delete(source);
          return parser.loadTextureImage(index, beside, parser.textureLoader as unknown as Parameters<GLTFParser["loadTextureImage"]>[2]) as ReturnType<GLTFParser["loadTexture"]>;
        });
      },
    }));
  }
  return why;
}

/**
 * Returns a sentence about images that materials reference but the picture cannot show, or none. `why`: known reasons.
 */
export async function missingImages(gltf: GLTF, why: ReadonlyMap<number, string>): Promise<string[]> {
  const { materials = [], textures = [] } = gltf.parser.json as { materials?: MaterialJson[]; textures?: TextureJson[] };
  const lost = new Set<number>(why.keys());
  for (const { normalTexture, pbrMetallicRoughness } of materials) {
    for (const index of [normalTexture?.index, pbrMetallicRoughness?.baseColorTexture?.index]) {
      if (index === undefined) continue;
      const texture = await (gltf.parser.getDependency("texture", index) as Promise<{ image?: unknown } | null>).catch(() => null);
      if (!texture?.image) lost.add(imageOf(textures[index]));
    }
  }
  if (lost.size === 0) return [];
  const reasons = new Set([...lost].map((image) => why.get(image)).filter((reason) => reason !== undefined));
  return [`${plural(lost.size, "image")} cannot be displayed${reasons.size > 0 ? ` (${[...reasons].join("; ")})` : ""}, and the model is shown without ${lost.size === 1 ? "it" : "them"}.`];
}
