// SPDX-License-Identifier: MIT
// A primitive of a model in the page's representation.
import type { BufferAttribute, InterleavedBufferAttribute, Material, Matrix4, Texture, Vector3 } from "three";
import type { Pose } from "./pose.js";
import type { Arrays } from "../worker/protocol.js";

export interface Part {
  mesh: number;
  primitive: number;
  name: string;
  materialName: string;
  /** Index of the material in the file, or -1. */
  material: number;
  arrays: Arrays;
  /** The normal map, whose UV set and transform are already applied in `arrays.uvs`. */
  normalMap: Texture | null;
  normalScale: number;
  /** Index of the normal map's image in the file, or -1. */
  normalImage: number;
  color: Vector3;
  colorMap: Texture | null;
  /** Two numbers per vertex, if the color texture uses other UVs than the normal map. */
  colorUvs: Float32Array<ArrayBuffer> | null;
  alphaTest: number;
  isDoubleSided: boolean;
  /** The material of the loader, and the additional vertex attributes that it uses. */
  surface: Material;
  attributes: Record<string, BufferAttribute | InterleavedBufferAttribute>;
  /** Transforms by bones and morph weights, or null. */
  pose: Pose | null;
  /** The part has bones or morph weights, whatever their current values are. */
  isPosed: boolean;
  /** World transforms of the placements. */
  places: Matrix4[];
  /** Transform from the position in the file to the origin of the picture. */
  moved: Matrix4;
}

export const triangleCount = (arrays: Arrays): number => Math.floor((arrays.indices?.length ?? arrays.positions.length / 3) / 3);
