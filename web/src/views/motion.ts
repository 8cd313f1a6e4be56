// SPDX-License-Identifier: MIT
// Controls for animations, morph weights and cameras, shown if a file has them.
import { el, replaceChildren, select } from "../dom.js";
import { Motion } from "../model/motion.js";
import type { Viewport } from "../picture/viewport.js";

const kMostSliders = 60;

export class MotionView {
  readonly element = el("details", { class: "panel motion", hidden: true }, el("summary", {}, "Motion and cameras"));
  #rows = el("div", { class: "rows" });
  #motion: Motion | null = null;
  #time = el("input", { type: "range", min: "0", max: "1", step: "any", value: "0", "aria-label": "Time of the animation" });
  #play = el("button", { type: "button", "aria-pressed": "false" }, "Play");
  #seconds = 0;
  #length = 0;
  #last = 0;
  #isPlaying = false;

  constructor(private viewport: Viewport) {
    this.element.append(this.#rows);
    this.#play.addEventListener("click", () => this.#setPlaying(!this.#isPlaying));
    this.#time.addEventListener("input", () => {
      this.#setPlaying(false);
      this.#show(Number(this.#time.value) * this.#length);
    });
  }

  reset(motion: Motion | null): void {
    this.#setPlaying(false);
    this.#motion = motion;
    this.#length = this.#seconds = 0;
    const sliders = motion?.sliders().slice(0, kMostSliders) ?? [];
    this.element.hidden = !motion || motion.clips.length + motion.cameras.length + sliders.length === 0;
    if (!motion) return replaceChildren(this.#rows);
    const clips = motion.clips.map(({ name }, i) => [String(i), name || `animation ${i}`] as const);
    const cameras = motion.cameras.map(({ name }, i) => [String(i), name || `camera ${i}`] as const);
    const moving = el("div", { class: "row", hidden: true }, this.#play, this.#time);
    replaceChildren(this.#rows,
      clips.length > 0 && select("Animation", [["", "none (pose of the file)"], ...clips] as const, "", (value) => {
        moving.hidden = value === "";
        this.#choose(value === "" ? null : Number(value));
      }).element,
      moving,
      cameras.length > 0 && select("Camera", [["", "…"], ...cameras] as const, "", (value) => {
        if (value !== "") this.viewport.lookFrom(Motion.viewOf(motion.cameras[Number(value)], this.viewport.scene.sphere().radius));
      }).element,
      ...sliders.map(({ name, get, set }) => {
        const input = el("input", { type: "range", min: "0", max: "1", step: "any", value: get() });
        input.addEventListener("input", () => {
          set(Number(input.value));
          this.#redraw();
        });
        return el("label", { class: "select" }, el("span", {}, name), input);
      }));
  }

  #choose(clip: number | null): void {
    const chosen = clip === null ? null : this.#motion!.clips[clip];
    this.#motion!.choose(chosen);
    this.#length = chosen?.duration ?? 0;
    this.#setPlaying(chosen !== null && !matchMedia("(prefers-reduced-motion: reduce)").matches);
    this.#show(0);
  }

  #setPlaying(on: boolean): void {
    if (on === this.#isPlaying) return;
    this.#isPlaying = on;
    this.#play.textContent = on ? "Pause" : "Play";
    this.#play.setAttribute("aria-pressed", String(on));
    if (!on) return;
    this.#last = performance.now();
    requestAnimationFrame((now) => this.#tick(now));
  }

  #tick(now: number): void {
    if (!this.#isPlaying || !this.#motion) return;
    this.#show(this.#length > 0 ? (this.#seconds + (now - this.#last) / 1000) % this.#length : 0);
    this.#last = now;
    requestAnimationFrame((next) => this.#tick(next));
  }

  #show(seconds: number): void {
    this.#seconds = seconds;
    this.#time.value = String(this.#length > 0 ? seconds / this.#length : 0);
    this.#motion?.at(seconds);
    this.#redraw();
  }

  #redraw(): void {
    this.viewport.scene.repose();
    this.viewport.ask();
  }
}
