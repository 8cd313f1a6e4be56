// SPDX-License-Identifier: MIT
// Computes the rest pose of a mesh: its vertices after applying the bones and morph weights of the file.
import { Matrix4, SkinnedMesh, Vector3, type BufferAttribute, type Mesh } from "three";
import type { Arrays, Corners } from "../worker/protocol.js";

/**
 * Per vertex: offsets of morph targets (the loader does not read those of tangents), and the matrix of the bones (16
 * numbers, column by column). Null: none.
 */
export interface Pose {
  morphed: { position: Float32Array | null; normal: Float32Array | null };
  matrices: Float32Array | null;
}

function morphedBy(mesh: Mesh, name: "position" | "normal"): Float32Array | null {
  const targets = mesh.geometry.morphAttributes[name] as BufferAttribute[] | undefined, weights = mesh.morphTargetInfluences;
  if (!targets || !weights?.some((weight) => weight !== 0)) return null;
  const sums = new Float32Array(3 * mesh.geometry.getAttribute("position").count);
  for (const [i, target] of targets.entries()) {
    if (!weights[i]) continue;
    for (let v = 0; v < sums.length / 3; ++v) for (let k = 0; k < 3; ++k) sums[3 * v + k] += weights[i] * target.getComponent(v, k);
  }
  return sums;
}

/**
 * Returns the weighted bone matrix of each vertex. The transform of the skinned mesh's node is not included: glTF
 * ignores it.
 */
function bonesOf(mesh: SkinnedMesh): Float32Array {
  const { skinIndex, skinWeight } = mesh.geometry.attributes as Record<string, BufferAttribute>;
  const { bones, boneInverses } = mesh.skeleton, matrices = bones.map((bone, i) => new Matrix4().multiplyMatrices(bone.matrixWorld, boneInverses[i]).elements);
  const sums = new Float32Array(16 * skinIndex.count);
  for (let v = 0; v < skinIndex.count; ++v) {
    for (let k = 0; k < 4; ++k) {
      const weight = skinWeight.getComponent(v, k), matrix = matrices[skinIndex.getComponent(v, k)];
      if (weight !== 0 && matrix) for (let i = 0; i < 16; ++i) sums[16 * v + i] += weight * matrix[i];
    }
  }
  return sums;
}

/** Returns the pose of a mesh; null: the arrays are unchanged. */
export function poseOf(mesh: Mesh): Pose | null {
  const morphed = { position: morphedBy(mesh, "position"), normal: morphedBy(mesh, "normal") };
  const isSkinned = mesh instanceof SkinnedMesh && mesh.skeleton !== undefined && mesh.geometry.getAttribute("skinIndex") !== undefined && mesh.geometry.getAttribute("skinWeight") !== undefined;
  if (!isSkinned && !morphed.position && !morphed.normal) return null;
  return { morphed, matrices: isSkinned ? bonesOf(mesh) : null };
}

/** Transforms vectors of `stride` numbers, one per corner. */
function moved(data: Float32Array, stride: number, arrays: Arrays, added: Float32Array | null, change: ((vertex: number, v: Vector3, corner: number) => void) | null): void {
  const v = new Vector3();
  for (let corner = 0; corner < data.length / stride; ++corner) {
    const vertex = arrays.indices ? arrays.indices[corner] : corner;
    v.fromArray(data, stride * corner);
    if (added) v.set(v.x + added[3 * vertex], v.y + added[3 * vertex + 1], v.z + added[3 * vertex + 2]);
    change?.(vertex, v, corner);
    v.toArray(data, stride * corner);
  }
}

/** Transforms the corners of the picture to the pose. */
export function poseCorners({ morphed, matrices }: Pose, arrays: Arrays, corners: Corners): void {
  const matrix = new Matrix4(), normalMatrix = new Matrix4();
  const placed = matrices && ((vertex: number, v: Vector3) => void v.applyMatrix4(matrix.fromArray(matrices, 16 * vertex)));
  const turned = matrices && ((vertex: number, v: Vector3) => {
    normalMatrix.fromArray(matrices, 16 * vertex).invert().transpose();
    v.transformDirection(normalMatrix);
  });
  moved(corners.positions, 3, arrays, morphed.position, placed);
  moved(corners.normals, 3, arrays, morphed.normal, turned);
  if (corners.tangents) poseTangents(matrices, arrays, corners.tangents);
}

/** Returns whether the winding of a triangle agrees with its normals. */
function facesItsNormals({ positions: p, normals: n }: Pick<Corners, "positions" | "normals">, triangle: number): boolean {
  const [a, b, c] = [0, 3, 6].map((k) => new Vector3().fromArray(p, 9 * triangle + k)), sum = new Vector3(), own = new Vector3();
  for (const k of [0, 3, 6]) sum.add(own.fromArray(n, 9 * triangle + k));
  return b.sub(a).cross(c.sub(a)).dot(sum) >= 0;
}

/**
 * Transforms tangents to the pose. If bones mirror, cross(N, T) is inverted but the surface is not: w changes its sign,
 * so that B follows the surface. `rest`: corners at rest, for tangents of a method, whose w depends on the winding. A
 * triangle whose winding is opposite to its normals at rest is wound for the mirrored pose: its w is already correct.
 */
export function poseTangents(matrices: Float32Array | null, arrays: Arrays, tangents: Float32Array, rest: Pick<Corners, "positions" | "normals"> | null = null): void {
  const matrix = new Matrix4();
  if (!matrices) return;
  moved(tangents, 4, arrays, null, (vertex, v, corner) => {
    v.transformDirection(matrix.fromArray(matrices, 16 * vertex));
    if (matrix.determinant() < 0 && (!rest || facesItsNormals(rest, Math.floor(corner / 3)))) tangents[4 * corner + 3] *= -1;
  });
}
