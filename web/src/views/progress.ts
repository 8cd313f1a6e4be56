// SPDX-License-Identifier: MIT
// The current task, its progress, and a button that cancels it.
import { el } from "../dom.js";

export class Progress {
  readonly element: HTMLElement;
  #text = el("span", { role: "status", tabindex: "-1" });
  #bar = el("progress", { max: "1", value: "0", "aria-label": "Progress" });
  #stop = el("button", { type: "button", class: "stop" }, "Stop");

  constructor(stop: () => void) {
    this.#stop.addEventListener("click", stop);
    this.element = el("div", { class: "progress" }, this.#text, this.#bar, this.#stop);
    this.done("");
  }

  at(text: string, share: number): void {
    this.#text.textContent = text;
    this.#bar.value = share;
    this.element.classList.add("busy");
    this.#bar.hidden = this.#stop.hidden = false;
  }

  done(text: string): void {
    this.#text.textContent = text;
    this.element.classList.remove("busy");
    if (document.activeElement === this.#stop) this.#text.focus(); // the button disappears
    this.#bar.hidden = this.#stop.hidden = true;
  }
}
