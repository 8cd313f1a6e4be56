// SPDX-License-Identifier: MIT
// How the loader of three.js gets compressed geometry: the worker decodes it.
import { BufferAttribute, BufferGeometry } from "three";
import type { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import type { Work } from "../worker/client.js";

type DracoLoader = Parameters<GLTFLoader["setDRACOLoader"]>[0];

function geometryOf({ indices, attributes }: Awaited<ReturnType<typeof decode>>): BufferGeometry {
  const geometry = new BufferGeometry().setIndex(new BufferAttribute(indices, 1));
  for (const { name, size, values } of attributes) geometry.setAttribute(name, new BufferAttribute(values, size));
  return geometry;
}

const decode = (work: Work, data: ArrayBuffer, ids: Record<string, number>, types: Record<string, string>) =>
  work.run("draco", { data, attributes: Object.entries(ids).map(([name, id]) => ({ name, id, type: types[name] })) });

export function giveDecoders(loader: GLTFLoader, work: Work): void {
  loader.setMeshoptDecoder({
    supported: true,
    ready: Promise.resolve(),
    decodeGltfBufferAsync: (count: number, size: number, source: Uint8Array<ArrayBuffer>, mode: string, filter?: string) => work.run("meshopt", { count, size, source, mode, filter }),
  } as never);
  loader.setDRACOLoader({
    preload() {},
    decodeDracoFile: (data: ArrayBuffer, done: (geometry: BufferGeometry) => void, ids: Record<string, number>, types: Record<string, string>, _space: string, failed: (error: unknown) => void) =>
      decode(work, data, ids, types).then(geometryOf).then(done).catch(failed),
  } as unknown as DracoLoader);
}
