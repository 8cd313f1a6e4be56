// SPDX-License-Identifier: MIT
// KHR_materials_variants: the materials of each variant of a file, which the loader of three.js ignores.
import { Mesh, type Material, type Object3D } from "three";
import type { GLTF } from "three/examples/jsm/loaders/GLTFLoader.js";

const kVariants = "KHR_materials_variants";

/** The mesh and primitive of the file that a three.js mesh comes from. */
export interface Origin {
  meshes: number;
  primitives: number;
}

interface PrimitiveJson {
  material?: number;
  extensions?: { [kVariants]?: { mappings?: { material?: number; variants?: number[] }[] } };
}

/** Returns the names of a file's variants, in file order. */
export function variantsOf({ parser }: GLTF): string[] {
  const variants: unknown = parser.json.extensions?.[kVariants]?.variants;
  return Array.isArray(variants) ? variants.map((one: { name?: unknown } | null, i) => (typeof one?.name === "string" && one.name ? one.name : `variant ${i}`)) : [];
}

const primitiveAt = ({ parser }: GLTF, { meshes, primitives }: Origin) => parser.json.meshes?.[meshes]?.primitives?.[primitives] as PrimitiveJson | undefined;

function mappedIn(gltf: GLTF, origin: Origin, variant: number): number | undefined {
  const mappings = primitiveAt(gltf, origin)?.extensions?.[kVariants]?.mappings;
  return mappings?.find(({ variants }) => variants?.includes(variant))?.material;
}
const isThere = ({ parser }: GLTF, material: number): boolean => parser.json.materials?.[material] !== undefined;

/**
 * Returns the material of a primitive in a variant, or -1. A primitive without a mapping for the variant keeps its
 * material.
 */
export function materialIn(gltf: GLTF, origin: Origin, variant: number): number {
  const mapped = mappedIn(gltf, origin, variant);
  return mapped !== undefined && isThere(gltf, mapped) ? mapped : (primitiveAt(gltf, origin)?.material ?? -1);
}

/**
 * Assigns the materials of a variant to all meshes below the roots. Returns a sentence if the file references materials
 * that do not exist.
 */
export async function putOn(gltf: GLTF, variant: number, roots: readonly Object3D[], originOf: (mesh: Mesh, gltf: GLTF) => Origin | null): Promise<string | null> {
  if (variant < 0) return null;
  const meshes: [Mesh, number][] = [], lost = new Set<number>();
  for (const root of roots) {
    root.traverse((object) => {
      const origin = object instanceof Mesh ? originOf(object, gltf) : null;
      if (!(object instanceof Mesh) || !origin) return;
      const mapped = mappedIn(gltf, origin, variant), index = materialIn(gltf, origin, variant);
      if (mapped !== undefined && !isThere(gltf, mapped)) lost.add(mapped);
      if (index !== materialIn(gltf, origin, -1)) meshes.push([object, index]);
    });
  }
  for (const [mesh, index] of meshes) {
    mesh.material = (await gltf.parser.getDependency("material", index)) as Material;
    gltf.parser.assignFinalMaterial(mesh);
  }
  return lost.size > 0 ? `For this variant the file names ${lost.size === 1 ? "a material that is" : `${lost.size} materials that are`} not in it.` : null;
}
