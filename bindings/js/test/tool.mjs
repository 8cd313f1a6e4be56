// SPDX-License-Identifier: MIT
// Models of ../shared, and the tool's reports on them.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync, statSync } from "node:fs";
import { dirname, join } from "node:path";
import { expectDocument } from "./schema.mjs";

export const shared = process.env.TSPACE_SHARED;
export const tool = process.env.TSPACE_TOOL;
export const hasModels = Boolean(shared) && existsSync(join(shared, "models"));
/** Reason to skip tests that compare with the tool, or false. */
export const skip = (!hasModels && "no ../shared here") || (!tool && "no tool here: build the preset release");

export function filesIn(folder, wanted) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? filesIn(join(folder, entry.name), wanted) : wanted.test(entry.name) ? [join(folder, entry.name)] : []).sort();
}
/** Returns the files in a model's folder. */
export const besideOf = (path) => (name) => {
  const file = join(dirname(path), name);
  return existsSync(file) && statSync(file).isFile() ? readFileSync(file) : undefined;
};
/** The options meshopt and draco with the npm packages; null if these are not installed. */
export async function npmCodecs() {
  const [meshoptimizer, draco3d] = await Promise.all(["meshoptimizer", "draco3d"].map((name) => import(name).catch(() => null)));
  if (!meshoptimizer || !draco3d) return null;
  const { MeshoptDecoder: decoder, MeshoptEncoder: encoder } = meshoptimizer;
  await Promise.all([decoder.ready, encoder.ready]);
  const { default: draco } = draco3d;
  return {
    meshopt: { decoder, encoder },
    draco: { decoder: await draco.createDecoderModule({}), encoder: await draco.createEncoderModule({}) },
  };
}
/** Returns the JSON that the tool prints, for any exit code. */
export function ofTool(...args) {
  let text;
  try {
    text = execFileSync(tool, [...args, "--json"], { maxBuffer: 1 << 28, stdio: "pipe" });
  } catch (error) {
    text = error.stdout;
  }
  const document = JSON.parse(text);
  expectDocument(document);
  return document;
}
/** Removes run times, and paths, which models in memory do not have. */
export function plain(report) {
  const { seconds, output, outputFiles, inputFiles, exitCode, input, ...rest } = report;
  return rest;
}
