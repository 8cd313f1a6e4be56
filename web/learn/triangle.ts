// SPDX-License-Identifier: MIT
// Figure 2: T, B and the determinant of one triangle.

import { generateTangents } from "tspace";
import { Figure, Matrix, Numbers, type Plane } from "./figure";
import { derivatives, text, tuple, type Triangle, type Vec2, type Vec3 } from "./vector";

const kUv: Plane = { origin: [30, 250], unit: 220 };
const kSpace: Plane = { origin: [330, 250], unit: 220 };

export function showTriangle(host: HTMLElement, rows: HTMLElement, system: HTMLElement) {
  const figure = new Figure(host, 600, 280, "One triangle, in the texture and in space");
  const numbers = new Numbers(rows);
  const uvs: Vec2[] = [[0.15, 0.2], [0.85, 0.25], [0.35, 0.85]];
  const points: Vec2[] = [[0.1, 0.15], [0.95, 0.3], [0.4, 0.9]];
  const names = ["P\u2080", "P\u2081", "P\u2082"];

  const triangle = (): Triangle => ({
    positions: points.map(([x, y]): Vec3 => [x, y, 0]) as unknown as Triangle["positions"],
    uvs: uvs as unknown as Triangle["uvs"],
  });

  /** Moves the corner at the end of an edge; positions are limited to the drawing. */
  const edit = (corners: Vec2[]) => (row: number, column: number, value: number) => {
    const to = [...corners[1 + row]!] as [number, number];
    to[column] = Math.min(1, Math.max(0, corners[0]![column]! + value));
    corners[1 + row] = to;
    figure.redraw();
  };
  const inTexture = new Matrix(2, 2, "edges in the texture", edit(uvs)), slopes = new Matrix(2, 2, "T and B"), inSpace = new Matrix(2, 2, "edges in space", edit(points));
  system.append(inTexture.element, slopes.element, " = ", inSpace.element);

  /** Draws grid lines of the texture on the triangle. */
  const drawGrid = (tangent: Vec3, bitangent: Vec3) => {
    const clip = figure.add("clipPath", { id: "inside" });
    clip.append(figure.polygon(kSpace, points, ""));
    const place = ([u, v]: Vec2): Vec2 => [
      points[0]![0] + (u - uvs[0]![0]) * tangent[0] + (v - uvs[0]![1]) * bitangent[0],
      points[0]![1] + (u - uvs[0]![0]) * tangent[1] + (v - uvs[0]![1]) * bitangent[1],
    ];
    for (let i = 0; i <= 8; ++i) {
      for (const [from, to] of [[[i / 8, 0], [i / 8, 1]], [[0, i / 8], [1, i / 8]]] as [Vec2, Vec2][]) {
        figure.line(kUv, from, to, "grid");
        if (tangent.some((x) => x !== 0)) figure.line(kSpace, place(from), place(to), "grid").setAttribute("clip-path", "url(#inside)");
      }
    }
  };

  figure.show(() => {
    const d = derivatives(triangle());
    const side = d.determinant < 0 ? "mirrored" : "front";
    figure.polygon(kUv, uvs, `face ${side}`);
    figure.polygon(kSpace, points, `face ${side}`);
    drawGrid(d.tangent, d.bitangent);
    figure.word(kUv, [0.5, -0.1], "texture, v up");
    figure.word(kSpace, [0.5, -0.1], "object space, N toward you");
    uvs.forEach((uv, i) => figure.word(kUv, [uv[0], uv[1] + 0.1], names[i]!));
    points.forEach((point, i) => figure.word(kSpace, [point[0], point[1] + 0.1], names[i]!));

    const positions = new Float32Array(points.flatMap(([x, y]) => [x, y, 0]));
    const normals = new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1]);
    const made = generateTangents({ positions, normals, uvs: new Float32Array(uvs.flat()) }, { method: "flat", convention: "opengl" });
    const [x, y, , sign] = [made[0]!, made[1]!, made[2]!, made[3]!];
    const middle: Vec2 = [(points[0]![0] + points[1]![0] + points[2]![0]) / 3, (points[0]![1] + points[1]![1] + points[2]![1]) / 3];
    if (d.determinant !== 0) {
      figure.arrow(kSpace, middle, [0.23 * x, 0.23 * y], "tangent", "T");
      // sign * cross(N, T), with N = (0, 0, 1)
      figure.arrow(kSpace, middle, [-0.23 * sign * y, 0.23 * sign * x], "bitangent", "B");
    }

    const isFlat = Math.abs(d.determinant) < 1e-9;
    inTexture.show([[d.s1, d.t1], [d.s2, d.t2]], text);
    inSpace.show([d.e1, d.e2], text);
    slopes.show([d.tangent, d.bitangent], (value) => (isFlat ? "?" : text(value)));
    numbers.set("edges in the texture", `(s\u2081, t\u2081) = ${tuple([d.s1, d.t1])}   (s\u2082, t\u2082) = ${tuple([d.s2, d.t2])}`);
    numbers.set("determinant", `d = s\u2081 t\u2082 \u2212 s\u2082 t\u2081 = ${text(d.determinant, 3)}`);
    numbers.set("dP/du", `(t\u2082 E\u2081 \u2212 t\u2081 E\u2082) / d = ${isFlat ? "undefined (division by 0)" : tuple(d.tangent.slice(0, 2))}`);
    numbers.set("dP/dv", `(s\u2081 E\u2082 \u2212 s\u2082 E\u2081) / d = ${isFlat ? "undefined (division by 0)" : tuple(d.bitangent.slice(0, 2))}`);
    numbers.set("the library", `T = ${tuple([x, y, made[2]!])}   sign = ${sign > 0 ? "+1" : "\u22121"}`);
    numbers.set("meaning", Math.abs(d.determinant) < 1e-3
      ? "the triangle has (nearly) no UV area: u and v do not define two directions on it, so dP/du does not exist"
      : d.determinant < 0 ? "the texture is mirrored on the triangle: B = \u2212cross(N, T)" : "the texture is not mirrored: B = cross(N, T)");
  });
  const bounds: [Vec2, Vec2] = [[0, 1], [0, 1]];
  uvs.forEach((_, i) => figure.handle(kUv, `UV of corner ${i}`, () => uvs[i]!, (to) => (uvs[i] = to), bounds));
  points.forEach((_, i) => figure.handle(kSpace, `position of corner ${i}`, () => points[i]!, (to) => (points[i] = to), bounds));
  figure.redraw();
}
