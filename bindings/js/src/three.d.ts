// SPDX-License-Identifier: MIT
import type { BufferGeometry, Mesh } from "three";
import type { IndexedFramesOptions } from "./index.js";

export { ready, release } from "./types.js";

/**
 * Returns a new geometry with an index, the attribute `tangent` and missing `normal`. Corners keep their order, so
 * groups and draw ranges remain valid. Use the convention "gltf" for models of GLTFLoader, "opengl" for textures with
 * flipY. For a mesh its geometry is used: `mesh.geometry = computeTangents(mesh, options)`. UVs are required except for
 * the method "basis". Attributes keep their class, array type, name, usage and gpuType, and the index its type unless
 * it becomes too small. Exceptions: `tangent` is a Float32Array, and so are normals computed by `makeNormals` if the type
 * of `normal` cannot store unit vectors (unsigned integers, or integers that are not normalized); interleaved attributes
 * become separate ones, and instanced attributes are unchanged. The default of `pairing` is "corrected", as in three.js's
 * own module.
 */
export function computeTangents(geometry: BufferGeometry | Mesh, options: IndexedFramesOptions): BufferGeometry;
