// SPDX-License-Identifier: MIT
// Legend of the colors in the picture.
import { css, heatDegrees, heatGradient, noData, signMinus, signPlus, wrong, type Rgb } from "../color.js";
import { el, replaceChildren } from "../dom.js";
import type { Look } from "../picture/shader.js";

const swatch = (color: Rgb, text: string, isStriped = false): HTMLElement =>
  el("span", { class: "swatch" }, el("i", { "data-color": css(color), style: isStriped ? `background: repeating-linear-gradient(135deg, ${css(color)} 0 4px, transparent 4px 8px)` : `background: ${css(color)}` }), text);

/** Returns the color scale of errors, with degrees below it. */
const scale = (label: string): HTMLElement =>
  el("span", { class: "scale", role: "img", "aria-label": `${label}, ${heatDegrees[0]} to ${heatDegrees.at(-1)}` },
    el("i", { style: `background: ${heatGradient}` }),
    ...heatDegrees.map((degrees, i) => el("span", { style: `left: ${(100 * i) / (heatDegrees.length - 1)}%` }, `${degrees}°`)));

export class Legend {
  /** Colors and their meanings, for saved pictures. */
  get swatches(): { color: string; text: string }[] {
    return [...this.element.querySelectorAll<HTMLElement>(".swatch")].map((one) => ({ color: one.querySelector("i")!.dataset.color!, text: one.textContent ?? "" }));
  }

  readonly element = el("div", { class: "legend", "aria-live": "polite" });

  show(look: Look, method: string): void {
    const sentences: Record<Look, () => (Node | string)[]> = {
      lit: () => [],
      difference: () => [scale(`Angle between the shaded normals of the file and of ${method}, in degrees`)],
      normals: () => ["Shaded normals; x, y and z are shown as red, green and blue."],
      signs: () => [swatch(signPlus, "w = +1"), swatch(signMinus, "w = −1"), swatch(wrong, `not the sign of ${method}`, true), swatch(noData, "no tangents")],
      mirrored: () => [swatch(signPlus, "texture not mirrored"), swatch(signMinus, "texture mirrored"), swatch(noData, "no UV area")],
      error: () => [
        scale(`Angle from the tangent of ${method}, in degrees`),
        swatch(wrong, "sign differs", true),
        swatch(noData, "nothing to compare"),
      ],
      islands: () => ["Each UV island has its own color; striped islands are mirrored."],
    };
    replaceChildren(this.element, ...sentences[look]());
    this.element.hidden = look === "lit";
  }
}
