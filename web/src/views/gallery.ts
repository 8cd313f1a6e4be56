// SPDX-License-Identifier: MIT
// Gallery of the samples as clickable pictures.
import { el } from "../dom.js";
import { samples, type Sample } from "../samples.js";

export class GalleryView {
  readonly element: HTMLElement;
  #buttons: HTMLButtonElement[];

  constructor(open: (sample: Sample) => void) {
    this.#buttons = samples.map((sample) =>
      el("button", { type: "button", class: "sample", "data-file": sample.file, title: sample.hint, "aria-pressed": "false", onclick: () => open(sample) },
        el("img", { src: sample.picture, alt: "", width: 72, height: 48 }), el("span", {}, sample.name)));
    this.element = el("nav", { class: "samples", "aria-label": "Samples" }, el("p", { class: "quiet" }, "Examples"), ...this.#buttons);
  }

  /** Marks the sample that is shown, by file name. */
  mark(file: string | null): void {
    for (const button of this.#buttons) button.setAttribute("aria-pressed", String(button.dataset.file === file));
  }
}
