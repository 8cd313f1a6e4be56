// SPDX-License-Identifier: MIT
// Poses of meshes computed with the module, to compare the results of GPUs with. Used in Node.js and in bundled pages.
import { generateNormals, makeIndexedFrames, Plan, planBuffers } from "tspace";

const round = Math.fround;
const gather = (array, size, sources) => {
  const made = new array.constructor(sources.length * size);
  sources.forEach((source, i) => made.set(array.subarray(size * source, size * source + size), size * i));
  return made;
};

/** Computes the positions of a pose like the shader: morphed by `weights`, then skinned by `matrices`. */
export function posed({ positions, targets, joints, jointWeights }, weights, matrices) {
  const moved = positions.slice();
  weights.forEach((weight, t) => moved.forEach((x, i) => (moved[i] = x + round(weight * targets[t][i]))));
  if (!matrices) return moved;
  for (let v = 0; v < positions.length / 3; ++v) {
    const [x, y, z] = moved.subarray(3 * v, 3 * v + 3), sum = [0, 0, 0];
    for (let i = 0; i < 4; ++i) {
      const row = 12 * joints[4 * v + i], weight = jointWeights[4 * v + i];
      for (let k = 0; k < 3; ++k) {
        const [a, b, c, d] = matrices.subarray(row + 4 * k, row + 4 * k + 4);
        sum[k] = round(sum[k] + round(weight * round(round(round(round(a * x) + round(b * y)) + round(c * z)) + d)));
      }
    }
    moved.set(sum, 3 * v);
  }
  return moved;
}

/** Returns the mesh with one vertex per result, and its plan. `options`: those of makeIndexedFrames and Plan. */
export function prepared(mesh, options) {
  const { positions, uvs, indices } = mesh;
  const made = makeIndexedFrames({ positions, uvs, indices }, options);
  const take = (array, size) => array && gather(array, size, made.sourceVertices);
  const vertices = {
    positions: take(positions, 3), uvs: take(uvs, 2), normals: made.normals, indices: made.indices,
    targets: (mesh.targets ?? []).map((target) => take(target, 3)), joints: take(mesh.joints, 4), jointWeights: take(mesh.jointWeights, 4),
  };
  const { targets, joints, jointWeights, ...plain } = vertices;
  const plan = new Plan(plain, options);
  return { vertices, plain, plan, buffers: planBuffers(plan, { sourceCorners: made.sourceCorners, mesh: plain }), sourceCorners: made.sourceCorners };
}

/**
 * Computes normals and tangents of each result with the module. `isUsed`: 0 for results of vertices that no triangle uses.
 * `given`: normals for the tangents; where a tangent is nearly parallel to the normal, the last bits of the normal turn it.
 */
export function expected({ plain, plan, sourceCorners }, positions, given) {
  const corners = generateNormals({ positions, indices: plain.indices });
  const normals = plain.normals.slice();
  plain.indices.forEach((vertex, corner) => normals.set(corners.subarray(3 * corner, 3 * corner + 3), 3 * vertex));
  const isUsed = sourceCorners.map((corner) => (corner === 0xffffffff ? 0 : 1));
  return { normals, tangents: gather(plan.evaluate({ positions, normals: given ?? normals }), 4, sourceCorners.map((corner, i) => corner * isUsed[i])), isUsed };
}

const degrees = (a, b, at, to) => {
  const [x, y, z] = a.subarray(at, at + 3), [u, v, w] = b.subarray(to, to + 3);
  const cross = Math.hypot(y * w - z * v, z * u - x * w, x * v - y * u);
  return (Math.atan2(cross, x * u + y * v + z * w) * 180) / Math.PI;
};

/** Returns the 99th percentile and the maximum of the differences, in degrees, without results that are not used. */
export function compare(wanted, found) {
  const outcome = { results: wanted.normals.length / 3, wrongSigns: 0 };
  for (const [name, size] of [["tangents", 4], ["normals", 3]]) {
    const a = wanted[name], b = found[name], list = [];
    for (let at = 0; at < a.length; at += size) {
      if (wanted.isUsed?.[at / size] === 0) continue;
      list.push(degrees(a, b, at, at));
      if (size === 4 && a[at + 3] !== b[at + 3]) ++outcome.wrongSigns;
    }
    list.sort((x, y) => x - y);
    outcome[name] = { most: list[Math.ceil(0.99 * list.length) - 1], worst: list.at(-1) };
  }
  return outcome;
}
