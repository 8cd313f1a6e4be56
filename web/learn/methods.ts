// SPDX-License-Identifier: MIT
// Figure 8: tangents of several methods, compared with the true surface.

import { generateTangents, type TangentOptions } from "tspace";
import { Figure, type Plane } from "./figure";
import { bevel, mirrored, sheet, type Surface } from "./surfaces";
import { add, angle, scale, sub, text, unit, type Vec2, type Vec3 } from "./vector";

const kMethods = ["lengyel", "angle", "mikktspace", "best"] as const satisfies readonly TangentOptions["method"][];
/** Center and maximum size of each method's surface, and position of the method's name above its arrows. */
const kPanels = { lengyel: [122, 106], angle: [368, 106], mikktspace: [122, 286], best: [368, 286] } as const satisfies Record<string, Vec2>;
const kPanel: Vec2 = [228, 112], kName = 88;
const kPad: Plane = { origin: [547, 186], unit: 42 };
/** Length of an arrow, and minimum distance of two vertices with arrows, so that arrows do not overlap. */
const kArrow = 24, kApart = 27;
const kSurfaces = { sheet, bevel, mirrored };
export type SurfaceName = keyof typeof kSurfaces;

/** Projects a point to an oblique view from above, without perspective. */
const project = ([x, y, z]: Vec3): Vec2 => [0.86 * x - 0.5 * y, 0.28 * x + 0.42 * y + 0.8 * z];

const flatten = (values: readonly (readonly number[])[]) => new Float32Array(values.flat());

function tangentsOf(surface: Surface, method: (typeof kMethods)[number]): Vec3[] {
  const made = generateTangents(
    { positions: flatten(surface.positions), normals: flatten(surface.normals), uvs: flatten(surface.uvs), indices: new Uint32Array(surface.indices) },
    { method, convention: "opengl" });
  return surface.indices.map((_, i) => [made[4 * i]!, made[4 * i + 1]!, made[4 * i + 2]!]);
}

export function showMethods(host: HTMLElement, table: HTMLTableSectionElement, choice: HTMLSelectElement, words: HTMLElement) {
  const figure = new Figure(host, 600, 352, "A surface, its true tangents, and those of four methods");
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
    const surface = kSurfaces[name()](at[name()]), points = surface.positions.map(project);
    const low = [0, 1].map((k) => Math.min(...points.map((p) => p[k]!))), high = [0, 1].map((k) => Math.max(...points.map((p) => p[k]!)));
    const unitLength = Math.min(...[0, 1].map((k) => kPanel[k]! / (high[k]! - low[k]!)));
    // One arrow per vertex and side of the surface; vertices close to a vertex with arrows get none.
    const drawn = new Map<string, number>();
    for (const corner of surface.watched) {
      const vertex = surface.indices[corner]!, key = vertex + (surface.truth[corner]![0] > 0 ? "+" : "-");
      const isNear = (other: number) => other !== vertex && Math.hypot(...[0, 1].map((k) => points[other]![k]! - points[vertex]![k]!)) * unitLength < kApart;
      if (!drawn.has(key) && ![...drawn.values()].some((other) => isNear(surface.indices[other]!))) drawn.set(key, corner);
    }
    for (const method of kMethods) {
      const [x, y] = kPanels[method];
      const plane: Plane = { origin: [x - (unitLength * (low[0]! + high[0]!)) / 2, y + (unitLength * (low[1]! + high[1]!)) / 2], unit: unitLength };
      for (let i = 0; i < surface.indices.length; i += 3) figure.polygon(plane, surface.indices.slice(i, i + 3).map((vertex) => points[vertex]!), "face front thin");
      figure.add("text", { class: `word ${method}`, x, y: y - kName, "text-anchor": "middle" }, method);
      const made = tangentsOf(surface, method);
      for (const corner of drawn.values()) {
        const truth = surface.truth[corner]!, from = points[surface.indices[corner]!]!;
        // All true tangents are drawn with the same length, although the view shortens them.
        const size = kArrow / unitLength / Math.max(0.3, Math.hypot(...project(truth)));
        for (const [v, kind] of [[truth, "truth"], [unit(add(truth, scale(surface.enlarged, sub(made[corner]!, truth)))), `method ${method}`]] as const) {
          const [stepX, stepY] = project(v);
          figure.arrow(plane, from, [size * stepX, size * stepY], kind);
        }
      }
      const errors = surface.watched.map((corner) => angle(made[corner]!, surface.truth[corner]!));
      const [mean, most] = rows.get(method)!;
      mean.textContent = text(errors.reduce((sum, error) => sum + error, 0) / errors.length);
      most.textContent = text(Math.max(...errors));
    }
    figure.polygon(kPad, [[-1, -1], [1, -1], [1, 1], [-1, 1]], "face");
    const moves = { sheet: "the vertex in the middle", bevel: "the angle of the texture and the width of the bevel", mirrored: "the curvature" }[name()];
    words.textContent = `Above: ${surface.words}${surface.enlarged > 1 ? `; errors are drawn ${surface.enlarged} times as large` : ""}. The square changes ${moves}.`;
  });
  const reach = (): number => (name() === "sheet" ? 0.25 : 1);
  figure.handle(kPad, "the shape of the surface", () => [at[name()][0] / reach(), at[name()][1] / reach()],
    (to) => (at[name()] = [to[0] * reach(), to[1] * reach()]), [[-1, 1], [-1, 1]]);
  choice.addEventListener("change", () => figure.redraw());
  figure.redraw();
}
