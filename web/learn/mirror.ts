// SPDX-License-Identifier: MIT
// Figure 5: a mirrored texture, and the purpose of the sign.

import { generateTangents } from "tspace";
import { Figure, Numbers, type Plane } from "./figure";
import { text, type Vec2 } from "./vector";

const kModel: Plane = { origin: [300, 130], unit: 170 };
const kTexture: Plane = { origin: [300, 285], unit: 170 };

/** The letter F, because it differs from its mirror image. */
const kLetter: Vec2[] = ([[0.25, 0.2], [0.37, 0.2], [0.37, 0.45], [0.6, 0.45], [0.6, 0.56], [0.37, 0.56], [0.37, 0.7], [0.68, 0.7], [0.68, 0.82], [0.25, 0.82]] as const)
  .map(([u, v]): Vec2 => [0.75 * u - 0.12, 0.75 * v + 0.3]);
const kBump: Vec2 = [0.62, 0.36];

export function showMirror(host: HTMLElement, rows: HTMLElement, dropped: HTMLInputElement) {
  const figure = new Figure(host, 600, 320, "Two squares that share an edge; the left one may be mirrored");
  const numbers = new Numbers(rows);
  let left = 1;  // u at the left end; u is 0 at the seam and 1 at the right end
  const bottom = -0.5, top = 0.5;

  /** Draws a hemisphere on a square, lit from the top according to the sign. */
  const bump = (middle: Vec2, sign: number, name: string) => {
    const [cx, cy] = Figure.at(kModel, middle);
    const gradient = figure.add("linearGradient", { id: name, x1: 0, x2: 0, y1: sign > 0 ? 0 : 1, y2: sign > 0 ? 1 : 0 });
    for (const [offset, color] of [[0, "#fff7d6"], [0.5, "#8d8d99"], [1, "#16161d"]] as const) {
      const stop = document.createElementNS("http://www.w3.org/2000/svg", "stop");
      stop.setAttribute("offset", String(offset));
      stop.setAttribute("stop-color", color);
      gradient.append(stop);
    }
    figure.add("circle", { cx, cy, r: 38, fill: `url(#${name})` });
  };

  figure.show(() => {
    // Vertices of the left square, then of the right one. Seam vertices need two UVs unless both are 0, as here.
    const xs = [-1, 0, 0, -1, 0, 1, 1, 0], ys = [bottom, bottom, top, top, bottom, bottom, top, top];
    const us = [left, 0, 0, left, 0, 1, 1, 0];
    const made = generateTangents(
      { positions: new Float32Array(xs.flatMap((x, i) => [x, ys[i]!, 0])), normals: new Float32Array(xs.flatMap(() => [0, 0, 1])),
        uvs: new Float32Array(us.flatMap((u, i) => [u, ys[i]! + 0.5])), faceSizes: new Uint32Array([4, 4]) },
      { method: "mikktspace", convention: "opengl" });
    [0, 4].forEach((corner, half) => {
      const tangent = made[4 * corner]!, sign = made[4 * corner + 3]!, used = dropped.checked ? 1 : sign;
      const begin = half === 0 ? -1 : 0, size = half === 0 ? left : 1;
      // The texture repeats: left of the seam is either its mirror image or the previous repetition.
      const onModel = ([u, v]: Vec2): Vec2 => [half === 1 ? u : left > 0 ? -u / left : (1 - u) / left, v - 0.5];
      figure.polygon(kModel, [[begin, bottom], [begin + 1, bottom], [begin + 1, top], [begin, top]], `face ${sign < 0 ? "mirrored" : "front"}`);
      const inside = kLetter.map(onModel).map(([x, y]): Vec2 => [Math.max(begin, Math.min(begin + 1, x)), y]);
      if (Math.abs(size) > 0.3) figure.polygon(kModel, inside, "letter");
      const middle = Math.abs(size) > 0.7 ? onModel(kBump) : ([begin + 0.5, kBump[1] - 0.5] as const);
      bump(middle, used * Math.sign(tangent) > 0 ? 1 : -1, `bump${half}`);
      figure.arrow(kModel, middle, [0.3 * tangent, 0], "tangent", "T");
      figure.arrow(kModel, middle, [0, 0.3 * used * tangent], "bitangent", "B");
      numbers.set(half === 0 ? "left half" : "right half",
        `d is ${half === 0 && left > 0 ? "negative: mirrored" : "positive"}; the library: T = (${text(tangent)}, 0, 0), sign = ${sign > 0 ? "+1" : "\u22121"}` +
          `; B = ${dropped.checked ? "+1" : sign > 0 ? "+1" : "\u22121"} \u00b7 cross(N, T) points ${used * tangent > 0 ? "up" : "down"}`);
    });
    figure.line(kModel, [0, bottom - 0.06], [0, top + 0.06], "dashed");
    figure.word(kModel, [0, top + 0.12], "light from the top");
    figure.line(kTexture, [-1, 0], [1, 0], "surface");
    figure.word(kTexture, [0, 0.13], "u at the left end: drag it over the seam (0)");
    numbers.set("meaning", dropped.checked && left > 0
      ? "the sign was dropped, so bumps on the left half look like dents, as on one half of a symmetric character"
      : left > 0 ? "T is reversed on the mirrored half; the sign keeps B correct, and both bumps are lit from the top" : "the texture is continuous across the seam: both signs are +1");
  });
  figure.handle(kTexture, "u at the left end", () => [left, 0], (to) => (left = Math.abs(to[0]) < 0.01 ? -0.02 * Math.sign(left) : to[0]), [[-1, 1], [0, 0]]);
  dropped.addEventListener("change", () => figure.redraw());
  figure.redraw();
}
