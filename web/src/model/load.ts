// SPDX-License-Identifier: MIT
// Loads a model for display with the loader of three.js. Its errors concern only the picture; verdicts come from
// tspace.
import { InstancedMesh, LoadingManager, Matrix3, Matrix4, Mesh, SkinnedMesh, Vector3, type Group, type Material, type MeshStandardMaterial, type Object3D, type Texture } from "three";
import { GLTFLoader, type GLTF } from "three/examples/jsm/loaders/GLTFLoader.js";
import type { ModelFiles } from "../files.js";
import { WorkError, type Work } from "../worker/client.js";
import { arraysOf, uvsOf } from "./arrays.js";
import { Motion } from "./motion.js";
import { poseOf } from "./pose.js";
import { giveDecoders } from "./compressed.js";
import type { Model, TreeNode } from "./model.js";
import type { Part } from "./part.js";
import { materialIn, putOn, variantsOf, type Origin } from "./variants.js";
import { missingImages, normalImagesOf, readTextureFiles } from "./textures.js";

/** Limit of drawn corners, because of the browser's memory. Findings are always complete. */
const kMostCorners = 12_000_000;
const kMostInstances = 1000;

/**
 * An error of the loader of three.js: the file cannot be read. Any other error during drawing is a fault of the page.
 */
export class LoaderError extends Error {}

const byLoader = <T>(work: Promise<T>): Promise<T> => work.catch((error: unknown) => {
  throw error instanceof WorkError ? error : new LoaderError(`The loader of three.js cannot read this file (${error instanceof Error ? error.message : String(error)}).`);
});

const decoded = (uri: string): string => {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
};

/** Gives the loader access to the files that were opened with the model, and to nothing else. */
function managerFor(model: ModelFiles, urls: string[]): LoadingManager {
  const manager = new LoadingManager();
  const types: Record<string, string> = { png: "image/png", jpg: "image/jpeg", jpeg: "image/jpeg", webp: "image/webp" };
  manager.setURLModifier((url) => {
    if (/^(data|blob):/i.test(url)) return url;
    const path = decoded(url).replace(/^\.\//, "");
    const bytes = model.others.get(path);
    if (!bytes) return "data:,"; // the file does not exist here, and is not requested elsewhere
    const type = types[path.slice(path.lastIndexOf(".") + 1).toLowerCase()] ?? "application/octet-stream";
    urls.push(URL.createObjectURL(new Blob([bytes], { type })));
    return urls[urls.length - 1];
  });
  return manager;
}

function matrixOf(texture: Texture | null): Matrix3 | null {
  if (!texture) return null;
  // The loader sets the matrix itself where the order of glTF's rotation and scale differs from that of three.js.
  if (texture.matrixAutoUpdate) texture.updateMatrix();
  return texture.matrix.equals(new Matrix3()) ? null : texture.matrix.clone();
}

const usable = (texture: Texture | null | undefined): Texture | null => (texture?.image ? texture : null);

const kSurfaceAttributes = ["uv", "uv1", "uv2", "uv3", "color"];

function partOf(mesh: Mesh, where: Origin, materialIndex: number, normalImages: number[]): Part | null {
  const material = (Array.isArray(mesh.material) ? mesh.material[0] : mesh.material) as Material & Partial<MeshStandardMaterial>;
  const normalMap = usable(material.normalMap), colorMap = usable(material.map);
  const leading = material.normalMap ?? material.map ?? null;
  const channel = leading?.channel ?? 0, matrix = matrixOf(leading);
  const arrays = arraysOf(mesh.geometry, channel, matrix);
  if (!arrays) return null;
  const colorChannel = colorMap?.channel ?? channel, colorMatrix = matrixOf(colorMap);
  const isSame = !colorMap || (colorChannel === channel && (colorMatrix?.equals(matrix ?? new Matrix3()) ?? matrix === null));
  const color = material.color ?? { r: 0.8, g: 0.8, b: 0.8 };
  return {
    mesh: where.meshes,
    primitive: where.primitives,
    name: mesh.name,
    materialName: material.name,
    material: materialIndex,
    arrays,
    normalMap,
    // Only x is used, because the loader negates y if there are no tangents.
    normalScale: material.normalScale?.x ?? 1,
    normalImage: normalImages[materialIndex] ?? -1,
    color: new Vector3(color.r, color.g, color.b),
    colorMap,
    colorUvs: isSame ? null : uvsOf(mesh.geometry, colorChannel, colorMatrix),
    alphaTest: material.alphaTest ?? 0,
    isDoubleSided: material.side === 2,
    surface: material,
    attributes: Object.fromEntries(kSurfaceAttributes.flatMap((name) => (mesh.geometry.hasAttribute(name) ? [[name, mesh.geometry.getAttribute(name)]] : []))),
    pose: poseOf(mesh),
    isPosed: mesh instanceof SkinnedMesh || (mesh.morphTargetInfluences?.length ?? 0) > 0,
    places: [],
    moved: new Matrix4(),
  };
}

/**
 * Returns the mesh and primitive of the file that a three.js mesh comes from. The loader creates instanced meshes
 * separately; only their node is known.
 */
function originOf(mesh: Mesh, gltf: GLTF): Origin | null {
  type Known = { meshes?: number; primitives?: number; nodes?: number } | undefined;
  const known = (object: Object3D | null) => (object ? (gltf.parser.associations.get(object) as Known) : undefined);
  const own = known(mesh);
  if (own?.meshes !== undefined) return { meshes: own.meshes, primitives: own.primitives ?? 0 };
  const above = own?.nodes === undefined ? known(mesh.parent)?.nodes : undefined;
  const meshes = gltf.parser.json.nodes?.[own?.nodes ?? above ?? -1]?.mesh as number | undefined;
  return meshes === undefined ? null : { meshes, primitives: above === undefined ? 0 : mesh.parent!.children.indexOf(mesh) };
}

/** Returns the world transforms of a mesh; of many instances only the first ones. */
function placesOf(mesh: Mesh): Matrix4[] {
  if (mesh instanceof SkinnedMesh) return [new Matrix4()];
  if (!(mesh instanceof InstancedMesh)) return [mesh.matrixWorld.clone()];
  return Array.from({ length: Math.min(mesh.count, kMostInstances) }, (_, i) => {
    const place = new Matrix4();
    mesh.getMatrixAt(i, place);
    return place.premultiply(mesh.matrixWorld);
  });
}

/**
 * Moves models that are far from the origin close to it, because shaders use single precision. The picture does not
 * show the origin.
 */
function moveToOrigin(parts: Iterable<Part>): void {
  const kFar = 1e4; // where the spacing of floats is 0.001
  const all = [...parts], places = all.flatMap((part) => part.places);
  const { x, y, z } = new Vector3().setFromMatrixPosition(places[0] ?? new Matrix4());
  if (Math.hypot(x, y, z) < kFar) return;
  for (const part of all) part.moved.makeTranslation(-x, -y, -z);
  for (const place of places) place.premultiply(new Matrix4().makeTranslation(-x, -y, -z));
}

/**
 * Returns the tree of nodes that draw something. A chain of nodes with a single child each is reduced to its last node.
 */
function treeOf(roots: readonly Object3D[], drawnBy: Map<Object3D, TreeNode["draws"][number]>): TreeNode[] {
  const nodeOf = (object: Object3D): TreeNode | null => {
    const own = drawnBy.get(object), children = object.children.map(nodeOf).filter((node) => node !== null);
    if (!own && children.length === 0) return null;
    if (!own && children.length === 1) return { ...children[0], name: children[0].name || object.name };
    return { name: object.name, draws: own ? [own] : [], children };
  };
  const tops = roots.map(nodeOf).filter((node) => node !== null);
  // The scene itself is not a node.
  return tops.flatMap((top) => (top.draws.length === 0 ? top.children : [top]));
}

async function sceneOf(gltf: GLTF, remarks: string[]): Promise<Object3D[]> {
  const roots: Object3D[] = gltf.scene ? [gltf.scene] : gltf.scenes;
  let hasMesh = false;
  for (const root of roots) root.traverse((object) => (hasMesh ||= object instanceof Mesh));
  if (hasMesh) return roots;
  const meshes = (await gltf.parser.getDependencies("mesh")) as (Group | Mesh)[];
  if (meshes.length > 0) remarks.push("No node of the scene draws these meshes, so they are shown without a node transform.");
  return meshes;
}

/** Returns what a file draws, with the materials of a variant, or with those of its primitives (-1). */
export async function loadModel(model: ModelFiles, work: Work, variant = -1): Promise<Model> {
  const urls: string[] = [];
  const remarks: string[] = [];
  const loader = new GLTFLoader(managerFor(model, urls));
  giveDecoders(loader, work);
  const why = readTextureFiles(loader, work);
  try {
    const buffer = model.bytes.buffer.slice(model.bytes.byteOffset, model.bytes.byteOffset + model.bytes.byteLength);
    const isText = /\.gltf$/i.test(model.name);
    const gltf = await byLoader(loader.parseAsync(isText ? new TextDecoder().decode(buffer) : buffer, ""));
    const parts = new Map<string, Part>(), normalImages = normalImagesOf(gltf);
    let corners = 0, left = 0;
    const roots = await byLoader(sceneOf(gltf, remarks)), objects: [Part, Mesh][] = [], drawnBy = new Map<Object3D, TreeNode["draws"][number]>();
    const lost = await byLoader(putOn(gltf, variant, roots, originOf));
    if (lost) remarks.push(lost);
    for (const root of roots) {
      root.updateMatrixWorld(true);
      root.traverse((object) => {
        const where = object instanceof Mesh ? originOf(object, gltf) : null;
        if (!(object instanceof Mesh) || !where) return;
        // Each skinned mesh has a separate pose.
        const key = `${where.meshes}/${where.primitives}/${(object.material as Material).uuid}/${object instanceof SkinnedMesh ? object.uuid : ""}`;
        const known = parts.get(key) ?? partOf(object, where, materialIn(gltf, where, variant), normalImages);
        if (!known) return;
        corners += known.arrays.indices?.length ?? known.arrays.positions.length / 3;
        if (corners > kMostCorners) return void (left += 1);
        if (!parts.has(key)) objects.push([known, object]);
        parts.set(key, known);
        const first = known.places.length;
        known.places.push(...placesOf(object));
        drawnBy.set(object, { part: known, first, count: known.places.length - first });
      });
    }
    moveToOrigin(parts.values());
    if (left > 0) remarks.push(`${left} parts of the model are not drawn, because the picture is limited to ${kMostCorners / 3 / 1e6} million triangles.`);
    remarks.push(...(await missingImages(gltf, why)));
    const isMoving = gltf.animations.length > 0 || gltf.cameras.length > 0 || objects.some(([, { morphTargetInfluences }]) => morphTargetInfluences);
    const motion = isMoving && roots.length > 0 ? new Motion(roots, gltf.animations, gltf.cameras, objects) : null;
    return { parts: [...parts.values()], tree: treeOf(roots, drawnBy), motion, normalImages, variants: variantsOf(gltf), remarks };
  } finally {
    for (const url of urls) URL.revokeObjectURL(url);
  }
}
