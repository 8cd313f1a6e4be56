// SPDX-License-Identifier: MIT
// Reports on model files, by the package's entry for glTF.
import { check, generate, identify, inspect, ready } from "tspace/gltf";
import type { ModelFiles } from "../files.js";
import type { Verb } from "./protocol.js";

const calls = { check, identify, inspect };
/** The package has no decoders for images, so checks are those of `tspace check --no-images`. */
const kVerbOptions = { check: { noImages: true }, identify: {}, inspect: {} };

const withFiles = ({ name, others }: ModelFiles) => ({ name, resources: others, memoryLimit: "2G" });

export async function reportOn(verb: Verb, model: ModelFiles): Promise<unknown> {
  await ready;
  return calls[verb](model.bytes, { ...withFiles(model), ...kVerbOptions[verb] });
}

export async function generateModel(model: ModelFiles, options: Record<string, unknown>): Promise<{ report: unknown; bytes: Uint8Array<ArrayBuffer> }> {
  await ready;
  const { bytes, report } = generate(model.bytes, { ...withFiles(model), ...options });
  return { bytes: bytes as Uint8Array<ArrayBuffer>, report };
}
