// SPDX-License-Identifier: MIT
// The parts of a model as drawable objects. Each placement of a part is a separate object; all share one geometry.
import { BufferAttribute, BufferGeometry, DataTexture, Group, Matrix4, Mesh, Sphere, Vector3, type Material, type RawShaderMaterial, type Texture } from "three";
import { poseCorners, poseTangents } from "../model/pose.js";
import type { Part } from "../model/part.js";
import type { Corners, Frames } from "../worker/protocol.js";
import { makeMaterial } from "./shader.js";
import { surfaceFor } from "./surface.js";

export interface Drawn {
  /** Number of the part in the worker. */
  number: number;
  part: Part;
  corners: Corners;
  frames: Frames | null;
  /** Corners, and tangents of the right side, before bones and morph weights are applied; null if there are none. */
  rest: { corners: Pick<Corners, "positions" | "normals" | "tangents">; right: Float32Array<ArrayBuffer> | null; isOfMethod: boolean } | null;
  /** The normal map right of the split line. */
  rightMap: Texture | null;
  /** Green of `rightMap` is inverted for display, because `check` reports that it points down. */
  turnsGreen: boolean;
  geometry: BufferGeometry;
  /** Material of all looks except `lit` with colors, which uses `surface`. */
  material: RawShaderMaterial;
  surface: Material;
  meshes: Mesh[];
  surfaces: Mesh[];
  /** Placements that the user has hidden. */
  hidden: Set<number>;
  /** For each placement, index of its first triangle among all drawn triangles. */
  firstTriangles: number[];
}

const empty = new DataTexture(new Uint8Array([128, 128, 255, 255]), 1, 1);
empty.needsUpdate = true;

/** Converts data per vertex to data per corner. */
function perCorner(size: number, count: number, indices: Uint32Array | null, at: (vertex: number, k: number) => number): BufferAttribute {
  const out = new Float32Array(size * count);
  for (let corner = 0; corner < count; ++corner) {
    const vertex = indices ? indices[corner] : corner;
    for (let k = 0; k < size; ++k) out[size * corner + k] = at(vertex, k);
  }
  return new BufferAttribute(out, size);
}

function draw(number: number, part: Part, corners: Corners): Drawn {
  const geometry = new BufferGeometry();
  const count = corners.positions.length / 3;
  const set = (name: string, data: Float32Array<ArrayBuffer> | null, size: number) =>
    geometry.setAttribute(name, new BufferAttribute(data ?? new Float32Array(size * count), size));
  set("position", corners.positions, 3);
  set("normal", corners.normals, 3);
  set("mapUv", corners.uvs, 2);
  set("fileTangent", corners.tangents, 4);
  set("island", corners.islands, 2);
  set("right", null, 4);
  set("error", new Float32Array(2 * count).fill(-1), 2);
  const { colorUvs, arrays: { indices } } = part;
  geometry.setAttribute("colorUv", colorUvs ? perCorner(2, count, indices, (vertex, k) => colorUvs[2 * vertex + k]) : geometry.getAttribute("mapUv"));
  for (const [name, attribute] of Object.entries(part.attributes)) {
    geometry.setAttribute(name, perCorner(attribute.itemSize, count, indices, (vertex, k) => attribute.getComponent(vertex, k)));
  }
  const material = makeMaterial(
    { normalMap: corners.uvs && part.normalMap, colorMap: corners.uvs && part.colorMap, scale: part.normalScale, color: part.color, alphaTest: part.alphaTest, hasTangents: corners.tangents !== null, side: part.isDoubleSided ? 2 : 0 },
    empty,
  );
  const { uSplit, uMap, uHasTangents, uHasRight, uRightGreen, uRightMap } = material.uniforms;
  const surface = surfaceFor(part.surface, { uSplit, uMap, uHasTangents, uHasRight, uRightGreen, uRightMap });
  return { number, part, corners, frames: null, rest: null, rightMap: corners.uvs && part.normalMap, turnsGreen: false, geometry, material, surface, meshes: [], surfaces: [], hidden: new Set(), firstTriangles: [] };
}

function placed(mesh: Mesh, place: Matrix4): Mesh {
  mesh.matrixAutoUpdate = false;
  mesh.matrix.copy(place);
  mesh.matrixWorldNeedsUpdate = true;
  mesh.frustumCulled = false;
  return mesh;
}

/** The drawn parts; finds the part of a drawn triangle. */
export class Scene {
  readonly root = new Group();
  readonly drawn: Drawn[] = [];
  #triangles = 0;

  add(number: number, part: Part, corners: Corners): Drawn {
    const drawn = draw(number, part, corners);
    if (part.isPosed) {
      const { positions, normals, tangents } = corners;
      drawn.rest = { corners: { positions: positions.slice(), normals: normals.slice(), tangents: tangents?.slice() ?? null }, right: null, isOfMethod: true };
      this.#pose(drawn);
    }
    for (const place of part.places) {
      const mesh = placed(new Mesh<BufferGeometry, Material>(drawn.geometry, drawn.material), place);
      const surface = placed(new Mesh(drawn.geometry, drawn.surface), place);
      const first = this.#triangles;
      this.#triangles += corners.positions.length / 9;
      drawn.firstTriangles.push(first);
      mesh.onBeforeRender = () => {
        drawn.material.uniforms.uFirst.value = first;
        drawn.material.uniformsNeedUpdate = true;
      };
      drawn.meshes.push(mesh);
      surface.visible = false;
      surface.castShadow = surface.receiveShadow = true;
      drawn.surfaces.push(surface);
      this.root.add(mesh, surface);
    }
    this.drawn.push(drawn);
    return drawn;
  }

  /** Sets the frames and the map right of the split line. Without frames, the shader computes them, as renderers do. */
  setRight(drawn: Drawn, frames: Frames | null, map: Texture | null, isOfMethod: boolean): void {
    const corners = drawn.corners.positions.length / 3, { uniforms } = drawn.material;
    drawn.frames = frames;
    if (drawn.rest) {
      drawn.rest.right = frames?.tangents.slice() ?? null;
      drawn.rest.isOfMethod = isOfMethod;
      this.#pose(drawn);
    }
    drawn.rightMap = drawn.corners.uvs && map;
    drawn.geometry.setAttribute("right", new BufferAttribute(frames?.tangents ?? new Float32Array(4 * corners), 4));
    drawn.geometry.setAttribute("error", new BufferAttribute(frames?.errors ?? new Float32Array(2 * corners).fill(-1), 2));
    uniforms.uHasRight.value = frames !== null;
    uniforms.uRightMap.value = drawn.rightMap ?? empty;
  }

  /** Updates the scene after bones, weights or nodes have moved. */
  repose(): void {
    for (const drawn of this.drawn) {
      if (drawn.rest) this.#pose(drawn);
      for (const name of ["position", "normal", "fileTangent", "right"]) if (drawn.rest) drawn.geometry.getAttribute(name).needsUpdate = true;
      for (const [i, place] of drawn.part.places.entries()) {
        for (const mesh of [drawn.meshes[i], drawn.surfaces[i]]) {
          mesh.matrix.copy(place);
          mesh.matrixWorldNeedsUpdate = true;
        }
      }
    }
  }

  /** Transforms corners, and tangents of the right side, from rest to the pose. */
  #pose({ rest, part, corners, frames }: Drawn): void {
    if (!rest) return;
    corners.positions.set(rest.corners.positions);
    corners.normals.set(rest.corners.normals);
    if (rest.corners.tangents) corners.tangents?.set(rest.corners.tangents);
    if (rest.right) frames?.tangents.set(rest.right);
    if (!part.pose) return;
    poseCorners(part.pose, part.arrays, corners);
    if (frames) poseTangents(part.pose.matrices, part.arrays, frames.tangents, rest.isOfMethod ? rest.corners : null);
  }

  /** Sets whether green is inverted right of the split line. */
  turnGreen(drawn: Drawn, isTurned: boolean): void {
    drawn.turnsGreen = isTurned && drawn.rightMap !== null;
    drawn.material.uniforms.uRightGreen.value = drawn.turnsGreen;
  }

  /** Shows either the surfaces with their materials, or the page's own materials. */
  show(isSurface: boolean): void {
    for (const { meshes, surfaces, hidden } of this.drawn) {
      for (const [place, mesh] of meshes.entries()) mesh.visible = !isSurface && !hidden.has(place);
      for (const [place, mesh] of surfaces.entries()) mesh.visible = isSurface && !hidden.has(place);
    }
  }

  find(mesh: number, primitive: number): Drawn | undefined {
    return this.drawn.find(({ part }) => part.mesh === mesh && part.primitive === primitive);
  }

  /** Returns the part that contains a drawn triangle, its placement, and the index of the triangle in the part. */
  at(triangle: number): { drawn: Drawn; place: Matrix4; triangle: number } | null {
    for (const drawn of this.drawn) {
      const size = drawn.corners.positions.length / 9;
      for (let i = 0; i < drawn.firstTriangles.length; ++i) {
        const own = triangle - drawn.firstTriangles[i];
        if (own >= 0 && own < size) return { drawn, place: drawn.part.places[i], triangle: own };
      }
    }
    return null;
  }

  /** Returns vertex positions, three numbers each: all of a small model, and an even selection of a large one. */
  points(): Float32Array {
    const kMost = 60_000;
    const all = this.drawn.reduce((sum, { corners, part }) => sum + (corners.positions.length / 3) * part.places.length, 0);
    const step = Math.max(1, Math.ceil(all / kMost)), found: number[] = [], p = new Vector3();
    for (const { corners, part } of this.drawn) {
      for (const place of part.places) {
        for (let i = 0; i < corners.positions.length; i += 3 * step) {
          p.fromArray(corners.positions, i).applyMatrix4(place);
          if (Number.isFinite(p.x + p.y + p.z)) found.push(p.x, p.y, p.z);
        }
      }
    }
    return Float32Array.from(found);
  }

  /** Returns a sphere around all finite positions. */
  sphere(): Sphere {
    const points: Vector3[] = [];
    for (const { corners, part } of this.drawn) {
      const low = new Vector3(Infinity, Infinity, Infinity), high = new Vector3(-Infinity, -Infinity, -Infinity), p = new Vector3();
      for (let i = 0; i < corners.positions.length; i += 3) {
        p.fromArray(corners.positions, i);
        if (Number.isFinite(p.x + p.y + p.z)) low.min(p), high.max(p);
      }
      if (low.x > high.x) continue;
      for (const place of part.places) {
        for (let k = 0; k < 8; ++k) points.push(new Vector3(k & 1 ? low.x : high.x, k & 2 ? low.y : high.y, k & 4 ? low.z : high.z).applyMatrix4(place));
      }
    }
    const sphere = new Sphere();
    if (points.length > 0) sphere.setFromPoints(points);
    if (!(Number.isFinite(sphere.radius) && sphere.radius > 0)) sphere.set(new Vector3(), 1);
    return sphere;
  }

  dispose(): void {
    for (const { geometry, material, surface, part, rightMap } of this.drawn) {
      geometry.dispose();
      material.dispose();
      surface.dispose();
      for (const texture of Object.values(part.surface)) if ((texture as Texture | null)?.isTexture) (texture as Texture).dispose();
      part.normalMap?.dispose();
      rightMap?.dispose();
      part.colorMap?.dispose();
    }
    this.root.clear();
  }
}
