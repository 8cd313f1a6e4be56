// SPDX-License-Identifier: MIT
// The center of the page: the picture, the choice of looks, the slider between both frames, and the light.
import { checkbox, choice, el } from "../dom.js";
import type { Look } from "../picture/shader.js";
import { hasSplit, Viewport } from "../picture/viewport.js";
import { isFile, nameOf, type Right } from "../worker/protocol.js";
import { Legend } from "./legend.js";

const lookNames: readonly (readonly [Look, string])[] = [
  ["lit", "Lit"],
  ["difference", "Difference"],
  ["normals", "Normals"],
  ["signs", "Signs"],
  ["mirrored", "Mirrored"],
  ["error", "Error"],
  ["islands", "Islands"],
];

const isTyping = ({ target, ctrlKey, metaKey, altKey }: KeyboardEvent): boolean => ctrlKey || metaKey || altKey || target instanceof HTMLSelectElement || (target instanceof HTMLInputElement && target.type === "text");

/** From this position of the split line on, the fix button is left of it, because the light control needs room on the right. */
const kFixLeftFrom = 0.45;

/** How many of the normal maps right of the split line have inverted green. */
export type TurnedGreen = "none" | "some" | "all";
const greenText: Record<TurnedGreen, string> = { none: "", some: ", green inverted where it points down", all: ", green inverted" };

export class Stage {
  readonly element: HTMLElement;
  readonly viewport: Viewport;
  readonly canvas = el("canvas", {
    tabindex: "0",
    role: "img",
    "aria-label": "The model. Arrow keys rotate it, Shift and arrow keys move it, plus and minus zoom, 0 shows all of it.",
  });
  #legend = new Legend();
  #split = el("input", { type: "range", min: "0", max: "1000", value: "500", class: "split", "aria-label": "Position of the split line: the file's frames are left of it, correct frames right of it" });
  #line = el("div", { class: "split-line", "aria-hidden": "true" });
  #leftLabel = el("span", { class: "side left" }, "as in the file");
  #rightLabel = el("span", { class: "side right" }, "correct frames");
  #light = el("div", { class: "light", tabindex: "0", role: "slider", "aria-label": "Light", "aria-valuemin": "-1", "aria-valuemax": "1" }, el("i"));
  #remark = el("p", { class: "remark", role: "status", hidden: true });
  #frame: HTMLElement;
  #looks;
  /** Shows two pictures instead of a split line when two files are compared. */
  #beside = checkbox("Side by side", false, (on) => this.setBeside(on));
  #right: Right = "mikktspace";
  #green: TurnedGreen = "none";
  #otherName = "";
  #share = 0.5;
  #blinks = false;

  /** `caption` is above the picture, `overLine` over it next to the split line, and `beside` to its right. */
  constructor(caption: HTMLElement, overLine: HTMLElement, beside: HTMLElement) {
    const frame = this.#frame = el("div", { class: "frame", "data-ground": "gray" }, this.canvas, this.#line, this.#leftLabel, this.#rightLabel, this.#legend.element, this.#light, overLine, this.#remark);
    this.#looks = choice("Look", lookNames, "lit", (look) => this.setLook(look));
    this.#looks.element.append(this.#beside.element);
    this.element = el("section", { class: "stage", "aria-label": "Picture" }, caption, this.#looks.element, el("div", { class: "views" }, el("div", { class: "picture" }, frame, this.#split), beside));
    this.viewport = new Viewport(this.canvas);
    this.#split.addEventListener("input", () => this.setSplit(Number(this.#split.value) / 1000));
    this.canvas.addEventListener("light", () => this.#showLight());
    // The line handles the left button; other events are passed to the picture below it.
    this.#line.addEventListener("pointerdown", (event) => (event.button === 0 ? this.#line : this.canvas).setPointerCapture(event.pointerId));
    this.#line.addEventListener("pointermove", (event) => event.buttons & 1 && this.#dragLine(event));
    this.#line.addEventListener("contextmenu", (event) => event.preventDefault());
    this.#line.addEventListener("wheel", (event) => (event.preventDefault(), this.canvas.dispatchEvent(new WheelEvent("wheel", event))));
    // While the key is held, the whole picture uses the correct frames; on release the previous state is restored.
    addEventListener("keydown", (event) => event.key === "b" && !event.repeat && !isTyping(event) && this.#blink(true));
    addEventListener("keyup", (event) => event.key === "b" && this.#blink(false));
    addEventListener("blur", () => this.#blink(false));
    this.#light.addEventListener("pointerdown", (event) => this.#light.setPointerCapture(event.pointerId));
    this.#light.addEventListener("pointermove", (event) => event.buttons && this.#dragLight(event));
    this.#light.addEventListener("keydown", (event) => this.#turnLight(event));
    this.#showLight();
    this.setSplit(0.5);
    this.nameFiles(null);
  }

  setLook(look: Look): void {
    this.viewport.settings.look = look;
    this.#looks.set(look);
    this.#refresh();
  }

  /** Describes the left and right sides. */
  get sides(): string {
    const { look } = this.viewport.settings, right = this.#rightLabel.textContent ?? "";
    return hasSplit(look) || this.viewport.settings.isBeside ? `left ${this.#leftLabel.textContent}, right ${right}` : `${lookNames.find(([name]) => name === look)?.[1]}, the file compared with ${right}`;
  }

  get swatches(): { color: string; text: string }[] {
    return this.#legend.swatches;
  }

  setGround(ground: "gray" | "light" | "dark"): void {
    this.#frame.dataset.ground = ground;
  }

  /** Shows what the picture omits, or why there is none. */
  say(sentence: string): void {
    this.#remark.textContent = sentence;
    this.#remark.hidden = sentence === "";
  }

  setRight(right: Right): void {
    this.#right = right;
    this.#refresh();
  }

  /** Sets the left and right labels when two files are compared; null: default labels. */
  nameFiles(names: readonly [string, string] | null): void {
    this.#leftLabel.textContent = names?.[0] ?? "as in the file";
    this.#otherName = names?.[1] ?? "";
    this.#beside.element.hidden = names === null;
    if (!names) this.setBeside(false);
    this.#refresh();
  }

  /** Shows each file in its own picture, with the same camera. */
  setBeside(on: boolean): void {
    this.#beside.input.checked = on;
    this.#frame.classList.toggle("beside", on);
    this.viewport.setBeside(on);
    this.#refresh();
  }

  setGreen(green: TurnedGreen): void {
    this.#green = green;
    this.#refresh();
  }

  setSplit(share: number): void {
    this.#share = share;
    if (this.#blinks) return;
    this.viewport.settings.split = share;
    this.#split.value = String(Math.round(share * 1000));
    this.#frame.style.setProperty("--split", `${share * 100}%`);
    this.#frame.dataset.side = share > kFixLeftFrom ? "left" : "right";
    this.#leftLabel.style.opacity = share > 0.12 ? "1" : "0";
    this.#rightLabel.style.opacity = share < 0.88 ? "1" : "0";
    this.viewport.ask();
  }

  #refresh(): void {
    const { look } = this.viewport.settings;
    const isSplit = hasSplit(look), { isBeside } = this.viewport.settings;
    this.#split.hidden = !isSplit || isBeside;
    for (const element of [this.#line, this.#leftLabel, this.#rightLabel]) element.hidden = !isSplit && !isBeside;
    this.#rightLabel.textContent = isFile(this.#right) ? (this.#right === "mended" ? "fixed" : this.#otherName) : `correct frames (${this.#right})${greenText[this.#green]}`;
    this.#legend.show(look, nameOf(this.#right));
    this.viewport.ask();
  }

  #blink(isHeld: boolean): void {
    if (this.#blinks === isHeld) return;
    const share = this.#share;
    this.#blinks = false;
    this.setSplit(isHeld ? 0 : share);
    this.#share = share;
    this.#blinks = isHeld;
  }

  #dragLine(event: PointerEvent): void {
    const box = this.canvas.getBoundingClientRect();
    this.setSplit(Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)));
  }

  #dragLight(event: PointerEvent): void {
    const box = this.#light.getBoundingClientRect();
    this.viewport.setLight(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    this.#showLight();
  }

  #turnLight(event: KeyboardEvent): void {
    const step: Record<string, [number, number]> = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
    if (!step[event.key]) return;
    event.preventDefault();
    const { x, y } = this.viewport.light;
    this.viewport.setLight(x + step[event.key][0], y + step[event.key][1]);
    this.#showLight();
  }

  #showLight(): void {
    const { x, y } = this.viewport.light;
    const dot = this.#light.firstElementChild as HTMLElement;
    dot.style.left = `${50 + 42 * x}%`;
    dot.style.top = `${50 - 42 * y}%`;
    this.#light.setAttribute("aria-valuenow", x.toFixed(2));
    this.#light.setAttribute("aria-valuetext", `${x.toFixed(1)} to the right, ${y.toFixed(1)} up`);
  }
}
