// SPDX-License-Identifier: MIT
// Figure 1: a normal map, and its lighting if T does not follow u or green points down.

import { Figure, Numbers, type Plane } from "./figure";
import { colorOf, grayOf, picture, texelAt } from "./plate";
import { add, dot, scale, text, tuple, unit, type Vec2, type Vec3 } from "./vector";

const kSize = 200;
const kMap: Plane = { origin: [12, 222], unit: 200 };
const kLit: Plane = { origin: [228, 222], unit: 200 };
const kLight: Plane = { origin: [520, 62], unit: 50 };
const kFrame: Plane = { origin: [520, 222], unit: 50 };

export function showRelief(host: HTMLElement, rows: HTMLElement, green: HTMLInputElement) {
  const figure = new Figure(host, 600, 305, "A normal map, and the same map lit");
  const numbers = new Numbers(rows);
  let light: Vec2 = [-0.45, 0.6], turn: Vec2 = [1, 0], place: Vec2 = [0.3, 0.3];
  const map = () => picture(kSize, kSize, (u, v) => {
    const [x, y, z] = texelAt(u, v);
    return colorOf([x, green.checked ? -y : y, z]);
  });
  let stored = map();
  const pictureAt = ({ origin: [x, y], unit: side }: Plane, href: string) => figure.add("image", { x, y: y - side, width: side, height: side, href });

  figure.show(() => {
    const a = Math.atan2(turn[1], turn[0]), tangent: Vec3 = [Math.cos(a), Math.sin(a), 0], bitangent: Vec3 = [-Math.sin(a), Math.cos(a), 0];
    const size = Math.hypot(...light), l = unit([light[0], light[1], Math.sqrt(Math.max(0.05, 1 - Math.min(1, size) ** 2))]);
    const turned = (n: Vec3): Vec3 => add(add(scale(n[0], tangent), scale(green.checked ? -n[1] : n[1], bitangent)), [0, 0, n[2]]);
    pictureAt(kMap, stored);
    pictureAt(kLit, picture(kSize, kSize, (u, v) => Array<number>(3).fill(grayOf(dot(turned(texelAt(u, v)), l)))));
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

    const n = texelAt(...place), seen: Vec3 = [n[0], green.checked ? -n[1] : n[1], n[2]], color = colorOf(seen);
    numbers.set("a texel", `rgb(${color.join(", ")}), each as 2 c / 255 \u2212 1: (x, y, z) = ${tuple(seen)}`);
    numbers.set("in space", `x T + y B + z N = ${tuple(turned(n))}`);
    numbers.set("brightness", `its dot product with the light ${tuple(l)} is ${text(Math.max(0, dot(turned(n), l)), 2)}`);
    const degrees = Math.round((a * 180) / Math.PI);
    numbers.set("effect", green.checked && Math.abs(degrees) < 10 ? "bolts are lit from below and look like holes"
      : Math.abs(degrees) < 10 ? "bolts stand out and the groove is deep: T points along increasing u"
      : Math.abs(degrees) > 135 && !green.checked ? "everything is reversed: bolts look like holes"
      : `the light seems to come from a direction that is ${Math.abs(degrees)} degrees off`);
  });
  const disc: [Vec2, Vec2] = [[-1, 1], [-1, 1]];
  figure.handle(kMap, "sampled texel", () => place, (to) => (place = to), [[0.02, 0.98], [0.02, 0.98]]);
  figure.handle(kLight, "light direction", () => light, (to) => (light = Math.hypot(...to) > 0.95 ? [to[0] / Math.hypot(...to) * 0.95, to[1] / Math.hypot(...to) * 0.95] : to), disc, "light");
  figure.handle(kFrame, "direction of T", () => {
    const size = Math.hypot(...turn) || 1;
    return [turn[0] / size, turn[1] / size];
  }, (to) => (turn = Math.hypot(...to) > 0.05 ? to : turn), disc, "tangent");
  green.addEventListener("change", () => {
    stored = map();
    figure.redraw();
  });
  figure.redraw();
}
