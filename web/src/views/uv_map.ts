// SPDX-License-Identifier: MIT
// The UV map of a part, in the inspector or large next to the model: its islands over an image. Pointing at one of the
// two views highlights the same position in the other.
import type { Object3D } from "three";
import { checkbox, choice, el, plural, replaceChildren, select } from "../dom.js";
import { uvReadsOf, type UvRead } from "../model/uv_reads.js";
import { outlineTriangles } from "../picture/overlays.js";
import type { Drawn } from "../picture/scene.js";
import type { Look } from "../picture/shader.js";
import { replaceOverlay, type Viewport } from "../picture/viewport.js";
import type { Work } from "../worker/client.js";
import type { MapCorners } from "../worker/protocol.js";
import { MapCanvas, type Area } from "./map_canvas.js";
import type { Spot } from "./texel.js";

const kMostParts = 500;
/** Maximum number of triangles outlined at one position. */
const kMostMarked = 60;
const kMostTiles = 32;

export class UvMapView {
  readonly element = el("details", { class: "panel uv" }, el("summary", {}, "UV map"));
  #rows = el("div", { class: "rows" });
  #map = new MapCanvas();
  #caption = el("p", { class: "quiet", role: "status" });
  #part = el("div", {});
  #sets = el("div", { class: "rows" });
  #enlarge = el("button", { type: "button", class: "small", onclick: () => this.setLarge(this.large.hasAttribute("hidden")) }, "Show large");
  #drawn: Drawn | undefined;
  #reads: UvRead[] = [];
  #read = 0;
  #corners: MapCorners | null = null;
  #image = 0;
  #look: Look = "islands";
  #isWire = true;
  #cover = 0.5;
  #turn = 0;
  #marked: number[] = [];
  #place: [number, number] | null = null;
  #outline: Object3D | null = null;
  /** Index of the overlapping triangle that the next click shows. */
  #next = 0;
  #sentence = "";
  /** Description of the position under the pointer, before the sentence about the part. */
  #pointedText = "";

  /** `large`: element next to the picture that contains the map when it is large. */
  constructor(private viewport: Viewport, private work: Work, private large: HTMLElement) {
    const looks = choice("Shown as", [["islands", "islands"], ["mirrored", "mirrored"], ["error", "error"]] as const, "islands", (look) => {
      this.#look = look;
      void this.draw();
    });
    const wire = checkbox("Triangles", true, (on) => ((this.#isWire = on), void this.draw()));
    const cover = el("input", { type: "range", min: "0", max: "100", value: String(100 * this.#cover), "aria-label": "Opacity of the UV islands over the image" });
    cover.addEventListener("input", () => ((this.#cover = Number(cover.value) / 100), void this.draw()));
    this.#rows.append(this.#part, this.#sets, looks.element, el("div", { class: "row" }, wire.element, el("label", { class: "select" }, el("span", {}, "Opacity"), cover)),
      el("div", { class: "row" }, this.#enlarge, el("button", { type: "button", class: "small", onclick: () => this.#map.fit() }, "Show all")), this.#map.element, this.#caption);
    this.element.append(this.#rows);
    this.element.addEventListener("toggle", () => (this.element as HTMLDetailsElement).open && void this.#choose(this.#index()));
    this.#map.onMoved = () => void this.draw();
    this.#map.onPointed = (uv) => this.#pointed(uv);
    this.#map.onClicked = (uv) => this.#clicked(uv);
  }

  /** Scale and offset of the visible area. */
  get area(): Area {
    return this.#map.area;
  }

  get isOpen(): boolean {
    return (this.element as HTMLDetailsElement).open || !this.large.hasAttribute("hidden");
  }

  /** Moves the map next to the model, or back to the inspector. */
  setLarge(isLarge: boolean): void {
    this.large.hidden = !isLarge;
    this.large.parentElement?.classList.toggle("with-map", isLarge);
    this.#enlarge.textContent = isLarge ? "Back to the side panel" : "Show large";
    replaceChildren(this.element, this.element.firstElementChild!, isLarge ? el("p", { class: "quiet" }, "The UV map is shown next to the model.") : this.#rows);
    if (isLarge) this.large.append(this.#rows);
    this.#enlarge.focus();
    this.#map.fit();
  }

  #index(): number {
    return this.#drawn ? this.viewport.scene.drawn.indexOf(this.#drawn) : -1;
  }

  /** Resets the map for another model or other frames. */
  reset(): void {
    const { drawn } = this.viewport.scene;
    this.#mark([], null);
    const names = drawn.slice(0, kMostParts).map(({ part }, i) => [String(i), `${part.mesh}/${part.primitive} ${part.name || part.materialName}`.slice(0, 60)] as const);
    const parts = names.length > 1 ? select("Part", names, "0", (value) => void this.#choose(Number(value))) : null;
    replaceChildren(this.#part, parts?.element);
    this.#drawn = undefined;
    this.#reads = [];
    void this.#choose(0);
  }

  /** Shows another part, with a choice of its UV maps. */
  async #choose(index: number): Promise<void> {
    const drawn = this.viewport.scene.drawn[index];
    if (!this.isOpen) return void (this.#drawn = drawn);
    const isOther = drawn !== this.#drawn || this.#reads.length === 0;
    this.#drawn = drawn;
    const input = this.#part.querySelector("select");
    if (input) input.value = String(index);
    if (isOther) {
      this.#reads = drawn ? uvReadsOf(drawn.part) : [];
      this.#read = Math.max(0, this.#reads.findIndex(({ isLeading }) => isLeading));
    }
    await this.#chooseSet(this.#read);
  }

  async #chooseSet(index: number): Promise<void> {
    this.#read = index;
    const drawn = this.#drawn, read = this.#reads[index];
    this.#image = 0;
    const sets = this.#reads.length > 1 ? select("UV set", this.#reads.map(({ label }, i) => [String(i), label] as const), String(index), (value) => void this.#chooseSet(Number(value))) : null;
    const images = read && read.images.length > 0 ? select("Background image", [...read.images.map(({ name }, i) => [String(i), name] as const), ["-1", "none"] as const], "0", (value) => {
      this.#image = Number(value);
      void this.draw();
    }) : null;
    replaceChildren(this.#sets, sets?.element, images?.element);
    this.#corners = drawn && read ? await this.#cornersOf(drawn, read) : null;
    if (drawn !== this.#drawn || read !== this.#reads[this.#read]) return;
    this.#mark([], null);
    this.#map.setBounds(this.#corners ? boundsOf(this.#corners.uvs) : [0, 0, 1, 1]);
  }

  async #cornersOf({ corners, part }: Drawn, read: UvRead): Promise<MapCorners | null> {
    const { uvs, islands, islandCount, mirroredCount } = corners;
    if (read.isLeading) return uvs && { uvs, islands, islandCount, mirroredCount };
    return this.work.run("map", { arrays: structuredClone({ ...part.arrays, normals: null, tangents: null, uvs: read.uvs }) }).catch(() => null);
  }

  /** Highlights in the map the position that is under the pointer in the picture. */
  point(spot: Spot | null): void {
    if (!this.isOpen) return;
    if (!spot) return this.#mark([], null);
    if (spot.drawn === this.#drawn) return this.#pointTo(spot);
    void this.#choose(spot.partIndex).then(() => this.#drawn === spot.drawn && this.#pointTo(spot));
  }

  #pointTo({ triangle, weights }: Spot): void {
    const uvs = this.#corners?.uvs;
    if (!uvs) return;
    const at = (k: number) => weights.reduce((sum, weight, corner) => sum + weight * uvs[6 * triangle + 2 * corner + k], 0);
    this.#map.show(at(0), at(1));
    this.#mark([triangle], [at(0), at(1)]);
    this.#setCaption(`Triangle ${triangle}. `);
  }

  #pointed(uv: [number, number] | null): void {
    const found = uv ? this.#trianglesAt(uv) : [];
    if (found.join() !== this.#marked.join()) this.#next = 0;
    this.#mark(found, uv);
    if (!uv) return;
    const place = `UV ${uv.map((x) => x.toFixed(4)).join("  ")}`;
    const named = found.length === 0 ? "no triangle" : found.length === 1 ? `triangle ${found[0]}` : `${plural(found.length, "triangle")} (${found.slice(0, 6).join(", ")}${found.length > 6 ? ", …" : ""})`;
    this.#setCaption(`${place}: ${named}. `);
  }

  /** Moves the camera to the clicked position; another click shows the next of several triangles. */
  #clicked(uv: [number, number]): void {
    const found = this.#trianglesAt(uv), drawn = this.#drawn;
    if (!drawn || found.length === 0) return;
    const { center, radius, faces } = outlineTriangles(drawn, [found[this.#next++ % found.length]]);
    if (radius > 0) this.viewport.fly(center, Math.max(3 * radius, 0.15 * this.viewport.scene.sphere().radius), faces[0]?.lengthSq() > 0 ? faces[0].normalize() : null);
  }

  /** Returns the triangles of the map at a position: several if islands overlap. */
  #trianglesAt([u, v]: [number, number]): number[] {
    const uvs = this.#corners?.uvs, found: number[] = [];
    if (!uvs) return found;
    for (let i = 0; i < uvs.length && found.length < kMostMarked; i += 6) {
      const ax = uvs[i] - u, ay = uvs[i + 1] - v, bx = uvs[i + 2] - u, by = uvs[i + 3] - v, cx = uvs[i + 4] - u, cy = uvs[i + 5] - v;
      const ab = ax * by - ay * bx, bc = bx * cy - by * cx, ca = cx * ay - cy * ax;
      if ((ab >= 0 && bc >= 0 && ca >= 0 && ab + bc + ca > 0) || (ab <= 0 && bc <= 0 && ca <= 0 && ab + bc + ca < 0)) found.push(i / 6);
    }
    return found;
  }

  /** Outlines triangles in the map and in the picture. */
  #mark(triangles: number[], place: [number, number] | null): void {
    const drawn = this.#drawn;
    this.#marked = triangles;
    this.#place = place;
    this.#showMarks();
    const next = drawn && triangles.length > 0 ? outlineTriangles(drawn, triangles).outline : null;
    if (next || this.#outline) this.#outline = replaceOverlay(this.viewport, this.#outline, next);
    this.viewport.canvas.dataset.marked = triangles.join(" ");
  }

  #showMarks(): void {
    const uvs = this.#corners?.uvs;
    this.#map.mark(uvs ? this.#marked.map((t) => [...uvs.subarray(6 * t, 6 * t + 6)]) : [], this.#place);
    this.#map.canvas.dataset.marked = this.#marked.join(" ");
  }

  #setCaption(pointedText: string): void {
    this.#pointedText = pointedText;
    this.#caption.textContent = pointedText + this.#sentence;
  }

  async draw(): Promise<void> {
    const turn = ++this.#turn, drawn = this.#drawn, corners = this.#corners;
    if (!this.isOpen) return;
    const { canvas, area } = this.#map, { width, height } = canvas, context = canvas.getContext("2d")!;
    const say = (sentence: string) => {
      context.clearRect(0, 0, width, height);
      this.#sentence = sentence;
      replaceChildren(this.#caption, sentence);
    };
    if (!drawn || !corners) return say(drawn ? "This part has no UVs." : "No part is shown.");
    const pixels = await this.viewport.drawMap(this.#index(), corners, this.#look, this.#isWire, { width, height }, area);
    if (turn !== this.#turn) return;
    if (!pixels) return say("The UV map needs WebGL, which this browser does not support.");
    context.clearRect(0, 0, width, height);
    const image = this.#reads[this.#read]?.images[this.#image]?.image;
    const isBehind = image !== undefined && this.#drawImage(context, image, area);
    const own = new OffscreenCanvas(width, height);
    own.getContext("2d")!.putImageData(new ImageData(pixels, width, height), 0, 0);
    context.globalAlpha = isBehind ? this.#cover : 1;
    context.drawImage(own, 0, 0);
    context.globalAlpha = 1;
    this.#drawSquare(context, area);
    const triangles = corners.uvs.length / 6;
    this.#sentence = `${plural(corners.islandCount, "island")}; ${plural(corners.mirroredCount, "triangle")} of ${triangles.toLocaleString("en")} mirrored.`;
    this.#setCaption(this.#marked.length === 0 ? "" : this.#pointedText);
    this.#showMarks();
  }

  /** Draws the image in each visible unit square of the map. */
  #drawImage(context: CanvasRenderingContext2D, image: UvRead["images"][number]["image"], [su, sv, ou, ov]: Area): boolean {
    const { width, height } = context.canvas;
    if (Math.max(1 / su, 1 / sv) > kMostTiles) return false;
    // from three pixels per texel on, texels are drawn as squares
    context.imageSmoothingEnabled = su * width < 3 * image.width;
    for (let row = Math.floor(-ov / sv); row < (1 - ov) / sv; ++row) {
      for (let column = Math.floor(-ou / su); column < (1 - ou) / su; ++column) {
        context.drawImage(image, (column * su + ou) * width, (row * sv + ov) * height, su * width, sv * height);
      }
    }
    return true;
  }

  /** Draws the outline of the square from 0 to 1, which contains the image once. */
  #drawSquare(context: CanvasRenderingContext2D, [su, sv, ou, ov]: Area): void {
    const { width, height } = context.canvas;
    context.strokeStyle = "#7f858f";
    context.lineWidth = 1;
    context.strokeRect(ou * width, ov * height, su * width, sv * height);
  }
}

/** Returns the bounds of the UVs, at least the square from 0 to 1. */
function boundsOf(uvs: Float32Array): [number, number, number, number] {
  let lowU = 0, lowV = 0, highU = 1, highV = 1;
  for (let i = 0; i < uvs.length; i += 2) {
    if (!(Math.abs(uvs[i]) < 1e4 && Math.abs(uvs[i + 1]) < 1e4)) continue;
    lowU = Math.min(lowU, uvs[i]), highU = Math.max(highU, uvs[i]);
    lowV = Math.min(lowV, uvs[i + 1]), highV = Math.max(highV, uvs[i + 1]);
  }
  return [lowU, lowV, highU, highV];
}
