// SPDX-License-Identifier: MIT
// Decoders of meshopt and Draco, for models that require them, and for the picture.
import createDraco, { type DracoModule } from "three/examples/jsm/libs/draco/gltf/draco_wasm_wrapper.js";
import dracoWasm from "three/examples/jsm/libs/draco/gltf/draco_decoder.wasm?packed";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";
import type { Draco, Meshopt } from "tspace/gltf";
import type { ModelFiles } from "../files.js";
import { load } from "./load_packed.js";
import type { DracoAsk, DracoMesh, MeshoptAsk } from "./protocol.js";

let draco: Promise<DracoModule> | undefined;

const dracoModule = (): Promise<DracoModule> => (draco ??= load(dracoWasm).then((wasmBinary) => createDraco({ wasmBinary })));

/** Releases Draco's module: its memory never shrinks, and a module that has aborted remains unusable. */
export function forgetCodecs(): void {
  draco = undefined;
}

/** Returns the text of a model's JSON, or the start of a file that may contain it. */
function jsonOf({ bytes }: ModelFiles): string {
  const isGlb = bytes.length >= 20 && bytes[0] === 0x67 && bytes[1] === 0x6c;
  const length = isGlb ? new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true) : bytes.length;
  return new TextDecoder().decode(bytes.subarray(isGlb ? 20 : 0, (isGlb ? 20 : 0) + length));
}

/** Returns the codecs that the model's extensions require. */
export async function codecsFor(model: ModelFiles): Promise<{ meshopt?: Meshopt; draco?: Draco }> {
  const text = jsonOf(model), given: { meshopt?: Meshopt; draco?: Draco } = {};
  if (text.includes("_meshopt_compression")) {
    await MeshoptDecoder.ready;
    given.meshopt = { decoder: MeshoptDecoder as Meshopt["decoder"] };
  }
  if (text.includes("KHR_draco_mesh_compression")) given.draco = { decoder: await dracoModule() };
  return given;
}

export async function decodeMeshopt({ count, size, source, mode, filter }: MeshoptAsk): Promise<Uint8Array<ArrayBuffer>> {
  await MeshoptDecoder.ready;
  const target = new Uint8Array(count * size);
  MeshoptDecoder.decodeGltfBuffer(target, count, size, source, mode, filter);
  return target;
}

const kTypes = {
  Int8Array: [Int8Array, "DT_INT8"], Uint8Array: [Uint8Array, "DT_UINT8"], Int16Array: [Int16Array, "DT_INT16"],
  Uint16Array: [Uint16Array, "DT_UINT16"], Uint32Array: [Uint32Array, "DT_UINT32"], Float32Array: [Float32Array, "DT_FLOAT32"],
} as const;

/** Decodes a Draco mesh, with the attributes requested by ID. */
export async function decodeDraco({ data, attributes }: DracoAsk): Promise<DracoMesh> {
  const module = await dracoModule(), made: object[] = [];
  const own = <T extends object>(object: T): T => (made.push(object), object);
  const read = <T>(Type: { new (buffer: ArrayBuffer, at: number, count: number): T; BYTES_PER_ELEMENT: number }, count: number, write: (bytes: number, place: number) => void): T => {
    const bytes = count * Type.BYTES_PER_ELEMENT, place = module._malloc(bytes);
    if (place === 0) throw new Error("there is not enough memory for the Draco data");
    write(bytes, place);
    const values = new Type(module.HEAPF32.buffer.slice(place, place + bytes), 0, count);
    module._free(place);
    return values;
  };
  try {
    const buffer = own(new module.DecoderBuffer()), decoder = own(new module.Decoder()), mesh = own(new module.Mesh());
    buffer.Init(new Int8Array(data), data.byteLength);
    if (!own(decoder.DecodeBufferToMesh(buffer, mesh)).ok()) throw new Error("the Draco data is damaged");
    const indices = read(Uint32Array, 3 * mesh.num_faces(), (bytes, place) => decoder.GetTrianglesUInt32Array(mesh, bytes, place));
    const decoded = attributes.map(({ name, id, type }) => {
      const attribute = decoder.GetAttributeByUniqueId(mesh, id), [Type, kind] = kTypes[type as keyof typeof kTypes];
      if (attribute.ptr === 0) throw new Error(`the Draco data has no attribute ${id}`);
      const size = attribute.num_components();
      return { name, size, values: read<Float32Array>(Type as never, mesh.num_points() * size, (bytes, place) => decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, module[kind], bytes, place)) };
    });
    return { indices, attributes: decoded };
  } finally {
    for (const object of made.reverse()) module.destroy(object);
  }
}
