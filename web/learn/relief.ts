// SPDX-License-Identifier: MIT
// Figure 1: a normal map, and what becomes of its light when T does not follow u, or green points down.

import { Figure, Numbers, type Plane } from "./figure";
import { add, dot, scale, text, tuple, unit, type Vec2, type Vec3 } from "./vector";

const kSize = 200;
const kMap: Plane = { origin: [12, 222], unit: 200 };
const kLit: Plane = { origin: [228, 222], unit: 200 };
const kLight: Plane = { origin: [520, 62], unit: 50 };
const kFrame: Plane = { origin: [520, 222], unit: 50 };

/** How high the painted surface is: a plate with a rim, four bolts and a groove. */
function height(u: number, v: number): number {
  const rise = (x: number, width: number) => Math.min(1, Math.max(0, x / width + 0.5));
  const plate = rise(Math.min(u - 0.1, 0.9 - u, v - 0.1, 0.9 - v), 0.04);
  let at = 0.045 * plate;
  for (const [x, y] of [[0.24, 0.24], [0.76, 0.24], [0.24, 0.76], [0.76, 0.76]] as const) {
    at += 0.9 * Math.max(0, Math.sqrt(Math.max(0, 0.0075 - (u - x) ** 2 - (v - y) ** 2)) - 0.02);
  }
  return at - 0.05 * Math.max(0, 1 - Math.abs(Math.hypot(u - 0.5, v - 0.5) - 0.2) / 0.035);
}

/** The texel there: the normal of that height, along u, v and out of the surface. */
function texelAt(u: number, v: number): Vec3 {
  const step = 0.004, slope = (a: number, b: number) => (a - b) / (2 * step);
  return unit([-slope(height(u + step, v), height(u - step, v)), -slope(height(u, v + step), height(u, v - step)), 1]);
}

const colourOf = (n: Vec3): number[] => n.map((x) => Math.round(255 * (0.5 * x + 0.5)));

/** Pixels from the top row down as the address of an image. */
function picture(at: (u: number, v: number) => readonly number[]): string {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = kSize;
  const pixels = canvas.getContext("2d");
  if (!pixels) return "";
  const image = pixels.createImageData(kSize, kSize);
  for (let i = 0; i < kSize * kSize; ++i) {
    image.data.set([...at(((i % kSize) + 0.5) / kSize, 1 - (Math.floor(i / kSize) + 0.5) / kSize), 255], 4 * i);
  }
  pixels.putImageData(image, 0, 0);
  return canvas.toDataURL();
}

export function showRelief(host: HTMLElement, rows: HTMLElement, green: HTMLInputElement) {
  const figure = new Figure(host, 600, 305, "A normal map, and the same map lit");
  const numbers = new Numbers(rows);
  const texels = Array.from({ length: kSize * kSize }, (_, i) => texelAt(((i % kSize) + 0.5) / kSize, 1 - (Math.floor(i / kSize) + 0.5) / kSize));
  const texel = (u: number, v: number): Vec3 => texels[Math.min(kSize - 1, Math.floor((1 - v) * kSize)) * kSize + Math.min(kSize - 1, Math.floor(u * kSize))]!;
  let light: Vec2 = [-0.45, 0.6], turn: Vec2 = [1, 0], place: Vec2 = [0.3, 0.3];
  const map = () => picture((u, v) => {
    const [x, y, z] = texel(u, v);
    return colourOf([x, green.checked ? -y : y, z]);
  });
  let stored = map();
  const pictureAt = ({ origin: [x, y], unit: side }: Plane, href: string) => figure.add("image", { x, y: y - side, width: side, height: side, href });

  figure.show(() => {
    const a = Math.atan2(turn[1], turn[0]), tangent: Vec3 = [Math.cos(a), Math.sin(a), 0], bitangent: Vec3 = [-Math.sin(a), Math.cos(a), 0];
    const size = Math.hypot(...light), l = unit([light[0], light[1], Math.sqrt(Math.max(0.05, 1 - Math.min(1, size) ** 2))]);
    const turned = (n: Vec3): Vec3 => add(add(scale(n[0], tangent), scale(green.checked ? -n[1] : n[1], bitangent)), [0, 0, n[2]]);
    pictureAt(kMap, stored);
    pictureAt(kLit, picture((u, v) => {
      const grey = Math.round(255 * Math.sqrt(0.03 + 0.92 * Math.max(0, dot(turned(texel(u, v)), l))));
      return [grey, grey, grey];
    }));
    figure.word(kMap, [0.5, -0.13], "the map, v up");
    figure.word(kLit, [0.5, -0.13], "lit with T, B and N");
    for (const [plane, words] of [[kLight, "light"], [kFrame, "turn T"]] as const) {
      const [cx, cy] = Figure.at(plane, [0, 0]);
      figure.add("circle", { class: "face", cx, cy, r: plane.unit });
      figure.word(plane, [0, -1.32], words);
    }
    figure.arrow(kLight, [0, 0], [l[0], l[1]], "light");
    figure.arrow(kFrame, [0, 0], [tangent[0], tangent[1]], "tangent");
    figure.arrow(kFrame, [0, 0], [0.7 * bitangent[0], 0.7 * bitangent[1]], "bitangent", "B");

    const n = texel(...place), seen: Vec3 = [n[0], green.checked ? -n[1] : n[1], n[2]], colour = colourOf(seen);
    numbers.set("a texel", `rgb(${colour.join(", ")}), each as 2 c / 255 \u2212 1: (x, y, z) = ${tuple(seen)}`);
    numbers.set("in space", `x T + y B + z N = ${tuple(turned(n))}`);
    numbers.set("brightness", `its dot product with the light ${tuple(l)} is ${text(Math.max(0, dot(turned(n), l)), 2)}`);
    const degrees = Math.round((a * 180) / Math.PI);
    numbers.set("what one sees", green.checked && Math.abs(degrees) < 10 ? "up and down are exchanged: bolts are lit from below, as holes would be"
      : Math.abs(degrees) < 10 ? "bolts stand out and the groove lies deep: T points where u grows"
      : Math.abs(degrees) > 135 && !green.checked ? "all is turned round: bolts are holes"
      : `light seems to come from ${Math.abs(degrees)} degrees beside where it is`);
  });
  const disc: [Vec2, Vec2] = [[-1, 1], [-1, 1]];
  figure.handle(kMap, "the texel that is read", () => place, (to) => (place = to), [[0.02, 0.98], [0.02, 0.98]]);
  figure.handle(kLight, "where the light of the map is", () => light, (to) => (light = Math.hypot(...to) > 0.95 ? [to[0] / Math.hypot(...to) * 0.95, to[1] / Math.hypot(...to) * 0.95] : to), disc, "light");
  figure.handle(kFrame, "where T points", () => {
    const size = Math.hypot(...turn) || 1;
    return [turn[0] / size, turn[1] / size];
  }, (to) => (turn = Math.hypot(...to) > 0.05 ? to : turn), disc, "tangent");
  green.addEventListener("change", () => {
    stored = map();
    figure.redraw();
  });
  figure.redraw();
}
