// SPDX-License-Identifier: MIT
// Meshes of surfaces whose true tangents are known, for figure 8.

import { across, scale, unit, type Vec2, type Vec3 } from "./vector";

/** Vertices and triangles, with the true normal and tangent of each vertex, or of each corner where they differ. */
export interface Surface {
  positions: Vec3[];
  normals: Vec3[];
  uvs: Vec2[];
  indices: number[];
  /** Unit tangent along dP/du, perpendicular to the normal, per corner. */
  truth: Vec3[];
  /** Corners to compare. */
  watched: number[];
  words: string;
  /** Factor by which errors are enlarged in the drawing. */
  enlarged: number;
}

const kSize = 6;

/** Returns two triangles per cell of a grid of columns times rows. */
function gridIndices(columns: number, rows: number): number[] {
  const indices: number[] = [];
  for (let y = 0; y < rows; ++y) {
    for (let x = 0; x < columns; ++x) {
      const a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
      indices.push(...((x + y) % 2 ? [a, b, d, a, d, c] : [a, b, c, b, d, c]));
    }
  }
  return indices;
}

const perCorner = (indices: number[], values: Vec3[]) => indices.map((i) => values[i]!);

/** Returns a curved sheet with a bent texture. The handle moves its middle vertex over the surface. */
export function sheet([mx, my]: Vec2): Surface {
  const made: Surface = { positions: [], normals: [], uvs: [], indices: gridIndices(kSize, kSize), truth: [], watched: [], words: "a curved sheet", enlarged: 5 };
  const truth: Vec3[] = [];
  const bend = 0.35;
  for (let row = 0; row <= kSize; ++row) {
    for (let column = 0; column <= kSize; ++column) {
      const is_middle = row === kSize / 2 && column === kSize / 2;
      const inside = row > 0 && row < kSize && column > 0 && column < kSize;
      const wobble = (seed: number) => (inside ? 0.12 * Math.sin(12.9898 * (column + 1) + 78.233 * (row + seed)) : 0);
      // (u, v) are parameters; the surface is P(u, v).
      const u = is_middle ? mx : (2 * column) / kSize - 1 + wobble(1), v = is_middle ? my : (2 * row) / kSize - 1 + wobble(2);
      const x = u + bend * 0.5 * v * v, y = v - bend * 0.5 * u * u, z = 0.35 - 0.3 * (u * u + v * v) + 0.12 * u * v;
      const du: Vec3 = [1, -bend * u, -0.6 * u + 0.12 * v], dv: Vec3 = [bend * v, 1, -0.6 * v + 0.12 * u];
      const normal = unit([du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2], du[0] * dv[1] - du[1] * dv[0]]);
      made.positions.push([x, y, z]);
      made.normals.push(normal);
      made.uvs.push([u, v]);
      truth.push(unit(across(du, normal)));
    }
  }
  made.truth = perCorner(made.indices, truth);
  made.watched = made.indices.flatMap((vertex, corner) => {
    const row = Math.floor(vertex / (kSize + 1)), column = vertex % (kSize + 1);
    return row > 0 && row < kSize && column > 0 && column < kSize ? [corner] : [];
  });
  return made;
}

/** Returns a box edge with a bevel of one strip. Normals are those of the large faces, as is common in game models. */
export function bevel([lean, width]: Vec2): Surface {
  const made: Surface = { positions: [], normals: [], uvs: [], indices: [], truth: [], watched: [], words: "a beveled edge with a rotated texture", enlarged: 3 };
  const w = 0.08 + 0.3 * Math.abs(width), turn = lean * 1.2;
  const c = Math.cos(turn), s = Math.sin(turn), strip = w * Math.SQRT2;
  // Profile: top, strip, side. `along` is the arc length, which the texture follows.
  const profile = [
    { at: [-1, 0.5], normal: [0, 0, 1], forward: [1, 0, 0], along: -1 }, { at: [0, 0.5], normal: [0, 0, 1], forward: [1, 0, 0], along: 0 },
    { at: [w, 0.5 - w], normal: [1, 0, 0], forward: [0, 0, -1], along: strip }, { at: [w, -0.7], normal: [1, 0, 0], forward: [0, 0, -1], along: strip + 1.2 - w },
  ] as const;
  const truth: Vec3[] = [];
  const rows = 5;
  for (let row = 0; row <= rows; ++row) {
    const y = (2 * row) / rows - 1;
    for (const { at, normal, forward, along } of profile) {
      made.positions.push([at[0], y, at[1]]);
      made.normals.push([...normal]);
      made.uvs.push([c * along + s * y, c * y - s * along]);
      // u = c * arc length + s * y.
      truth.push(unit([c * forward[0], s, c * forward[2]]));
    }
  }
  made.indices = gridIndices(profile.length - 1, rows);
  made.truth = perCorner(made.indices, truth);
  made.watched = made.indices.flatMap((vertex, corner) => (vertex % 4 === 1 || vertex % 4 === 2 ? [corner] : []));
  return made;
}

/** Returns a sheet that shares its vertices along a line where the texture is mirrored. */
export function mirrored([fold]: Vec2): Surface {
  const made = sheet([0, 0]);
  made.words = "a texture that is mirrored along a line of shared vertices";
  made.enlarged = 1;
  const depth = 0.3 * fold;
  made.truth = [];
  made.positions = made.positions.map((_, i) => {
    const u = (2 * (i % (kSize + 1))) / kSize - 1, v = (2 * Math.floor(i / (kSize + 1))) / kSize - 1;
    made.uvs[i] = [Math.abs(u), v];
    made.normals[i] = unit([2 * depth * u, 0, 1]);
    return [u, v, -depth * u * u];
  });
  for (let triangle = 0; triangle < made.indices.length; triangle += 3) {
    const corners = made.indices.slice(triangle, triangle + 3);
    const side = corners.some((i) => i % (kSize + 1) > kSize / 2) ? 1 : -1;
    for (const i of corners) {
      const u = (2 * (i % (kSize + 1))) / kSize - 1;
      made.truth.push(scale(side, unit([1, 0, -2 * depth * u])));
    }
  }
  made.watched = made.indices.flatMap((vertex, corner) => (vertex % (kSize + 1) === kSize / 2 ? [corner] : []));
  return made;
}
