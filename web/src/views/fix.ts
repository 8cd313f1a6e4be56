// SPDX-License-Identifier: MIT
// Summarizes what is wrong and how to fix it: a sentence above the picture, and a large button next to the split line.
import { el, plural, replaceChildren } from "../dom.js";
import { changeOfCounts, countsText, worstOf, type Plan } from "./advice.js";
import type { CheckReport, Finding } from "tspace/gltf";

/** Formats `87 % confidence`; empty if a finding is certain. */
export const sureText = ({ confidence }: Finding): string => (confidence < 1 ? `${Math.round(100 * confidence)} % confidence` : "");

export class FixView {
  /** The visible effect, above the picture. */
  readonly caption = el("p", { class: "seen", role: "status", tabindex: "-1" });
  /** The fix button, over the picture and next to the split line. */
  readonly element = el("div", { class: "fix", hidden: true });
  #button = el("button", { type: "button", class: "main large" });
  /** The button had the focus when it was pressed; what replaces it receives the focus. */
  #hadFocus = false;

  constructor(private fix: () => void) {
    this.#button.addEventListener("click", () => this.fix());
  }

  wait(): void {
    this.element.hidden = true;
    replaceChildren(this.caption);
    delete this.caption.dataset.severity;
  }

  /** Shows what check found, and what one click will do about it. */
  offer(report: CheckReport, plan: Plan | null): void {
    const worst = worstOf(report);
    this.caption.dataset.severity = worst?.severity ?? "fine";
    const kinds = new Set(report.findings.filter(({ severity }) => severity !== "note").map(({ code }) => code)).size;
    const others = kinds > 1 ? ` And ${plural(kinds - 1, "other fault")}.` : "";
    replaceChildren(this.caption, worst && el("strong", {}, worst.effect), worst ? `${others} ${sureText(worst)}` : `No errors were found${report.counts.note > 0 ? `; ${plural(report.counts.note, "note")}` : ""}.`);
    this.element.hidden = plan === null;
    if (!plan) return this.#passFocus(this.caption);
    const left = plan.left > 0 ? ` ${plural(plan.left, "fault")} must be fixed in the program that made the model.` : "";
    this.#button.disabled = false;
    replaceChildren(this.#button, el("strong", {}, "Fix it"), el("span", {}, `${plan.steps.join(", ")}${left === "" ? "" : "."}${left}`), el("span", {}, "Shows the result, for you to download. Your file is not changed."));
    replaceChildren(this.element, this.#button);
  }

  working(): void {
    this.#hadFocus = document.activeElement === this.#button;
    this.#button.disabled = true;
    replaceChildren(this.#button, el("strong", {}, "Fixing…"));
  }

  failed(message: string): void {
    this.caption.dataset.severity = "error";
    replaceChildren(this.caption, el("strong", {}, `The fix failed: ${message}`));
    this.element.hidden = true;
    this.#passFocus(this.caption);
  }

  /** Compares two versions by the counts of `check`. */
  compare(names: [string, string], counts: [CheckReport["counts"], CheckReport["counts"]]): void {
    this.element.hidden = true;
    delete this.caption.dataset.severity;
    replaceChildren(this.caption, el("strong", {}, "Two versions: "), `left ${names[0]} (${countsText(counts[0])}), right ${names[1]} (${countsText(counts[1])}). Difference and Error show the angles between them.`);
  }

  /** Reports a fixed file, which is now right of the split line. `rest`: a plan for the remaining findings. */
  done(name: string, url: string, before: CheckReport["counts"], after: CheckReport["counts"] | null, rest: Plan | null): void {
    const isFixed = after !== null && after.error + after.warning === 0;
    this.caption.dataset.severity = isFixed || after === null ? "fine" : after.error > 0 ? "error" : "warning";
    const counts = after === null ? "" : ` ${changeOfCounts(before, after)}.`;
    replaceChildren(this.caption, el("strong", {}, isFixed ? "Fixed:" : after ? `Fixed in part, ${countsText(after)} left:` : "Done:"), `${counts} Left of the line: before. Right: after.`);
    this.element.hidden = false;
    this.#button.disabled = false;
    if (rest) replaceChildren(this.#button, el("strong", {}, "Fix the rest"), el("span", {}, rest.steps.join(", ")));
    const download = el("a", { class: "button large", href: url, download: name }, el("strong", {}, "Download"), el("span", {}, name));
    replaceChildren(this.element, rest && this.#button, download);
    this.#passFocus(rest ? this.#button : download);
  }

  #passFocus(to: HTMLElement): void {
    if (this.#hadFocus) to.focus();
    this.#hadFocus = false;
  }
}
