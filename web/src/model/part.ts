// SPDX-License-Identifier: MIT
// A primitive of a model, as the page shows it.
import type { Matrix4, Texture, Vector3 } from "three";
import type { Arrays } from "../worker/protocol.js";

export interface Part {
  mesh: number;
  primitive: number;
  name: string;
  materialName: string;
  arrays: Arrays;
  /** Set and transform of the normal map, already in `arrays.uvs`. */
  normalMap: Texture | null;
  normalScale: number;
  color: Vector3;
  colorMap: Texture | null;
  /** Two numbers per vertex, where the colour has other UVs than the normal map. */
  colorUvs: Float32Array<ArrayBuffer> | null;
  alphaTest: number;
  isDoubleSided: boolean;
  /** Where it is drawn. */
  places: Matrix4[];
}

export interface Model {
  parts: Part[];
  /** Sentences about what the picture leaves out. */
  remarks: string[];
}

export const triangleCount = (arrays: Arrays): number => Math.floor((arrays.indices?.length ?? arrays.positions.length / 3) / 3);
