// SPDX-License-Identifier: MIT
// A bear with the typical faults of generated meshes: the zero surface of a field on a grid, with randomly displaced
// vertices, and patches of triangles with opposite winding. Uses only sums, products and square roots, so that every
// browser computes the same bytes.
import { GlbBuilder } from "./model/glb.js";

/** Center and radius of each ball. */
const balls: readonly (readonly [number, number, number, number])[] = [
  [0, -0.5, 0, 0.46], [0, 0.28, 0.02, 0.44], [-0.36, 0.68, -0.02, 0.17], [0.36, 0.68, -0.02, 0.17], [0, 0.16, 0.42, 0.16],
  [-0.5, -0.28, 0.14, 0.17], [0.5, -0.28, 0.14, 0.17], [-0.3, -0.86, 0.24, 0.2], [0.3, -0.86, 0.24, 0.2],
];
const kCells = 40, kLow = -1.15, kStep = 2.3 / kCells, kBlend = 0.16;
/** Maximum displacement of a vertex, as a fraction of a cell. */
const kNoise = 0.07;

/** Returns the signed distance to the bear; the balls are blended smoothly. */
function field(x: number, y: number, z: number): number {
  let nearest = 10;
  for (const [cx, cy, cz, radius] of balls) {
    const d = Math.sqrt((x - cx) ** 2 + (y - cy) ** 2 + (z - cz) ** 2) - radius, overlap = Math.max(0, kBlend - Math.abs(d - nearest)) / kBlend;
    nearest = Math.min(d, nearest) - (overlap * overlap * kBlend) / 4;
  }
  return nearest;
}

/** Returns a pseudo-random number in [-1, 1). */
function random(n: number): number {
  let h = Math.imul(n + 1, 0x9e3779b1);
  h = Math.imul(h ^ (h >>> 15), 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  return ((h ^ (h >>> 16)) >>> 0) / 2 ** 31 - 1;
}

/** Creates a vertex in each cell that the surface crosses, and a quad around each edge that crosses the surface. */
function surfaceNet(): { positions: number[]; triangles: [number, number, number][] } {
  const size = kCells + 1, steps = [1, kCells, kCells * kCells], positions: number[] = [], triangles: [number, number, number][] = [];
  const values = Float64Array.from({ length: size ** 3 }, (_, n) => field(...([n % size, Math.floor(n / size) % size, Math.floor(n / size / size)].map((k) => kLow + k * kStep) as [number, number, number])));
  const value = (i: number, j: number, k: number) => values[(k * size + j) * size + i];
  const vertexOf = new Int32Array(kCells ** 3).fill(-1);
  const cells = Array.from({ length: kCells ** 3 }, (_, n) => [n % kCells, Math.floor(n / kCells) % kCells, Math.floor(n / steps[2])] as const);
  for (const [n, [i, j, k]] of cells.entries()) {
    const sum = [0, 0, 0];
    let crossed = 0;
    for (let corner = 0; corner < 8; ++corner) {
      for (let axis = 0; axis < 3; ++axis) {
        if (corner & (1 << axis)) continue;
        const at = (c: number) => value(i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2)), a = at(corner), b = at(corner | (1 << axis));
        if (a < 0 === b < 0) continue;
        for (let q = 0; q < 3; ++q) sum[q] += ((corner >> q) & 1) + (q === axis ? a / (a - b) : 0);
        crossed += 1;
      }
    }
    if (crossed === 0) continue;
    vertexOf[n] = positions.length / 3;
    for (const [q, first] of [i, j, k].entries()) positions.push(kLow + kStep * (first + sum[q] / crossed + kNoise * random(positions.length)));
  }
  for (const [n, [i, j, k]] of cells.entries()) {
    if (Math.min(i, j, k) === 0) continue;
    for (let axis = 0; axis < 3; ++axis) {
      const a = value(i, j, k), b = value(i + Number(axis === 0), j + Number(axis === 1), k + Number(axis === 2));
      if (a < 0 === b < 0) continue;
      const [one, two] = [steps[(axis + 1) % 3], steps[(axis + 2) % 3]], around = [n - one - two, n - two, n, n - one].map((cell) => vertexOf[cell]);
      const [p, q, r, s] = a < 0 ? around : around.reverse();
      triangles.push([p, q, r], [p, r, s]);
    }
  }
  return { positions, triangles };
}

/** Returns mean normals of the triangles before any were flipped. */
function normalsOf(positions: number[], triangles: [number, number, number][]): Float32Array<ArrayBuffer> {
  const sums = new Float64Array(positions.length), at = (v: number) => positions.slice(3 * v, 3 * v + 3);
  for (const triangle of triangles) {
    const [a, b, c] = triangle.map(at), [e, f] = [b, c].map((p) => p.map((x, q) => x - a[q]));
    const n = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
    for (const v of triangle) for (let q = 0; q < 3; ++q) sums[3 * v + q] += n[q];
  }
  const length = (v: number) => Math.sqrt(sums[3 * v] ** 2 + sums[3 * v + 1] ** 2 + sums[3 * v + 2] ** 2) || 1;
  return Float32Array.from(sums, (x, i) => x / length(Math.floor(i / 3)));
}

/** Returns whether triangles at a position are flipped: in patches where the sum of three waves is large. */
function isTurned(x: number, y: number, z: number): boolean {
  const wave = (t: number) => 1 - 4 * Math.abs(t - Math.floor(t) - 0.5);
  return wave(1.1 * x + 0.15) + wave(1.3 * y + 0.1) + wave(1.2 * z + 0.2) > 0.95;
}

export function bear(): Uint8Array<ArrayBuffer> {
  const { positions, triangles } = surfaceNet(), builder = new GlbBuilder();
  const attributes = { POSITION: builder.addAccessor(Float32Array.from(positions), "VEC3"), NORMAL: builder.addAccessor(normalsOf(positions, triangles), "VEC3") };
  const corners = triangles.flatMap(([a, b, c]) => (isTurned(positions[3 * a], positions[3 * a + 1], positions[3 * a + 2]) ? [a, c, b] : [a, b, c]));
  const indices = builder.addAccessor(Uint32Array.from(corners), "SCALAR");
  return builder.finish({
    scene: 0, scenes: [{ nodes: [0] }], nodes: [{ name: "bear", mesh: 0 }], meshes: [{ name: "bear", primitives: [{ attributes, indices, material: 0 }] }],
    materials: [{ name: "clay", pbrMetallicRoughness: { baseColorFactor: [0.42, 0.22, 0.1, 1], metallicFactor: 0, roughnessFactor: 0.55 } }],
  }, "tspace samples");
}
