// SPDX-License-Identifier: MIT
// Contents of the file: its figures, parts that can be shown and hidden, and images with their channels.
import { checkbox, choice, count, el, plural, replaceChildren, select } from "../dom.js";
import type { PageOrigin } from "../embedded.js";
import { nameOfMap } from "../model/uv_reads.js";
import type { TreeNode } from "../model/model.js";
import type { Part } from "../model/part.js";
import type { Drawn } from "../picture/scene.js";
import type { Viewport } from "../picture/viewport.js";
import type { InspectReport } from "tspace/gltf";
import type { Texture } from "three";

const kMostParts = 500, kMostDepth = 6;
const kShown = 512;
type Channel = "rgb" | "r" | "g" | "b" | "a";

interface ShownImage {
  name: string;
  image: CanvasImageSource & { width: number; height: number };
}

export class PartsView {
  readonly element = el("details", { class: "panel parts" }, el("summary", {}, "Contents"));
  #numbers = el("dl", {});
  #list = el("div", { class: "part-list" });
  #images = el("div", { class: "rows" });
  #canvas = el("canvas", { width: kShown, height: kShown, role: "img", "aria-label": "The image" });
  #channel: Channel = "rgb";
  #chosen = 0;
  #shown: ShownImage[] = [];
  #drawnOf = new Map<Part, Drawn>();

  /** `origin`: origin of the page, if the tool created it. */
  constructor(private viewport: Viewport, origin: PageOrigin | null) {
    const made = origin && el("p", { class: "quiet made" }, `This page was made on ${origin.date} by tspace ${origin.version}: `, el("code", {}, origin.command));
    this.element.append(el("div", { class: "rows" }, this.#numbers, this.#list, this.#images, made));
    this.element.addEventListener("toggle", () => this.#drawImage());
  }

  /** Shows the figures of the file. */
  describe(report: InspectReport | null): void {
    if (!report) return replaceChildren(this.#numbers);
    const sum = (of: (one: InspectReport["primitives"][number]) => number) => report.primitives.reduce((total, one) => total + of(one), 0);
    const sets = report.primitives.reduce((most, { uvSets }) => Math.max(most, uvSets), 0);
    const rows: [string, string][] = [
      ["Triangles", count(sum(({ triangles }) => triangles))],
      ["Vertices", count(sum(({ vertices }) => vertices))],
      ["Parts", `${plural(report.primitives.length, "primitive")}, ${count(sum(({ hasTangents }) => Number(hasTangents)))} with tangents, ${count(sum(({ hasNormals }) => Number(hasNormals)))} with normals`],
      ["UV sets", count(sets)],
      ["Extensions", report.extensionsUsed.join(", ") || "none"],
    ];
    replaceChildren(this.#numbers, ...rows.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, value)]));
  }

  /** Lists the parts of another model. */
  reset(tree: TreeNode[] = []): void {
    this.#drawnOf = new Map(this.viewport.scene.drawn.map((drawn) => [drawn.part, drawn]));
    const rows: HTMLElement[] = [];
    let left = 0;
    const add = (node: TreeNode, depth: number): HTMLInputElement[] => {
      const [own] = node.draws, shown = own && this.#drawnOf.get(own.part);
      if (own ? !shown : node.children.length === 0) return [];
      const below: HTMLInputElement[] = [], { part } = own ?? {};
      const name = part ? `${part.mesh}/${part.primitive} ${[...new Set([node.name || part.name, part.materialName].filter(Boolean))].join(", ")}${own.count > 1 ? ` (${count(own.count)} times)` : ""}` : node.name || "node";
      const { element, input } = checkbox(name, true, (on) => {
        for (let place = own?.first ?? 0; own && place < own.first + own.count; ++place) on ? shown!.hidden.delete(place) : shown!.hidden.add(place);
        for (const one of below) if (one.checked !== on) one.click();
        this.viewport.ask();
      });
      element.style.paddingLeft = `${Math.min(depth, kMostDepth)}rem`;
      if (rows.length < kMostParts) rows.push(element);
      else left += 1;
      for (const child of node.children) below.push(...add(child, depth + 1));
      return [input];
    };
    for (const node of tree) add(node, 0);
    replaceChildren(this.#list, ...(rows.length > 1 ? rows : []), left > 0 && el("p", { class: "quiet" }, `and ${count(left)} more`));
    this.#collect();
    this.#chosen = 0;
    const images = this.#shown.map(({ name, image }, i) => [String(i), `${name}, ${image.width} x ${image.height}`] as const);
    const which = images.length > 0 && select("Image", images, "0", (value) => {
      this.#chosen = Number(value);
      this.#drawImage();
    }).element;
    const channels = choice("Channels", [["rgb", "RGB"], ["r", "R"], ["g", "G"], ["b", "B"], ["a", "A"]] as const, this.#channel, (value) => {
      this.#channel = value;
      this.#drawImage();
    }).element;
    replaceChildren(this.#images, ...(which ? [which, channels, el("div", { class: "map" }, this.#canvas)] : []));
    this.#drawImage();
  }

  /** Collects each image once, labeled by its use in the first material that shows it. */
  #collect(): void {
    const seen = new Set<unknown>();
    this.#shown = [];
    for (const { part } of this.viewport.scene.drawn) {
      for (const [name, value] of Object.entries(part.surface)) {
        const image = (value as Texture | null)?.isTexture ? ((value as Texture).image as ShownImage["image"] | null) : null;
        if (!image?.width || seen.has(image)) continue;
        seen.add(image);
        this.#shown.push({ name: `${nameOfMap(name)}${part.materialName ? ` of ${part.materialName}` : ""}`, image });
      }
    }
  }

  #drawImage(): void {
    const shown = this.#shown[this.#chosen], context = this.#canvas.getContext("2d", { willReadFrequently: true });
    if (!this.element.hasAttribute("open") || !shown || !context) return;
    context.clearRect(0, 0, kShown, kShown);
    context.drawImage(shown.image, 0, 0, kShown, kShown);
    const pixels = context.getImageData(0, 0, kShown, kShown), { data } = pixels, k = ["r", "g", "b", "a"].indexOf(this.#channel);
    for (let i = 0; i < data.length; i += 4) {
      if (k >= 0) data[i] = data[i + 1] = data[i + 2] = data[i + k];
      data[i + 3] = 255;
    }
    context.putImageData(pixels, 0, 0);
  }
}
