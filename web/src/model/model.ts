// SPDX-License-Identifier: MIT
// A model in the page's representation: its parts, the tree of its nodes, and its motion.
import type { Motion } from "./motion.js";
import type { Part } from "./part.js";

/** A node that draws something, itself or by its descendants. */
export interface TreeNode {
  name: string;
  /** Placements of parts that this node draws. */
  draws: { part: Part; first: number; count: number }[];
  children: TreeNode[];
}

export interface Model {
  parts: Part[];
  tree: TreeNode[];
  motion: Motion | null;
  /** Index of the normal map's image for each material of the file, or -1. */
  normalImages: number[];
  /** Names of KHR_materials_variants. */
  variants: string[];
  /** Remarks about what the picture does not show. */
  remarks: string[];
}
