// SPDX-License-Identifier: MIT
// Figure 4: interpolation of T across a triangle, and its effect on the lighting.

import { Figure, Numbers, type Plane } from "./figure";
import { grayOf, picture, texelAt } from "./plate";
import { add, angle, dot, length, scale, text, tuple, unit, type Vec2, type Vec3 } from "./vector";

const kArrows: Plane = { origin: [30, 265], unit: 240 };
const kLit: Plane = { origin: [330, 265], unit: 240 };
const kPixels = 200, kArrow = 0.2;
const kCorners: readonly [Vec2, Vec2, Vec2] = [[0.08, 0.12], [0.92, 0.12], [0.5, 0.88]];
const kLight = unit([-0.5, 0.6, 0.6]);
const kNormal: Vec3 = [0, 0, 1];

type Weights = readonly [number, number, number];

/** Returns the barycentric weights of a point. */
function weightsAt([x, y]: Vec2): Weights {
  const [[ax, ay], [bx, by], [cx, cy]] = kCorners;
  const whole = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
  const a = ((bx - x) * (cy - y) - (cx - x) * (by - y)) / whole, b = ((cx - x) * (ay - y) - (ax - x) * (cy - y)) / whole;
  return [a, b, 1 - a - b];
}

export function showAcross(host: HTMLElement, rows: HTMLElement, perPixel: HTMLInputElement) {
  const figure = new Figure(host, 600, 305, "A triangle with a tangent at each corner, and the same triangle lit");
  const numbers = new Numbers(rows);
  const directions = [0, 1.35, -0.6];  // angles of T at the corners, in radians
  let place: Vec2 = [0.56, 0.4];

  const cornerTangent = (i: number): Vec3 => [Math.cos(directions[i]!), Math.sin(directions[i]!), 0];
  const tangentAt = (w: Weights): Vec3 => add(add(scale(w[0], cornerTangent(0)), scale(w[1], cornerTangent(1))), scale(w[2], cornerTangent(2)));
  /** Returns the shading normal of a texel, with B = cross(N, T). */
  const shade = (n: Vec3, tangent: Vec3): Vec3 => unit(add(add(scale(n[0], tangent), scale(n[1], [-tangent[1], tangent[0], 0])), scale(n[2], kNormal)));
  const texel = ([x, y]: Vec2): Vec3 => texelAt(2 * x + 0.1, 2 * y + 0.1);
  const used = (tangent: Vec3): Vec3 => (perPixel.checked ? unit(tangent) : tangent);

  figure.show(() => {
    const side = kLit.unit;
    figure.add("image", { x: kLit.origin[0], y: kLit.origin[1] - side, width: side, height: side, href: picture(kPixels, kPixels, (x, y) => {
      const w = weightsAt([x, y]);
      return Math.min(...w) < 0 ? null : Array<number>(3).fill(grayOf(dot(shade(texel([x, y]), used(tangentAt(w))), kLight)));
    }) });
    figure.polygon(kArrows, kCorners, "face front");
    figure.polygon(kLit, kCorners, "face outline");
    figure.word(kArrows, [0.5, -0.11], "T, drawn with its length");
    figure.word(kLit, [0.5, -0.11], "lit with it");
    for (let i = 1; i < 8; ++i) {
      for (let j = 1; i + j < 8; ++j) {
        const w: Weights = [i / 8, j / 8, 1 - (i + j) / 8], t = used(tangentAt(w));
        const at: Vec2 = [0, 1].map((k) => w[0] * kCorners[0][k]! + w[1] * kCorners[1][k]! + w[2] * kCorners[2][k]!) as unknown as Vec2;
        figure.arrow(kArrows, at, [0.09 * t[0], 0.09 * t[1]], "tangent faint thin");
      }
    }
    kCorners.forEach((corner, i) => figure.arrow(kArrows, corner, scale(kArrow, cornerTangent(i)).slice(0, 2) as unknown as Vec2, "tangent"));
    const w = weightsAt(place), interpolated = tangentAt(w), t = used(interpolated);
    figure.arrow(kArrows, place, [kArrow * t[0], kArrow * t[1]], "tangent", "T");
    figure.arrow(kArrows, place, [-kArrow * t[1], kArrow * t[0]], "bitangent", "B");
    numbers.set("weights of the corners", tuple(w));
    numbers.set("interpolated T", `\u03a3 weight \u00b7 T of the corner = ${tuple(interpolated.slice(0, 2))}, of length ${text(length(interpolated))}`);
    const n = texel(place), one = shade(n, interpolated), other = shade(n, unit(interpolated));
    numbers.set("texel", tuple(n));
    numbers.set("shaded normal", `${tuple(shade(n, t))}; normalized at each pixel or not: ${text(angle(one, other), 1)} degrees between the two`);
    numbers.set("meaning", length(interpolated) > 0.95 ? "the corners agree here, so the difference is negligible"
      : "if corners differ, T is shorter and the relief flatter. MikkTSpace uses T unchanged, three.js and Khronos' viewer normalize it, and glTF does not specify. A map that was baked for one of them shows faint edges in the other");
  });
  figure.handle(kArrows, "shaded point", () => place, (to) => {
    const w = weightsAt(to), least = 0.02;
    if (Math.min(...w) > least) place = to;
  }, [[0, 1], [0, 1]]);
  kCorners.forEach((corner, i) => figure.handle(kArrows, `T at corner ${i}`, () => [corner[0] + kArrow * Math.cos(directions[i]!), corner[1] + kArrow * Math.sin(directions[i]!)],
    (to) => (directions[i] = Math.atan2(to[1] - corner[1], to[0] - corner[0])), [[-0.15, 1.15], [-0.1, 1.1]], "tangent"));
  perPixel.addEventListener("change", () => figure.redraw());
  figure.redraw();
}
