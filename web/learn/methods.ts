// SPDX-License-Identifier: MIT
// Figure 6: where methods differ, against the true surface.

import { generateTangents, type TangentOptions } from "tspace";
import { Figure, type Plane } from "./figure";
import { bevel, mirrored, sheet, type Surface } from "./surfaces";
import { add, angle, scale, sub, text, unit, type Vec2, type Vec3 } from "./vector";

const kMethods: readonly NonNullable<TangentOptions["method"]>[] = ["lengyel", "angle", "mikktspace", "best"];
const kView: Plane = { origin: [230, 190], unit: 165 };
const kPad: Plane = { origin: [540, 235], unit: 45 };
const kSurfaces = { sheet, bevel, mirrored };
export type SurfaceName = keyof typeof kSurfaces;

/** From the side and above, without perspective. */
const project = ([x, y, z]: Vec3): Vec2 => [0.86 * x - 0.5 * y, 0.28 * x + 0.42 * y + 0.8 * z];

const flatten = (values: readonly (readonly number[])[]) => new Float32Array(values.flat());

function tangentsOf(surface: Surface, method: (typeof kMethods)[number]): Vec3[] {
  const made = generateTangents(
    { positions: flatten(surface.positions), normals: flatten(surface.normals), uvs: flatten(surface.uvs), indices: new Uint32Array(surface.indices) },
    { method, convention: "opengl" });
  return surface.indices.map((_, i) => [made[4 * i]!, made[4 * i + 1]!, made[4 * i + 2]!]);
}

export function showMethods(host: HTMLElement, table: HTMLTableSectionElement, choice: HTMLSelectElement) {
  const figure = new Figure(host, 600, 340, "A surface, its true tangents, and those of four methods");
  const at: Record<SurfaceName, Vec2> = { sheet: [0.05, -0.04], bevel: [0.6, 0.4], mirrored: [0.5, 0] };
  const name = () => choice.value as SurfaceName;
  const rows = new Map(kMethods.map((method) => {
    const row = table.insertRow();
    const head = document.createElement("th");
    head.scope = "row";
    head.textContent = method;
    head.className = method;
    row.append(head);
    return [method, [row.insertCell(), row.insertCell()]] as const;
  }));

  figure.show(() => {
    const surface = kSurfaces[name()](at[name()]);
    const points = surface.positions.map(project);
    for (let i = 0; i < surface.indices.length; i += 3) {
      figure.polygon(kView, surface.indices.slice(i, i + 3).map((vertex) => points[vertex]!), "face front thin");
    }
    // One arrow a vertex is enough to look at; corners of one vertex may differ, so the first of each side is drawn.
    const drawn = new Map<string, number>();
    for (const corner of surface.watched) {
      const side = surface.truth[corner]![0] > 0 ? "+" : "-";
      if (!drawn.has(surface.indices[corner]! + side)) drawn.set(surface.indices[corner]! + side, corner);
    }
    /** `aside`: in pixels, so that the methods' arrows lie beside each other. */
    const arrow = (corner: number, v: Vec3, kind: string, aside = 0) => {
      const step = project(v), [x, y] = project(surface.truth[corner]!), from = points[surface.indices[corner]!]!, shift = aside / kView.unit / (Math.hypot(x, y) || 1);
      figure.arrow(kView, [from[0] - shift * y, from[1] + shift * x], [0.17 * step[0], 0.17 * step[1]], kind);
    };
    for (const corner of drawn.values()) arrow(corner, surface.truth[corner]!, "truth");
    for (const [i, method] of kMethods.entries()) {
      const made = tangentsOf(surface, method);
      for (const corner of drawn.values()) {
        const truth = surface.truth[corner]!;
        arrow(corner, unit(add(truth, scale(surface.enlarged, sub(made[corner]!, truth)))), `method ${method}`, 4 * (i - 1.5));
      }
      const errors = surface.watched.map((corner) => angle(made[corner]!, surface.truth[corner]!));
      const [mean, most] = rows.get(method)!;
      mean.textContent = text(errors.reduce((sum, error) => sum + error, 0) / errors.length);
      most.textContent = text(Math.max(...errors));
    }
    figure.word(kView, [0.35, -0.8], surface.words + (surface.enlarged > 1 ? `; errors are drawn ${surface.enlarged} times as large` : ""));
    figure.polygon(kPad, [[-1, -1], [1, -1], [1, 1], [-1, 1]], "face");
    figure.word(kPad, [0, 1.2], { sheet: "middle", bevel: "angle, width", mirrored: "curvature" }[name()]);
  });
  const reach = (): number => (name() === "sheet" ? 0.25 : 1);
  figure.handle(kPad, "the shape of the surface", () => [at[name()][0] / reach(), at[name()][1] / reach()],
    (to) => (at[name()] = [to[0] * reach(), to[1] * reach()]), [[-1, 1], [-1, 1]]);
  choice.addEventListener("change", () => figure.redraw());
  figure.redraw();
}
