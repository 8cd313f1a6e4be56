// SPDX-License-Identifier: MIT
// Figure 3: averaging at a vertex, and Gram-Schmidt orthogonalization.

import { generateTangents } from "tspace";
import { Figure, Numbers, type Plane } from "./figure";
import { across, add, angle, derivatives, dot, length, scale, text, tuple, unit, type Vec2, type Vec3 } from "./vector";

const kTop: Plane = { origin: [150, 145], unit: 120 };
const kSide: Plane = { origin: [450, 190], unit: 110 };
const kRing = 5;

/** Returns the height of the surface near the vertex. */
const height = ([x, y]: Vec2): number => -0.35 * (x * x + y * y);

export function showAverage(host: HTMLElement, rows: HTMLElement) {
  const figure = new Figure(host, 600, 290, "Five triangles around a vertex, from above and from the side");
  const numbers = new Numbers(rows);
  const ring: Vec2[] = Array.from({ length: kRing }, (_, i) => [0.9 * Math.cos(0.3 + (i * 2 * Math.PI) / kRing), 0.9 * Math.sin(0.3 + (i * 2 * Math.PI) / kRing)]);
  // The texture is sheared slightly differently on each triangle, so that their tangents differ.
  const uvs: Vec2[] = [[0, 0], ...ring.map(([x, y], i): Vec2 => [x + 0.3 * Math.sin(2.1 * i), y + 0.3 * Math.cos(2.7 * i)])];
  let lean: Vec2 = [0.3, 0.95];  // end of N in the side view

  const place = (at: Vec2): Vec3 => [at[0], at[1], height(at)];

  figure.show(() => {
    const positions: Vec3[] = [[0, 0, 0], ...ring.map(place)];
    const normal = unit([lean[0], 0, Math.max(lean[1], 0.05)]);
    const indices = new Uint32Array(ring.flatMap((_, i) => [0, 1 + i, 1 + ((i + 1) % kRing)]));
    let sum: Vec3 = [0, 0, 0];
    ring.forEach((point, i) => {
      const next = 1 + ((i + 1) % kRing);
      const d = derivatives({ positions: [positions[0]!, positions[1 + i]!, positions[next]!], uvs: [uvs[0]!, uvs[1 + i]!, uvs[next]!] });
      sum = add(sum, d.tangent);
      const other = ring[next - 1]!;
      figure.polygon(kTop, [[0, 0], point, other], `face ${d.determinant < 0 ? "mirrored" : "front"}`);
      const middle: Vec2 = [(point[0] + other[0]) / 3, (point[1] + other[1]) / 3];
      const own = unit(d.tangent);
      figure.arrow(kTop, middle, [0.25 * own[0], 0.25 * own[1]], "tangent faint");
    });

    const made = generateTangents(
      { positions: new Float32Array(positions.flat()), normals: new Float32Array(positions.flatMap((_, i) => (i === 0 ? normal : [0, 0, 1]))),
        uvs: new Float32Array(uvs.flat()), indices },
      { method: "lengyel", convention: "opengl" });
    const result: Vec3 = [made[0]!, made[1]!, made[2]!];
    figure.arrow(kTop, [0, 0], [0.55 * result[0], 0.55 * result[1]], "tangent", "T");
    figure.word(kTop, [0, -1.1], "dP/du of the faces, and T");

    // The side view is the plane of x and z.
    const mean = scale(1 / kRing, sum), along = scale(dot(mean, normal), normal), flat = across(mean, normal);
    const side = (v: Vec3): Vec2 => [v[0], v[2]];
    const foot: Vec2 = side(along);
    figure.line(kSide, [-1.2 * normal[2], 1.2 * normal[0]], [1.2 * normal[2], -1.2 * normal[0]], "surface");
    figure.arrow(kSide, [0, 0], side(normal), "normal", "N");
    figure.arrow(kSide, [0, 0], side(mean), "tangent faint", "t");
    figure.arrow(kSide, [0, 0], foot, "part");
    figure.word(kSide, [foot[0] - 0.32, foot[1]], "N(N\u00b7t)", "part");
    figure.line(kSide, side(mean), side(flat), "dashed");
    figure.arrow(kSide, [0, 0], side(flat), "tangent", "T");
    figure.word(kSide, [0, -0.79], "from the side");

    const expected = unit(flat);
    numbers.set("sum", `\u03a3 dP/du = ${tuple(sum)}, and t is its mean`);
    numbers.set("Gram-Schmidt", `T = t \u2212 N (N\u00b7t) = ${tuple(mean)} \u2212 ${text(dot(mean, normal))} \u00b7 ${tuple(normal)} = ${tuple(flat)}`);
    numbers.set("normalized", tuple(expected, 3));
    numbers.set("the library", `lengyel: T = ${tuple(result, 3)}, ${text(length(flat) > 1e-6 ? angle(result, expected) : 0, 4)} degrees from the formula`);
    numbers.set("right angle", `N\u00b7T = ${text(dot(normal, result), 3)}; before, N\u00b7t / |t| = ${text(dot(normal, mean) / (length(mean) || 1), 3)}`);
  });
  ring.forEach((_, i) => figure.handle(kTop, `outer vertex ${i + 1}`, () => ring[i]!, (to) => (ring[i] = to), [[-1.1, 1.1], [-1.1, 1.1]]));
  figure.handle(kSide, "the normal", () => lean, (to) => (lean = to), [[-0.95, 0.95], [0.3, 1.1]], "normal");
  figure.redraw();
}
