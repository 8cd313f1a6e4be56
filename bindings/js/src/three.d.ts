// SPDX-License-Identifier: MIT
import type { BufferGeometry, Mesh } from "three";
import type { IndexedFramesOptions } from "./index.js";

export const ready: Promise<void>;

/**
 * A new geometry with an index and the attribute `tangent` (and `normal`, where it was missing). Corners keep their order, so
 * groups and draw ranges stay. The convention is "gltf" for what GLTFLoader gives, "opengl" where textures have flipY. Of a mesh
 * its geometry is taken: `mesh.geometry = computeTangents(mesh, options)`. UVs are needed but for the method "basis".
 */
export function computeTangents(geometry: BufferGeometry | Mesh, options: IndexedFramesOptions): BufferGeometry;
