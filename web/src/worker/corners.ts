// SPDX-License-Identifier: MIT
// Primitives as lists of corners, islands of their UV maps, and frames with their deviation from those of the file.
import { generateNormals, generateTangents, ready, type Mesh } from "tspace";
import type { Arrays, Corners, Frames, MapCorners, Method } from "./protocol.js";

const kNoVertex = 0xffffffff;

/** Returns the vertex of each corner, for complete triangles only. */
function cornerVertices({ positions, indices }: Arrays): Uint32Array<ArrayBuffer> {
  const vertices = positions.length / 3;
  const source = indices ?? Uint32Array.from({ length: vertices }, (_, i) => i);
  const corners = source.slice(0, source.length - (source.length % 3));
  for (const vertex of corners) if (vertex >= vertices) throw new Error(`an index is ${vertex}, but there are only ${vertices} vertices`);
  return corners;
}

function gather(data: Float32Array, size: number, vertices: Uint32Array): Float32Array<ArrayBuffer> {
  const out = new Float32Array(size * vertices.length);
  for (let corner = 0; corner < vertices.length; ++corner) {
    for (let k = 0; k < size; ++k) out[size * corner + k] = data[size * vertices[corner] + k];
  }
  return out;
}

const meshOf = (arrays: Arrays, vertices: Uint32Array<ArrayBuffer>): Mesh => ({
  positions: arrays.positions,
  normals: arrays.normals,
  uvs: arrays.uvs,
  indices: vertices,
});

/** Returns for each corner the first vertex with the same position and UV: islands are connected at such vertices. */
function sameInMap(arrays: Arrays, vertices: Uint32Array): Uint32Array {
  const position = new Uint32Array(arrays.positions.buffer, arrays.positions.byteOffset, arrays.positions.length);
  const uv = new Uint32Array(arrays.uvs!.buffer, arrays.uvs!.byteOffset, arrays.uvs!.length);
  const count = position.length / 3;
  let size = 16;
  while (size < 2 * count) size *= 2;
  const table = new Uint32Array(size).fill(kNoVertex), first = new Uint32Array(count);
  const words = (v: number) => [position[3 * v], position[3 * v + 1], position[3 * v + 2], uv[2 * v], uv[2 * v + 1]];
  for (let v = 0; v < count; ++v) {
    let hash = 0x811c9dc5;
    for (const word of words(v)) hash = Math.imul(hash ^ word ^ (word >>> 15), 0x9e3779b1) >>> 0;
    let slot = (hash ^ (hash >>> 16)) & (size - 1);
    while (table[slot] !== kNoVertex) {
      const other = table[slot], a = words(v), b = words(other);
      if (a.every((word, k) => word === b[k])) break;
      slot = (slot + 1) & (size - 1);
    }
    if (table[slot] === kNoVertex) table[slot] = v;
    first[v] = table[slot];
  }
  return Uint32Array.from(vertices, (v) => first[v]);
}

/**
 * Returns the island of each triangle. Triangles are in one island if they share a point in the UV map and on the
 * surface.
 */
function findIslands(arrays: Arrays, vertices: Uint32Array): { ofTriangle: Uint32Array; count: number } {
  const same = sameInMap(arrays, vertices);
  const parent = Uint32Array.from({ length: arrays.positions.length / 3 }, (_, i) => i);
  const root = (v: number) => {
    while (parent[v] !== v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (let corner = 0; corner < same.length; corner += 3) {
    const a = root(same[corner]);
    parent[root(same[corner + 1])] = a;
    parent[root(same[corner + 2])] = a;
  }
  const numbers = new Map<number, number>();
  const ofTriangle = new Uint32Array(same.length / 3);
  for (let triangle = 0; triangle < ofTriangle.length; ++triangle) {
    const key = root(same[3 * triangle]);
    if (!numbers.has(key)) numbers.set(key, numbers.size);
    ofTriangle[triangle] = numbers.get(key)!;
  }
  return { ofTriangle, count: numbers.size };
}

/**
 * Returns 1 if the triangle shows its texture mirrored. With v pointing down, as in glTF, its UVs then have the same
 * orientation as its corners.
 */
function mirrored(uvs: Float32Array, triangle: number): number {
  const i = 6 * triangle;
  const area = (uvs[i + 2] - uvs[i]) * (uvs[i + 5] - uvs[i + 1]) - (uvs[i + 4] - uvs[i]) * (uvs[i + 3] - uvs[i + 1]);
  return area > 0 ? 1 : area < 0 ? 0 : 0.5;
}

export async function cornersOf(arrays: Arrays): Promise<Corners> {
  await ready;
  const vertices = cornerVertices(arrays);
  const corners: Corners = {
    positions: gather(arrays.positions, 3, vertices),
    normals: arrays.normals ? gather(arrays.normals, 3, vertices) : (generateNormals(meshOf(arrays, vertices), { weighting: "flat" }) as Float32Array<ArrayBuffer>),
    uvs: null,
    tangents: arrays.tangents && gather(arrays.tangents, 4, vertices),
    islands: new Float32Array(2 * vertices.length),
    islandCount: 0,
    mirroredCount: 0,
    normalsMade: !arrays.normals,
  };
  return arrays.uvs ? { ...corners, ...mapCorners(arrays) } : corners;
}

/** Returns the UV map of arrays that have UVs. */
export function mapCorners(arrays: Arrays): MapCorners {
  const vertices = cornerVertices(arrays), { ofTriangle, count } = findIslands(arrays, vertices);
  const uvs = gather(arrays.uvs!, 2, vertices), islands = new Float32Array(2 * vertices.length);
  let mirroredCount = 0;
  for (let triangle = 0; triangle < ofTriangle.length; ++triangle) {
    const side = mirrored(uvs, triangle);
    if (side === 1) mirroredCount += 1;
    for (let corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
      islands[2 * corner] = ofTriangle[triangle];
      islands[2 * corner + 1] = side;
    }
  }
  return { uvs, islands, islandCount: count, mirroredCount };
}

/** Returns the degrees between two directions, or -1 if one of them is zero or invalid. */
function degreesBetween(a: ArrayLike<number>, i: number, b: ArrayLike<number>, j: number): number {
  const cross = Math.hypot(a[i + 1] * b[j + 2] - a[i + 2] * b[j + 1], a[i + 2] * b[j] - a[i] * b[j + 2], a[i] * b[j + 1] - a[i + 1] * b[j]);
  const dot = a[i] * b[j] + a[i + 1] * b[j + 1] + a[i + 2] * b[j + 2];
  if (!(Number.isFinite(cross + dot) && (cross !== 0 || dot !== 0))) return -1;
  return (Math.atan2(cross, dot) * 180) / Math.PI;
}

export async function computeFrames(arrays: Arrays, method: Method): Promise<Frames> {
  await ready;
  const vertices = cornerVertices(arrays);
  let mesh = meshOf(arrays, vertices);
  if (!mesh.normals) {
    // Flat normals differ by corner, so the mesh gets one vertex per corner, like the picture.
    const own = Uint32Array.from(vertices, (_, corner) => corner);
    mesh = { positions: gather(arrays.positions, 3, vertices), normals: generateNormals(mesh, { weighting: "flat" }), uvs: arrays.uvs && gather(arrays.uvs, 2, vertices), indices: own };
  }
  return compared(generateTangents(mesh, { convention: "gltf", method: arrays.uvs ? method : "basis" }) as Float32Array<ArrayBuffer>, arrays, vertices);
}

/** Returns the frames of another file for the same triangles, or null if the triangles differ. */
export function otherFrames(arrays: Arrays, others: Arrays): Frames | null {
  const vertices = cornerVertices(arrays), theirs = cornerVertices(others);
  if (!others.tangents || theirs.length !== vertices.length) return null;
  // In a flipped triangle the second and third corner are exchanged.
  const isAt = (a: number, b: number) => [0, 1, 2].every((k) => arrays.positions[3 * vertices[a] + k] === others.positions[3 * theirs[b] + k]);
  for (let second = 1; second < theirs.length; second += 3) {
    const third = second + 1;
    if (!isAt(second, second) && isAt(second, third) && isAt(third, second)) [theirs[second], theirs[third]] = [theirs[third], theirs[second]];
  }
  return compared(gather(others.tangents, 4, theirs), arrays, vertices);
}

/** Returns frames with these tangents, and the deviation of the tangents in `arrays` from them. */
function compared(tangents: Float32Array<ArrayBuffer>, arrays: Arrays, vertices: Uint32Array): Frames {
  const frames: Frames = { tangents, errors: new Float32Array(2 * vertices.length), compared: 0, meanDegrees: 0, maxDegrees: 0, wrongSigns: 0 };
  for (let corner = 0; corner < vertices.length; ++corner) {
    const stored = arrays.tangents, at = 4 * vertices[corner];
    const degrees = stored && arrays.uvs ? degreesBetween(stored, at, tangents, 4 * corner) : -1;
    frames.errors[2 * corner] = degrees;
    if (degrees < 0) continue;
    frames.compared += 1;
    frames.meanDegrees += degrees;
    frames.maxDegrees = Math.max(frames.maxDegrees, degrees);
    if (stored![at + 3] * tangents[4 * corner + 3] <= 0) {
      frames.errors[2 * corner + 1] = 1;
      frames.wrongSigns += 1;
    }
  }
  frames.meanDegrees /= Math.max(1, frames.compared);
  return frames;
}
