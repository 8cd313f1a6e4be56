// SPDX-License-Identifier: MIT

/** A piece of a torus with a UV seam, n * n * 2 triangles. */
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
