// SPDX-License-Identifier: MIT
// Figure 9: T and N of a surface that its node scales.

import { Figure, Numbers, type Plane } from "./figure";
import { angle, length, text, tuple, unit, type Vec2, type Vec3 } from "./vector";

const kModel: Plane = { origin: [145, 150], unit: 70 };
const kScaled: Plane = { origin: [405, 150], unit: 70 };
const kArrow = 0.62, kSteps = 72;

export function showScale(host: HTMLElement, rows: HTMLElement) {
  const figure = new Figure(host, 600, 300, "T and N at a point of a circle, before and after a scale");
  const numbers = new Numbers(rows);
  let factors: Vec2 = [1.6, 0.6], turn = 0.75;  // direction of N on the circle, in radians

  figure.show(() => {
    const [sx, sy] = factors, matrix = ([x, y]: Vec3): Vec3 => [sx * x, sy * y, 0];
    const n: Vec3 = [Math.cos(turn), Math.sin(turn), 0], t: Vec3 = [n[1], -n[0], 0];
    const moved = matrix(t), wrong = matrix(n), right: Vec3 = [n[0] / sx, n[1] / sy, 0], place = matrix(n);
    const circle = Array.from({ length: kSteps }, (_, i): Vec2 => [Math.cos((2 * Math.PI * i) / kSteps), Math.sin((2 * Math.PI * i) / kSteps)]);
    figure.polygon(kModel, circle, "face front");
    figure.polygon(kScaled, circle.map(([x, y]): Vec2 => [sx * x, sy * y]), `face ${sx * sy < 0 ? "mirrored" : "front"}`);
    figure.word(kModel, [0, -1.95], "the mesh");
    figure.word(kScaled, [0, -1.95], "scaled by its node");
    const arrow = (plane: Plane, at: Vec3, v: Vec3, kind: string, word: string) => {
      const [x, y] = unit(v);
      figure.arrow(plane, [at[0], at[1]], [kArrow * x, kArrow * y], kind, word);
    };
    arrow(kModel, n, t, "tangent", "T");
    arrow(kModel, n, n, "normal", "N");
    arrow(kScaled, place, moved, "tangent", "T");
    // If both normals are nearly equal, only one arrow and one letter are drawn.
    if (angle(wrong, right) > 12) arrow(kScaled, place, wrong, "part", "M N");
    arrow(kScaled, place, right, "normal", "N");

    const steeper = length(moved) / length(right);
    numbers.set("the matrix", `M = diag(${text(sx)}, ${text(sy)}), the third axis is unchanged; determinant ${text(sx * sy)}`);
    numbers.set("T", `M T = ${tuple(moved.slice(0, 2))}, of length ${text(length(moved))}`);
    numbers.set("N by M", `${tuple(wrong.slice(0, 2))}, at ${text(angle(wrong, moved), 1)} degrees to the surface`);
    numbers.set("N by the inverse transpose", `${tuple(right.slice(0, 2))}, of length ${text(length(right))}, at ${text(angle(right, moved), 1)} degrees to the surface`);
    numbers.set("without normalizing", `|M T| / |M\u207b\u1d40N| = ${text(steeper)}: relief along T is drawn ${text(steeper)} times as steep`);
    numbers.set("meaning", sx * sy < 0 ? "the node mirrors: cross(N, T) is reversed, so B = \u2212sign \u00b7 cross(N, T)" : "the node does not mirror: B = sign \u00b7 cross(N, T)");
  });
  figure.handle(kScaled, "scale of the node", () => [factors[0], -factors[1]], ([x, y]) => {
    const least = 0.3;
    factors = [Math.abs(x) < least ? (x < factors[0] && factors[0] > 0 ? -least : least) : x, Math.max(least, -y)];
  }, [[-1.8, 1.8], [-1.5, -0.3]]);
  figure.handle(kModel, "the point of the circle", () => [Math.cos(turn), Math.sin(turn)], ([x, y]) => (turn = Math.atan2(y, x)), [[-1, 1], [-1, 1]], "normal");
  figure.redraw();
}
