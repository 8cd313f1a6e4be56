// SPDX-License-Identifier: MIT
// Reports on model files, by the package's entry for glTF.
import { check, decodeImages, generate, identify, inspect, ready } from "tspace/gltf";
import type { ModelFiles } from "../files.js";
import { codecsFor } from "./codecs.js";
import { decodeImage, withEncoder } from "./images.js";
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

/** Green may explain signs, so a repair looks at images too. */
export async function generateModel(model: ModelFiles, options: Record<string, unknown>): Promise<{ report: unknown; bytes: Uint8Array<ArrayBuffer> }> {
  const given = await withImages(model);
  const { bytes, report } = await withEncoder((encodeImage) => generate(model.bytes, { ...given, ...options, encodeImage }));
  return { bytes: bytes as Uint8Array<ArrayBuffer>, report };
}
