// SPDX-License-Identifier: MIT
import type { Document } from "@gltf-transform/core";
import type { IndexedFramesOptions } from "./index.js";

export const ready: Promise<void>;

export interface TransformOptions extends Omit<IndexedFramesOptions, "convention"> {
  /** Also for primitives that have tangents. */
  overwrite?: boolean;
}

/**
 * A transform for `document.transform(...)`: triangles with UVs get an index, TANGENT (and NORMAL, where it was missing), and
 * vertices whose corners disagree are split, morph targets with them, which get TANGENT too. What nothing refers to any more is
 * for `prune()`.
 */
export function tspaceTangents(options?: TransformOptions): (document: Document) => Promise<void>;
