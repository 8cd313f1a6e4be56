// SPDX-License-Identifier: MIT
// Reports on model files, computed by the package's entry for glTF.
import { check, decodeImages, generate, identify, inspect, ready } from "tspace/gltf";
import { mapType, type ModelFiles } from "../files.js";
import { codecsFor } from "./codecs.js";
import { decodeImage, pngOf, withEncoder } from "./images.js";
import { decodeTexture } from "./texture_files.js";
import type { Verb } from "./protocol.js";

const calls = { check, identify, inspect };

async function optionsFor(model: ModelFiles) {
  await ready;
  return { name: model.name, resources: model.others, memoryLimit: "2G", ...(await codecsFor(model)) };
}

async function withImages(model: ModelFiles) {
  const options = await optionsFor(model);
  return { ...options, decodeImage: await decodeImages(model.bytes, decodeImage, options) };
}

export async function reportOn(verb: Verb, model: ModelFiles): Promise<unknown> {
  return calls[verb](model.bytes, await (verb === "check" ? withImages(model) : optionsFor(model)));
}

/** Checks a lone normal map; KTX2 and DDS are decoded to a PNG of their first level. */
export async function judgeImage({ name, bytes }: ModelFiles): Promise<{ report: unknown; image: Uint8Array<ArrayBuffer> }> {
  await ready;
  const texels = /\.(ktx2|dds)$/i.test(name) ? await decodeTexture(bytes) : null;
  const image = texels ? (pngOf({ width: texels.width, height: texels.height, channels: 4, bits: 8, data: new Uint8Array(texels.rgba) }) as Uint8Array<ArrayBuffer>) : bytes;
  const pixels = await decodeImage(image, mapType(name) as Parameters<typeof decodeImage>[1]);
  return { report: check(image, { name, memoryLimit: "2G", decodeImage: () => pixels }), image };
}

/** Runs generate. Provides the model's images too, because an inverted green channel may explain inverted signs. */
export async function generateModel(model: ModelFiles, options: Record<string, unknown>): Promise<{ report: unknown; bytes: Uint8Array<ArrayBuffer> }> {
  const given = await withImages(model);
  const { bytes, report } = await withEncoder((encodeImage) => generate(model.bytes, { ...given, ...options, encodeImage }));
  return { bytes: bytes as Uint8Array<ArrayBuffer>, report };
}
