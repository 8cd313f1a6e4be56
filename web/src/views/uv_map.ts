// SPDX-License-Identifier: MIT
// The UV map of a part: its islands, the normal map behind them, and where the pointer is.
import { checkbox, choice, el, plural, replaceChildren, select } from "../dom.js";
import type { Look } from "../picture/shader.js";
import type { Viewport } from "../picture/viewport.js";
import type { Spot } from "./texel.js";

const kSize = 512;

export class UvMapView {
  readonly element = el("details", { class: "panel uv" }, el("summary", {}, "UV map"));
  #canvas = el("canvas", { width: kSize, height: kSize, role: "img", "aria-label": "UV map of the part" });
  #marker = el("i", { class: "marker", hidden: true });
  #caption = el("p", { class: "quiet" });
  #part = el("div", {});
  #shown = 0;
  #look: Look = "islands";
  #hasImage = true;
  #area: [number, number, number, number] = [1, 1, 0, 0];
  #turn = 0;

  constructor(private viewport: Viewport) {
    const looks = choice("Shown as", [["islands", "islands"], ["mirrored", "mirrored"], ["error", "error"]] as const, "islands", (look) => {
      this.#look = look;
      void this.draw();
    });
    const image = checkbox("Normal map behind", true, (on) => {
      this.#hasImage = on;
      void this.draw();
    });
    this.element.append(el("div", { class: "rows" }, this.#part, looks.element, image.element, el("div", { class: "map" }, this.#canvas, this.#marker), this.#caption));
    this.element.addEventListener("toggle", () => void this.draw());
  }

  /** Another model, or new frames. */
  reset(): void {
    const { drawn } = this.viewport.scene;
    this.#shown = Math.min(this.#shown, Math.max(0, drawn.length - 1));
    this.#marker.hidden = true;
    const names = drawn.slice(0, 500).map(({ part }, i) => [String(i), `${part.mesh}/${part.primitive} ${part.name || part.materialName}`.slice(0, 60)] as const);
    const parts = names.length > 1 ? select("Part", names, String(this.#shown), (value) => ((this.#shown = Number(value)), void this.draw())) : null;
    replaceChildren(this.#part, parts?.element);
    void this.draw();
  }

  point(spot: Spot | null): void {
    if (!this.element.open || !spot?.uv) return void (this.#marker.hidden = true);
    if (spot.partIndex !== this.#shown) {
      this.#shown = spot.partIndex;
      const input = this.#part.querySelector("select");
      if (input) input.value = String(this.#shown);
      void this.draw();
    }
    const [su, sv, ou, ov] = this.#area;
    this.#marker.hidden = false;
    this.#marker.style.left = `${(spot.uv[0] * su + ou) * 100}%`;
    this.#marker.style.top = `${(spot.uv[1] * sv + ov) * 100}%`;
  }

  async draw(): Promise<void> {
    const turn = ++this.#turn;
    const drawn = this.viewport.scene.drawn[this.#shown];
    const context = this.#canvas.getContext("2d")!;
    if (!this.element.open) return;
    context.clearRect(0, 0, kSize, kSize);
    if (!drawn?.corners.uvs) return replaceChildren(this.#caption, drawn ? "This part has no UVs." : "No part is shown.");
    this.#area = areaOf(drawn.corners.uvs);
    const pixels = await this.viewport.drawMap(this.#shown, this.#look, kSize, this.#area);
    if (turn !== this.#turn) return;
    if (!pixels) return replaceChildren(this.#caption, "The UV map is drawn by WebGL, which this browser has not.");
    this.#drawImage(context, drawn.part.normalMap?.image as CanvasImageSource | undefined);
    const own = new OffscreenCanvas(kSize, kSize);
    own.getContext("2d")!.putImageData(new ImageData(pixels, kSize, kSize), 0, 0);
    context.globalAlpha = this.#hasImage && drawn.part.normalMap ? 0.62 : 1;
    context.drawImage(own, 0, 0);
    context.globalAlpha = 1;
    const { islandCount, mirroredCount, positions } = drawn.corners;
    replaceChildren(this.#caption, `${plural(islandCount, "island")}; ${plural(mirroredCount, "triangle")} of ${(positions.length / 9).toLocaleString("en")} mirrored.`);
  }

  /** The image fills each square of the map that is in sight. */
  #drawImage(context: CanvasRenderingContext2D, image: CanvasImageSource | undefined): void {
    if (!image || !this.#hasImage) return;
    const [su, sv, ou, ov] = this.#area;
    const most = Math.ceil(1 / su);
    if (most > 32) return;
    for (let row = Math.floor(-ov / sv); row < (1 - ov) / sv; ++row) {
      for (let column = Math.floor(-ou / su); column < (1 - ou) / su; ++column) {
        context.drawImage(image, (column * su + ou) * kSize, (row * sv + ov) * kSize, su * kSize, sv * kSize);
      }
    }
  }
}

/** Scale and offset that take the UVs into the unit square: none where they lie in it. */
function areaOf(uvs: Float32Array): [number, number, number, number] {
  let lowU = 0, lowV = 0, highU = 1, highV = 1;
  for (let i = 0; i < uvs.length; i += 2) {
    if (!(Math.abs(uvs[i]) < 1e4 && Math.abs(uvs[i + 1]) < 1e4)) continue;
    lowU = Math.min(lowU, uvs[i]), highU = Math.max(highU, uvs[i]);
    lowV = Math.min(lowV, uvs[i + 1]), highV = Math.max(highV, uvs[i + 1]);
  }
  const scale = 1 / Math.max(highU - lowU, highV - lowV);
  return [scale, scale, -lowU * scale, -lowV * scale];
}
