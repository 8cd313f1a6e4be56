// SPDX-License-Identifier: MIT
// The frame of a vertex under the matrix of its node: in GLSL for the shaders, and in TypeScript for lines and numbers.
// As in three.js and Khronos' glTF viewer, N is transformed by the inverse transpose and T by the matrix, both are
// normalized at the vertex, and B = w * cross(N, T) is computed from them: scaling a node neither flattens nor
// exaggerates relief. If the node mirrors (determinant < 0), cross(N, T) is inverted but the surface is not, so B is
// multiplied by the sign of the determinant. Those two viewers omit that sign, and light tangents of mirrored nodes
// upside down along B.
import { Matrix3, Vector3, type Matrix4 } from "three";

export const frameGlsl = `
float largestOf(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// Zero where v has no direction. Division by the largest component first keeps the squares of tiny and huge vectors finite.
vec3 unitOf(vec3 v) {
  float size = largestOf(v);
  return size > 0.0 ? normalize(v / size) : vec3(0.0);
}

mat3 linearOf(mat4 matrix) {
  mat3 m = mat3(matrix);
  return m / max(largestOf(m[0]), max(largestOf(m[1]), largestOf(m[2])));
}

float sideOf(mat3 m) { return dot(m[0], cross(m[1], m[2])) < 0.0 ? -1.0 : 1.0; }

// The cofactors are the inverse transpose times the determinant, and need no division.
vec3 placedNormal(mat3 m, vec3 normal) {
  return unitOf(sideOf(m) * (mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])) * normal));
}

// T and B, for N as placedNormal() returns it.
void placeTangent(mat3 m, vec3 normal, vec4 tangent, out vec3 t, out vec3 b) {
  t = unitOf(m * tangent.xyz);
  b = cross(normal, t) * (tangent.w * sideOf(m));
}`;

/** Computes in TypeScript the transformed frames for one placement of a part. */
export class PlacedFrame {
  #linear = new Matrix3();
  #normals = new Matrix3();
  #side: number;

  constructor(place: Matrix4) {
    this.#linear.setFromMatrix4(place);
    const [x, y, z] = [0, 1, 2].map((k) => new Vector3().setFromMatrixColumn(place, k));
    const [a, b, c] = [y.clone().cross(z), z.clone().cross(x), x.clone().cross(y)];
    this.#side = x.dot(a) < 0 ? -1 : 1;
    this.#normals.set(a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z).multiplyScalar(this.#side);
  }

  normal(n: Vector3): Vector3 {
    return n.clone().applyMatrix3(this.#normals).normalize();
  }

  tangent(t: Vector3): Vector3 {
    return t.clone().applyMatrix3(this.#linear).normalize();
  }

  bitangent(n: Vector3, t: Vector3, w: number): Vector3 {
    return this.normal(n).cross(this.tangent(t)).multiplyScalar(w * this.#side);
  }
}
