// SPDX-License-Identifier: MIT
// Passes compressed geometry to the loader of three.js: the worker decodes it.
import { BufferAttribute, BufferGeometry } from "three";
import type { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import type { Work } from "../worker/client.js";

/** Decodes a Draco mesh in the worker. `ids` and `types`: IDs and types of the attributes, keyed by their names. */
async function decodedDraco(work: Work, data: ArrayBuffer, ids: Record<string, number>, types: Record<string, string>): Promise<BufferGeometry> {
  const wanted = Object.entries(ids).map(([name, id]) => ({ name, id, type: types[name] }));
  const { indices, attributes } = await work.run("draco", { data, attributes: wanted });
  const geometry = new BufferGeometry().setIndex(new BufferAttribute(indices, 1));
  for (const { name, size, values } of attributes) geometry.setAttribute(name, new BufferAttribute(values, size));
  return geometry;
}

/** The loader expects decoder objects, and calls these functions of them. */
export function giveDecoders(loader: GLTFLoader, work: Work): void {
  const meshopt = {
    supported: true,
    ready: Promise.resolve(),
    decodeGltfBufferAsync: (count: number, size: number, source: Uint8Array<ArrayBuffer>, mode: string, filter?: string) => work.run("meshopt", { count, size, source, mode, filter }),
  };
  const draco = {
    preload() {},
    decodeDracoFile: (data: ArrayBuffer, done: (geometry: BufferGeometry) => void, ids: Record<string, number>, types: Record<string, string>, _space: string, failed: (error: unknown) => void) =>
      decodedDraco(work, data, ids, types).then(done).catch(failed),
  };
  loader.setMeshoptDecoder(meshopt as unknown as Parameters<GLTFLoader["setMeshoptDecoder"]>[0]);
  loader.setDRACOLoader(draco as unknown as Parameters<GLTFLoader["setDRACOLoader"]>[0]);
}
