// SPDX-License-Identifier: MIT
// Figure 6: a seam of the UV map, where one vertex cannot hold both tangents.

import { generateTangents } from "tspace";
import { Figure, Numbers, type Plane } from "./figure";
import { grayOf, picture, texelAt } from "./plate";
import { add, angle, dot, length, scale, text, tuple, unit, type Vec2, type Vec3 } from "./vector";

const kModel: Plane = { origin: [16, 230], unit: 200 };  // two squares, from (0, 0) to (2, 1)
const kUv: Plane = { origin: [520, 120], unit: 60 };
const kLight = unit([-0.5, 0.6, 0.6]);
const kHeight = 150;

export function showSeam(host: HTMLElement, rows: HTMLElement, shared: HTMLInputElement) {
  const figure = new Figure(host, 600, 275, "Two squares that share an edge, and the rotation of the texture on the right one");
  const numbers = new Numbers(rows);
  let turn: Vec2 = [0.2, 1];  // direction of u on the right square

  figure.show(() => {
    const a = Math.atan2(turn[1], turn[0]), c = Math.cos(a), s = Math.sin(a);
    // Returns the UV of (x, y) on the right square, where the texture is rotated about its center.
    const turned = ([x, y]: Vec2): Vec2 => [c * (x - 1.5) + s * (y - 0.5) + 0.5, c * (y - 0.5) - s * (x - 1.5) + 0.5];
    const corners: Vec2[] = [[0, 0], [1, 0], [1, 1], [0, 1], [1, 0], [2, 0], [2, 1], [1, 1]];
    const uvs = corners.map((corner, i) => (i < 4 ? corner : turned(corner)));
    const made = generateTangents(
      { positions: new Float32Array(corners.flatMap(([x, y]) => [x, y, 0])), normals: new Float32Array(corners.flatMap(() => [0, 0, 1])),
        uvs: new Float32Array(uvs.flat()), faceSizes: new Uint32Array([4, 4]) },
      { method: "mikktspace", convention: "opengl" });
    const of = (corner: number): Vec3 => [made[4 * corner]!, made[4 * corner + 1]!, made[4 * corner + 2]!];
    const left = of(1), right = of(4), mean = scale(0.5, add(left, right));
    const one = length(mean) > 1e-3 ? unit(mean) : ([0, 0, 0] as const);
    const atSeam = (isRight: boolean): Vec3 => (shared.checked ? one : isRight ? right : left);

    const lit = picture(2 * kHeight, kHeight, (px, py) => {
      const x = 2 * px, isRight = x > 1, away = Math.abs(x - 1);
      const t = add(scale(away, isRight ? right : left), scale(1 - away, atSeam(isRight))), n = texelAt(...(isRight ? turned([x, py]) : ([x, py] as const)));
      return Array<number>(3).fill(grayOf(dot(unit(add(add(scale(n[0], t), scale(n[1], [-t[1], t[0], 0])), [0, 0, n[2]])), kLight)));
    });
    figure.add("image", { x: kModel.origin[0], y: kModel.origin[1] - kModel.unit, width: 2 * kModel.unit, height: kModel.unit, href: lit, preserveAspectRatio: "none" });
    figure.line(kModel, [1, -0.04], [1, 1.04], "seam");
    for (const y of [0.12, 0.5, 0.88]) {
      for (const isRight of [false, true]) {
        const t = atSeam(isRight);
        figure.arrow(kModel, [isRight ? 1.04 : 0.82, y], [0.14 * t[0], 0.14 * t[1]], "tangent over");
      }
    }
    figure.word(kModel, [1, -0.13], "the seam, with T of both sides");
    const [cx, cy] = Figure.at(kUv, [0, 0]);
    figure.add("circle", { class: "face", cx, cy, r: kUv.unit });
    figure.arrow(kUv, [0, 0], [c, s], "tangent");
    figure.word(kUv, [0, -1.35], "u on the right");

    const degrees = angle(left, right);
    numbers.set("T at the seam", `left ${tuple(left.slice(0, 2))}, right ${tuple(right.slice(0, 2))}: ${text(degrees, 0)} degrees apart`);
    numbers.set("vertices", shared.checked ? "6: the two seam vertices are shared, with one T each" : "8: the two seam vertices exist twice, with separate UVs and tangents");
    numbers.set("stored T", shared.checked ? (one[0] === 0 && one[1] === 0 ? "none: the two cancel" : `the mean ${tuple(one.slice(0, 2))}, ${text(degrees / 2, 0)} degrees from both`) : "that of each side");
    numbers.set("meaning", degrees < 1 ? "the texture is continuous across the edge: no split is needed"
      : shared.checked ? "the lighting is wrong beside the seam, most at the seam itself, and correct far from it: the visible band on models whose exporter averaged tangents"
      : "a vertex consists of position, normal, UV and tangent: where one of them is discontinuous, two vertices are needed. So models have more vertices than points");
  });
  figure.handle(kUv, "direction of u on the right square", () => {
    const size = Math.hypot(...turn) || 1;
    return [turn[0] / size, turn[1] / size];
  }, (to) => (turn = Math.hypot(...to) > 0.05 ? to : turn), [[-1, 1], [-1, 1]], "tangent");
  shared.addEventListener("change", () => figure.redraw());
  figure.redraw();
}
