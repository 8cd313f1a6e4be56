// SPDX-License-Identifier: MIT
// A canvas that shows a UV map and can be moved and zoomed. Its owner draws the content; this class handles input and
// the visible area.
import { el } from "../dom.js";

const kMostPixels = 1 << 21, kNearest = 2e5;
const kMarked = "#ff2d6f";

/** Scale and offset that map UVs to the unit square of the canvas, with y pointing down. */
export type Area = [number, number, number, number];

export class MapCanvas {
  readonly canvas = el("canvas", { width: 512, height: 512, tabindex: "0", role: "img", "aria-label": "UV map of the part. Arrow keys move it, plus and minus zoom, 0 shows all of it." });
  readonly #over = el("canvas", { class: "over", "aria-hidden": "true" });
  readonly element = el("div", { class: "map" }, this.canvas, this.#over);
  /** Called when the visible area has changed, to redraw. */
  onMoved: () => void = () => {};
  /** Called with the UV position of the pointer, or null when it has left. */
  onPointed: (uv: [number, number] | null) => void = () => {};
  /** Called for a click that was not a drag. */
  onClicked: (uv: [number, number]) => void = () => {};
  /** UV position of the center, and CSS pixels per unit of u. */
  #middle: [number, number] = [0.5, 0.5];
  #scale = 100;
  #bounds: [number, number, number, number] = [0, 0, 1, 1];
  #isFitted = true;
  #pointers = new Map<number, { x: number; y: number }>();
  #hasMoved = false;
  #isAsked = false;

  constructor() {
    const { canvas } = this;
    new ResizeObserver(() => this.#resize()).observe(this.element);
    canvas.addEventListener("wheel", (event) => (event.preventDefault(), this.#zoom(Math.exp(-event.deltaY / 400), event)), { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    for (const type of ["pointerup", "pointercancel"] as const) canvas.addEventListener(type, (event) => this.#up(event));
    canvas.addEventListener("pointerleave", () => this.onPointed(null));
    canvas.addEventListener("dblclick", () => this.fit());
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Sets the area that fit() shows: minimum and maximum u and v. */
  setBounds(bounds: [number, number, number, number]): void {
    this.#bounds = bounds;
    this.fit();
  }

  fit(): void {
    const [lowU, lowV, highU, highV] = this.#bounds, { width, height } = this.#size();
    this.#middle = [(lowU + highU) / 2, (lowV + highV) / 2];
    this.#scale = 0.96 * Math.min(width / Math.max(1e-6, highU - lowU), height / Math.max(1e-6, highV - lowV));
    this.#isFitted = true;
    this.#ask();
  }

  get area(): Area {
    const { width, height } = this.#size(), su = this.#scale / width, sv = this.#scale / height;
    return [su, sv, 0.5 - this.#middle[0] * su, 0.5 - this.#middle[1] * sv];
  }

  /** Screen pixels per unit of u. */
  get pixelsPerUnit(): number {
    return this.#scale * (this.canvas.width / this.#size().width);
  }

  /** Outlines triangles (three UV pairs, six numbers each) and marks a position. */
  mark(triangles: readonly (readonly number[])[], place: readonly [number, number] | null): void {
    const over = this.#over, context = over.getContext("2d")!, [su, sv, ou, ov] = this.area;
    over.width = this.canvas.width;
    over.height = this.canvas.height;
    const at = (u: number, v: number): [number, number] => [(u * su + ou) * over.width, (v * sv + ov) * over.height];
    const unit = over.width / this.#size().width;
    context.lineWidth = 2 * unit;
    context.strokeStyle = kMarked;
    context.fillStyle = `${kMarked}59`;
    for (const [a, b, c, d, e, f] of triangles) {
      context.beginPath();
      context.moveTo(...at(a, b));
      context.lineTo(...at(c, d));
      context.lineTo(...at(e, f));
      context.closePath();
      context.fill();
      context.stroke();
    }
    if (!place) return;
    for (const [color, width] of [["#000", 5], ["#fff", 2]] as const) {
      context.strokeStyle = color;
      context.lineWidth = width * unit;
      context.beginPath();
      context.arc(...at(...place), 6 * unit, 0, 7);
      context.stroke();
    }
  }

  /** Scrolls to make a position visible. */
  show(u: number, v: number): void {
    const [su, sv, ou, ov] = this.area, x = u * su + ou, y = v * sv + ov;
    if (x > 0.02 && x < 0.98 && y > 0.02 && y < 0.98) return;
    this.#middle = [u, v];
    this.#ask();
  }

  #size(): { width: number; height: number } {
    return { width: this.canvas.clientWidth || 512, height: this.canvas.clientHeight || 512 };
  }

  #resize(): void {
    const { width, height } = this.#size(), ratio = Math.min(2, devicePixelRatio, Math.sqrt(kMostPixels / (width * height)));
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = Math.max(1, Math.round(height * ratio));
    if (this.#isFitted) this.fit();
    else this.#ask();
  }

  #ask(): void {
    if (this.#isAsked) return;
    this.#isAsked = true;
    requestAnimationFrame(() => {
      this.#isAsked = false;
      this.onMoved();
    });
  }

  #uvAt({ clientX, clientY }: { clientX: number; clientY: number }): [number, number] {
    const box = this.canvas.getBoundingClientRect(), [su, sv, ou, ov] = this.area;
    return [((clientX - box.left) / box.width - ou) / su, ((clientY - box.top) / box.height - ov) / sv];
  }

  /** Zooms; the position under the pointer does not move. */
  #zoom(by: number, at: { clientX: number; clientY: number } | null): void {
    const [u, v] = at ? this.#uvAt(at) : this.#middle, least = 20 / Math.max(this.#bounds[2] - this.#bounds[0], this.#bounds[3] - this.#bounds[1]);
    const scale = Math.min(kNearest, Math.max(least, this.#scale * by)), k = this.#scale / scale;
    this.#middle = [u + (this.#middle[0] - u) * k, v + (this.#middle[1] - v) * k];
    this.#scale = scale;
    this.#isFitted = false;
    this.#ask();
  }

  #pan(dx: number, dy: number): void {
    this.#middle = [this.#middle[0] - dx / this.#scale, this.#middle[1] - dy / this.#scale];
    this.#isFitted = false;
    this.#ask();
  }

  #down(event: PointerEvent): void {
    this.canvas.setPointerCapture(event.pointerId);
    this.#pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.#pointers.size === 1) this.#hasMoved = false;
    if (event.pointerType !== "mouse") this.onPointed(this.#uvAt(event));
  }

  #move(event: PointerEvent): void {
    const before = this.#pointers.get(event.pointerId), now = { x: event.clientX, y: event.clientY };
    if (!before) return this.onPointed(this.#uvAt(event));
    const [other] = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    if (Math.hypot(now.x - before.x, now.y - before.y) < 3 && !this.#hasMoved && !other) return;
    this.#hasMoved = true;
    const share = other ? 0.5 : 1; // with two fingers each contributes half of the motion
    this.#pan(share * (now.x - before.x), share * (now.y - before.y));
    if (other) {
      const apart = Math.hypot(before.x - other.x, before.y - other.y);
      if (apart > 0) this.#zoom(Math.hypot(now.x - other.x, now.y - other.y) / apart, { clientX: (now.x + other.x) / 2, clientY: (now.y + other.y) / 2 });
    }
    this.#pointers.set(event.pointerId, now);
  }

  #up(event: PointerEvent): void {
    const isClick = this.#pointers.size === 1 && !this.#hasMoved && event.type === "pointerup";
    this.#pointers.delete(event.pointerId);
    if (isClick) this.onClicked(this.#uvAt(event));
  }

  #key(event: KeyboardEvent): void {
    const act: Record<string, () => void> = {
      ArrowLeft: () => this.#pan(30, 0),
      ArrowRight: () => this.#pan(-30, 0),
      ArrowUp: () => this.#pan(0, 30),
      ArrowDown: () => this.#pan(0, -30),
      "+": () => this.#zoom(1.25, null),
      "=": () => this.#zoom(1.25, null),
      "-": () => this.#zoom(0.8, null),
      "0": () => this.fit(),
      Home: () => this.fit(),
    };
    if (!act[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act[event.key]();
  }
}
