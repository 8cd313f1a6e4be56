// SPDX-License-Identifier: MIT
import type { Document } from "@gltf-transform/core";
import type { IndexedFramesOptions } from "./index.js";

export const ready: Promise<void>;

export interface TransformOptions extends Omit<IndexedFramesOptions, "convention"> {
  /** Recompute existing tangents. */
  overwrite?: boolean;
}

/**
 * Returns a transform for `document.transform(...)`: triangles with UVs get an index, TANGENT and missing NORMAL, and
 * vertices whose corners differ are split, including morph targets, which get TANGENT too. Use `prune()` to remove
 * unreferenced data.
 */
export function tspaceTangents(options?: TransformOptions): (document: Document) => Promise<void>;
