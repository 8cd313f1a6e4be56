// SPDX-License-Identifier: MIT

/** Returns a part of a torus with 2 * n * n triangles. `turn`: its angle in radians, in both directions. */
export function grid(n, turn = 6) {
  const positions = [], normals = [], uvs = [], indices = [];
  for (let j = 0; j <= n; ++j) {
    for (let i = 0; i <= n; ++i) {
      const [u, v] = [i / n, j / n], [a, b] = [turn * u, turn * v];
      positions.push((2 + Math.cos(b)) * Math.cos(a), (2 + Math.cos(b)) * Math.sin(a), Math.sin(b));
      normals.push(Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b));
      uvs.push(4 * u, 2 * v);
      const k = j * (n + 1) + i;
      if (i < n && j < n) indices.push(k, k + 1, k + n + 2, k, k + n + 2, k + n + 1);
    }
  }
  return {
    positions: new Float32Array(positions), normals: new Float32Array(normals), uvs: new Float32Array(uvs),
    indices: new Uint32Array(indices),
  };
}

/** Returns random integers from 0 to `most` - 1, the same in each run (Marsaglia's xorshift). */
function numbersFrom(seed) {
  let state = seed;
  return (most) => {
    for (const shift of [13, -17, 5]) state ^= shift > 0 ? state << shift : state >>> -shift;
    return (state >>> 0) % most;
  };
}

/**
 * Returns positions, normals and UVs of unindexed triangles between random points. The points are few, so some
 * triangles share edges, are degenerate, are mirrored in UV space, or have no area there.
 */
function soup(triangles, points, random) {
  const list = Array.from({ length: points }, () => ({
    position: [random(8), random(8), random(4)], normal: [[0, 0, 1], [0, 0, 1], [0.6, 0, 0.8], [0, 1, 0]][random(4)], uv: [random(6), random(6)],
  }));
  const corners = Array.from({ length: 3 * triangles }, () => list[random(points)]);
  return ["position", "normal", "uv"].map((name) => Float32Array.from(corners.flatMap((corner) => corner[name])));
}

/**
 * Returns a part of a torus with unindexed triangles in random order. Every seventh one is reversed, every fiftieth one
 * degenerate.
 */
function shuffledSheet(n, random) {
  const { positions, normals, uvs, indices } = grid(n);
  const order = Array.from({ length: indices.length / 3 }, (_, t) => t);
  for (let i = order.length - 1; i > 0; --i) {
    const j = random(i + 1);
    [order[i], order[j]] = [order[j], order[i]];
  }
  const corners = order.flatMap((t, i) => {
    const [a, b, c] = indices.subarray(3 * t, 3 * t + 3);
    return i % 50 === 0 ? [a, a, c] : i % 7 === 0 ? [a, c, b] : [a, b, c];
  });
  const perCorner = (array, size) => Float32Array.from(corners.flatMap((v) => [...array.subarray(size * v, size * v + size)]));
  return [perCorner(positions, 3), perCorner(normals, 3), perCorner(uvs, 2)];
}

/** Returns random meshes { name, arrays }: small and larger soups, and sheets of up to 5,000 triangles. */
export function randomMeshes() {
  const meshes = [];
  for (let seed = 1; seed <= 400; ++seed) {
    const random = numbersFrom(1000003 * seed), triangles = 1 + random(seed % 10 === 0 ? 400 : 12);
    meshes.push({ name: `soup ${seed}`, arrays: soup(triangles, 3 + random(9), random) });
  }
  for (const n of [3, 12, 30, 50]) meshes.push({ name: `sheet ${n}`, arrays: shuffledSheet(n, numbersFrom(7 * n)) });
  return meshes;
}
