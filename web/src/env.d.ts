// SPDX-License-Identifier: MIT
/// <reference types="vite/client" />
declare module "*.wasm?packed" {
  const url: string;
  export default url;
}
/** The functions of Draco's decoder that are used. */
declare module "three/examples/jsm/libs/draco/gltf/draco_wasm_wrapper.js" {
  interface Decoder {
    DecodeBufferToMesh(buffer: object, mesh: object): { ok(): boolean };
    GetTrianglesUInt32Array(mesh: object, bytes: number, place: number): boolean;
    GetAttributeByUniqueId(mesh: object, id: number): { ptr: number; num_components(): number };
    GetAttributeDataArrayForAllPoints(mesh: object, attribute: object, type: number, bytes: number, place: number): boolean;
  }
  type Kinds = { [K in `DT_${"INT8" | "UINT8" | "INT16" | "UINT16" | "UINT32" | "FLOAT32"}`]: number };
  export interface DracoModule extends Kinds {
    HEAPF32: Float32Array<ArrayBuffer>;
    _malloc(bytes: number): number;
    _free(place: number): void;
    destroy(object: object): void;
    DecoderBuffer: new () => { Init(data: Int8Array, bytes: number): void };
    Decoder: new () => Decoder;
    Mesh: new () => { num_faces(): number; num_points(): number };
  }
  export default function createDraco(options: { wasmBinary: ArrayBuffer }): Promise<DracoModule>;
}
declare module "*.glb?inline" {
  const url: string;
  export default url;
}

/** Version of the library embedded in the page. */
declare const __VERSION__: string;
