// SPDX-License-Identifier: MIT
// Figure 7: the light in tangent space, and its dot product with the texel.

import { generateTangents } from "tspace";
import { Figure, Matrix, Numbers, type Plane } from "./figure";
import { add, cross, dot, length, scale, text, tuple, unit, type Vec2, type Vec3 } from "./vector";

const kLight: Plane = { origin: [100, 125], unit: 80 };
const kFrame: Plane = { origin: [300, 125], unit: 80 };
const kTexel: Plane = { origin: [500, 125], unit: 80 };
const kCanvas = 120;

/** Returns the direction in the hemisphere above a point of the unit disc. */
const onHemisphere = ([x, y]: Vec2): Vec3 => {
  const most = 0.98, size = Math.hypot(x, y), k = size > most ? most / size : 1;
  return [k * x, k * y, Math.sqrt(1 - k * k * size * size)];
};

/** Returns M^-1 v by Cramer's rule, from the columns of M; null if M is singular. */
function inverse([a, b, c]: readonly [Vec3, Vec3, Vec3], v: Vec3): Vec3 | null {
  const determinant = dot(a, cross(b, c));
  return Math.abs(determinant) < 1e-6 ? null : scale(1 / determinant, [dot(v, cross(b, c)), dot(v, cross(c, a)), dot(v, cross(a, b))]);
}

/** Returns the normal of a round bump at coordinates from -1 to 1. */
function bump(x: number, y: number): Vec3 {
  const r = Math.hypot(x, y);
  return r < 0.75 ? unit([0.95 * x, 0.95 * y, Math.sqrt(Math.max(0.05, 0.75 - r * r))]) : [0, 0, 1];
}

export function showLight(host: HTMLElement, rows: HTMLElement, canvas: HTMLCanvasElement, product: HTMLElement) {
  const figure = new Figure(host, 600, 260, "The light, a frame, and a texel");
  const numbers = new Numbers(rows);
  let light: Vec2 = [-0.45, 0.6], turn: Vec2 = [0.8, 0.4], texel: Vec2 = [0.3, 0.35];
  let edited: [Vec3, Vec3, Vec3] | undefined;  // T, B and N, if they were typed in
  const frame = new Matrix(3, 3, "T, B and N in columns", (row, column, value) => {
    const columns = (edited ?? shown).map((v): [number, number, number] => [...v]);
    columns[column]![row] = value;
    edited = columns as unknown as [Vec3, Vec3, Vec3];
    figure.redraw();
  });
  let shown: [Vec3, Vec3, Vec3] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const ofTexel = new Matrix(3, 1, "the texel"), ofSpace = new Matrix(3, 1, "the texel in space");
  product.append(frame.element, ofTexel.element, " = ", ofSpace.element);
  canvas.width = canvas.height = kCanvas;
  const pixels = canvas.getContext("2d");

  /** Renders the bump on a surface with this frame: each pixel is the dot product of its texel and the light in tangent space. */
  const shade = (inTangentSpace: Vec3, tangent: Vec3, bitangent: Vec3) => {
    if (!pixels) return;
    const image = pixels.createImageData(kCanvas, kCanvas);
    for (let i = 0; i < kCanvas * kCanvas; ++i) {
      const at: Vec3 = [((i % kCanvas) + 0.5) / kCanvas * 2 - 1, 1 - (Math.floor(i / kCanvas) + 0.5) / kCanvas * 2, 0];
      const lit = Math.max(0, dot(bump(dot(at, tangent), dot(at, bitangent)), inTangentSpace));
      const gray = Math.round(255 * Math.sqrt(0.04 + 0.9 * lit));
      image.data.set([gray, gray, gray, 255], 4 * i);
    }
    pixels.putImageData(image, 0, 0);
  };

  figure.show(() => {
    // A square with a rotated texture: u increases along the handle.
    const angle = Math.atan2(turn[1], turn[0]), c = Math.cos(angle), s = Math.sin(angle);
    const corners: Vec2[] = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
    const made = generateTangents(
      { positions: new Float32Array(corners.flatMap(([x, y]) => [x, y, 0])), normals: new Float32Array(corners.flatMap(() => [0, 0, 1])),
        uvs: new Float32Array(corners.flatMap(([x, y]) => [c * x + s * y, c * y - s * x])), faceSizes: new Uint32Array([4]) },
      { convention: "opengl" });
    const computed: Vec3 = [made[0]!, made[1]!, made[2]!], up: Vec3 = [0, 0, 1];
    shown = edited ?? [computed, scale(made[3]!, cross(up, computed)), up];
    const [tangent, bitangent, normal] = shown;
    const l = onHemisphere(light), n = onHemisphere(texel);
    const inTangentSpace: Vec3 = [dot(tangent, l), dot(bitangent, l), dot(normal, l)];
    const inSpace = add(add(scale(n[0], tangent), scale(n[1], bitangent)), scale(n[2], normal));
    const color = n.map((v) => Math.round(255 * (0.5 * v + 0.5)));

    for (const [plane, words] of [[kLight, "light"], [kFrame, "rotate the texture"], [kTexel, "texel"]] as const) {
      const [cx, cy] = Figure.at(plane, [0, 0]);
      const disc = figure.add("circle", { class: "face", cx, cy, r: plane.unit });
      if (plane === kTexel) disc.setAttribute("style", `fill: rgb(${color.join(",")})`);
      figure.word(plane, [0, -1.25], words);
    }
    figure.arrow(kLight, [0, 0], [l[0], l[1]], "light");
    figure.word(kLight, [0.45 * l[0] + 0.2 * l[1], 0.45 * l[1] - 0.2 * l[0] - 0.05], "L", "light");
    figure.arrow(kFrame, [0, 0], [0.8 * tangent[0], 0.8 * tangent[1]], "tangent");
    // The label is beside the arrow, because the handle is at its end.
    figure.word(kFrame, [0.45 * tangent[0] + 0.17 * tangent[1], 0.45 * tangent[1] - 0.17 * tangent[0] - 0.05], "T", "tangent");
    figure.arrow(kFrame, [0, 0], [0.8 * bitangent[0], 0.8 * bitangent[1]], "bitangent", "B");
    figure.arrow(kFrame, [0, 0], [0.8 * inSpace[0], 0.8 * inSpace[1]], "normal", "n");
    figure.arrow(kTexel, [0, 0], [n[0], n[1]], "part");
    shade(inTangentSpace, tangent, bitangent);

    const one = dot(inTangentSpace, n), other = dot(l, inSpace);
    frame.show([0, 1, 2].map((row) => shown.map((v) => v[row]!)), text);
    ofTexel.show(n.map((v) => [v]), text);
    ofSpace.show(inSpace.map((v) => [v]), text);
    numbers.set("light in tangent space", `l = (T\u00b7L, B\u00b7L, N\u00b7L) = ${tuple(inTangentSpace)}`);
    numbers.set("texel", `rgb(${color.join(", ")}) = (n + 1) / 2, n = ${tuple(n)}`);
    numbers.set("brightness", `max(0, n\u00b7l) = ${text(Math.max(0, one), 3)}`);
    numbers.set("in object space", `M n = x T + y B + z N = ${tuple(inSpace)}, and its dot product with L is ${text(Math.max(0, other), 3)} as well`);
    const fromSpace = inverse(shown, l);
    const isRight = [length(tangent), length(bitangent), length(normal)].every((size) => Math.abs(size - 1) < 0.02)
      && [dot(tangent, bitangent), dot(bitangent, normal), dot(normal, tangent)].every((cosine) => Math.abs(cosine) < 0.02);
    numbers.set("the matrix", isRight ? "its columns are orthonormal, so its transpose is its inverse, and M n is a unit vector"
      : `its columns are no longer orthonormal. Both results are still equal, but M\u1d40L is not the light in tangent space: ${fromSpace ? `M\u207b\u00b9L = ${tuple(fromSpace)} is` : "M has no inverse"}. M n has length ${text(length(inSpace))}, and a shader that normalizes it computes the brightness ${text(Math.max(0, dot(l, unit(inSpace))), 3)}, not ${text(Math.max(0, one), 3)}`);
  });
  const disc: [Vec2, Vec2] = [[-1, 1], [-1, 1]];
  figure.handle(kLight, "the light", () => onHemisphere(light).slice(0, 2) as unknown as Vec2, (to) => (light = to), disc, "light");
  figure.handle(kFrame, "rotation of the texture", () => {
    const size = Math.hypot(...turn) || 1;
    return [turn[0] / size, turn[1] / size];
  }, (to) => {
    turn = Math.hypot(...to) > 0.05 ? to : turn;
    edited = undefined;
  }, disc);
  figure.handle(kTexel, "the texel", () => onHemisphere(texel).slice(0, 2) as unknown as Vec2, (to) => (texel = to), disc);
  figure.redraw();
}
