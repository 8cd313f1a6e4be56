// SPDX-License-Identifier: MIT
// A primitive of a model in the page's representation.
import type { BufferAttribute, InterleavedBufferAttribute, Material, Matrix4, Texture, Vector3 } from "three";
import type { Motion } from "./motion.js";
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
  /** Set and transform of the normal map, already in `arrays.uvs`. */
  normalMap: Texture | null;
  normalScale: number;
  /** Index of that image in the file, or -1. */
  normalImage: number;
  color: Vector3;
  colorMap: Texture | null;
  /** Two numbers per vertex, where the colour has other UVs than the normal map. */
  colorUvs: Float32Array<ArrayBuffer> | null;
  alphaTest: number;
  isDoubleSided: boolean;
  /** The material of the loader, and the attributes that it reads beside our own, per vertex. */
  surface: Material;
  attributes: Record<string, BufferAttribute | InterleavedBufferAttribute>;
  /** Where bones and morph weights put it, or null. */
  pose: Pose | null;
  /** It has bones or morph weights, whatever these are now. */
  isPosed: boolean;
  /** Where it is drawn. */
  places: Matrix4[];
  /** What took it from where the file has it to the origin of the picture. */
  moved: Matrix4;
}

/** A node that draws something, by itself or below it. */
export interface TreeNode {
  name: string;
  /** What it draws: places of parts, by their numbers. */
  draws: { part: Part; first: number; count: number }[];
  children: TreeNode[];
}

export interface Model {
  parts: Part[];
  tree: TreeNode[];
  motion: Motion | null;
  /** For each material of the file the index of its normal map's image, or -1. */
  normalImages: number[];
  /** Names of KHR_materials_variants. */
  variants: string[];
  /** Sentences about what the picture leaves out. */
  remarks: string[];
}

export const triangleCount = (arrays: Arrays): number => Math.floor((arrays.indices?.length ?? arrays.positions.length / 3) / 3);
