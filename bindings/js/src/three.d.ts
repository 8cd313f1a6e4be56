// SPDX-License-Identifier: MIT
import type { BufferGeometry, Mesh } from "three";
import type { IndexedFramesOptions } from "./index.js";

export { ready, release } from "./types.js";

/**
 * A new geometry with an index and the attribute `tangent` (and `normal`, where it was missing). Corners keep their order, so
 * groups and draw ranges stay. The convention is "gltf" for what GLTFLoader gives, "opengl" where textures have flipY. Of a mesh
 * its geometry is taken: `mesh.geometry = computeTangents(mesh, options)`. UVs are needed but for the method "basis".
 * Attributes keep their class, array type, name, usage and gpuType, and an index its type unless it becomes too small; interleaved
 * attributes become separate ones, and instanced attributes stay as they are. `pairing` is "corrected" unless given, as in three.js's
 * own module.
 */
export function computeTangents(geometry: BufferGeometry | Mesh, options: IndexedFramesOptions): BufferGeometry;
