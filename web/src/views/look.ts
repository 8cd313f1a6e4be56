// SPDX-License-Identifier: MIT
// Controls of the view: the method of the correct frames, the normal map, lines and edges.
import { checkbox, choice, count, el, filePicker, replaceChildren, select, slider } from "../dom.js";
import { frameLines, usualEdge, type Axis } from "../picture/overlays.js";
import { surroundings } from "../picture/environment.js";
import { replaceOverlay, type Viewport } from "../picture/viewport.js";
import { isFile, methods, nameOf, type OtherFile, type Right } from "../worker/protocol.js";
import type { Stage } from "./stage.js";
import type { Object3D } from "three";

export class LookView {
  readonly element = el("details", { class: "panel look", open: innerWidth >= 900 }, el("summary", {}, "Look"));
  right: Right = "mikktspace";
  #axes = new Set<Axis>();
  #lines: Object3D | null = null;
  #isRight = false;
  #length = 1;
  #figures = el("p", { class: "quiet figures", "aria-live": "polite" });
  #viewport: Viewport;
  #choice: HTMLSelectElement;

  #variants = el("div", { hidden: true });
  /** Nothing is chosen while a panorama of the user is shown. */
  #surroundings = choice("Surroundings", surroundings.map((name) => [name, name] as const), "room", (name) => {
    this.#viewport.setSurroundings(name);
    this.#sayOfPanorama("");
  });
  #colors = checkbox("Colors", true, (on) => {
    this.#choseColors = true;
    this.#set({ usesColors: on });
  });
  #choseColors = false;
  #panoramaSaid = el("p", { class: "quiet", role: "status" });

  constructor(private stage: Stage, private changed: (right: Right) => void, private vary: (variant: number) => void) {
    const { viewport } = stage;
    this.#viewport = viewport;
    const names = [...methods, "mended", "other"] as const;
    const frames = select("Correct frames by", names.map((name) => [name, nameOf(name)] as const), this.right, (right) => this.#choose(right));
    this.#choice = frames.input;
    const map = choice("Normal map", [["1", "on"], ["0", "off"], ["2", "green inverted"]] as const, "1", (value) => {
      viewport.settings.map = Number(value) as 0 | 1 | 2;
      viewport.ask();
    });
    const wire = checkbox("Edges", false, (on) => this.#set({ isWire: on }));
    const axes = (["t", "b", "n"] as const).map((axis) => {
      const box = checkbox(axis.toUpperCase(), false, (on) => {
        if (on) this.#axes.add(axis);
        else this.#axes.delete(axis);
        this.showLines();
      });
      box.element.classList.add(`axis-${axis}`);
      return box.element;
    });
    const whose = choice("Show T, B, N of", [["file", "the file"], ["right", "correct frames"]] as const, "file", (value) => {
      this.#isRight = value === "right";
      this.showLines();
    });
    const panorama = filePicker("Open .hdr…", { accept: ".hdr", "aria-label": "Panorama as an HDR file" }, ([file]) => void this.#usePanorama(file));
    const turn = slider("Rotation", { min: -180, max: 180, step: 5, value: 0, unit: "°" }, (value) => this.#set({ turn: value }));
    const exposure = slider("Exposure", { min: -3, max: 3, step: 0.25, value: 0, unit: " stops" }, (value) => this.#set({ stops: value }));
    const shadows = checkbox("Shadows", false, (on) => viewport.setShadows(on));
    const ground = choice("Ground", [["gray", "gray"], ["light", "light"], ["dark", "dark"]] as const, "gray", (value) => stage.setGround(value));
    const length = el("input", { type: "range", min: "-10", max: "10", value: "0" });
    length.addEventListener("input", () => {
      this.#length = 2 ** (Number(length.value) / 4);
      this.showLines();
    });
    this.element.append(
      el("div", { class: "rows" }, this.#variants, frames.element, this.#figures, map.element,
        el("div", { class: "row" }, wire.element, this.#colors.element, shadows.element),
        el("div", { class: "row lines" }, ...axes), el("label", { class: "select slider" }, el("span", {}, "Length of the lines"), length), whose.element, this.#surroundings.element, el("div", { class: "select" }, el("span", {}, "Your own panorama"), panorama), this.#panoramaSaid, turn, exposure, ground.element));
    this.offerFile(null);
  }

  /** Shows or hides the colors, until the user has chosen. */
  suggestColors(on: boolean): void {
    if (this.#choseColors) return;
    this.#colors.input.checked = on;
    this.#set({ usesColors: on });
  }

  async #usePanorama(file: File): Promise<void> {
    const bytes = await file.arrayBuffer(), head = new TextDecoder().decode(bytes.slice(0, 11));
    if (!head.startsWith("#?RADIANCE") && !head.startsWith("#?RGBE")) return this.#sayOfPanorama(`${file.name} is not an HDR panorama (Radiance).`);
    try {
      this.#viewport.setPanorama(bytes);
      this.#surroundings.set(null);
      this.#sayOfPanorama(`Shown: ${file.name}`);
    } catch (error) {
      this.#sayOfPanorama(`${file.name} cannot be read: ${(error instanceof Error ? error.message : String(error)).replace(/^THREE\.\w+: /, "")}.`);
    }
  }

  #sayOfPanorama(sentence: string): void {
    this.#panoramaSaid.textContent = sentence;
  }

  /** Offers a choice of the file's variants, if any. `chosen`: index of the current variant, or -1. */
  offerVariants(names: string[], chosen = -1): void {
    this.#variants.hidden = names.length === 0;
    const variants = names.length > 0 && select("Variant", [["-1", "none (materials of the file)"], ...names.map((name, i) => [String(i), name] as const)], String(chosen), (value) => this.vary(Number(value))).element;
    replaceChildren(this.#variants, variants);
  }

  #choose(right: Right): void {
    this.right = right;
    this.stage.setRight(right);
    this.changed(right);
  }

  /** Offers a fixed file or a file to compare with; null: there is none. */
  offerFile(file: OtherFile | null): void {
    for (const option of this.#choice.options) option.disabled = isFile(option.value as Right) && option.value !== file;
    if (file) this.right = file;
    else if (isFile(this.right)) this.right = "mikktspace";
    this.#choice.value = this.right;
    this.stage.setRight(this.right);
  }

  #set(change: Partial<Viewport["settings"]>): void {
    Object.assign(this.#viewport.settings, change);
    this.#viewport.ask();
  }

  /** Redraws the lines after the model, its frames or the choice have changed. */
  showLines(): void {
    const { scene } = this.#viewport;
    const next = this.#axes.size > 0 ? frameLines(scene, [...this.#axes], this.#isRight, 0.45 * this.#length * usualEdge(scene)) : null;
    this.#lines = replaceOverlay(this.#viewport, this.#lines, next);
  }

  /** Shows the deviation of the file's tangents from those of the method. */
  showFigures(): void {
    const { drawn } = this.#viewport.scene;
    if (drawn.length === 0) return replaceChildren(this.#figures);
    let compared = 0, sum = 0, most = 0, signs = 0;
    for (const { frames } of drawn) {
      if (!frames) continue;
      compared += frames.compared;
      sum += frames.meanDegrees * frames.compared;
      most = Math.max(most, frames.maxDegrees);
      signs += frames.wrongSigns;
    }
    const directions = `${(sum / compared).toFixed(2)}° on average, ${most.toFixed(1)}° at most`, name = nameOf(this.right);
    replaceChildren(this.#figures, compared === 0 ? "The file has no tangents to compare."
      : signs > 0 ? `Compared with ${name}, ${count(signs)} of ${count(compared)} corners have ${this.right === "other" ? "a different sign" : "the wrong sign"}; directions differ by ${directions}.`
      : `Tangents of the file differ from ${name} by ${directions}; all signs agree.`);
  }
}
