// SPDX-License-Identifier: MIT
// What is wrong, by severity, and who made the tangents.
import { count, el, plural, replaceChildren } from "../dom.js";
import { remedyOptions } from "./advice.js";
import type { CheckReport, Finding, Severity } from "tspace/gltf";

const titles: Record<Severity, string> = { error: "Errors", warning: "Warnings", note: "Notes" };
const kFirst = 60;

export class FindingsView {
  readonly element = el("section", { class: "panel findings", "aria-label": "Findings" });
  #verdict = el("p", { class: "verdict" });
  #list = el("div", { class: "list" });
  #chosen: HTMLButtonElement | null = null;

  constructor(private choose: (finding: Finding) => void, private mend: (finding: Finding) => void) {
    this.element.append(el("h2", {}, "What is wrong"), this.#list, el("h2", {}, "Who made the tangents"), this.#verdict);
    this.wait("Open a model to see its findings.");
  }

  wait(text: string): void {
    this.#chosen = null;
    replaceChildren(this.#list, el("p", { class: "quiet" }, text));
    replaceChildren(this.#verdict, "–");
  }

  fail(message: string): void {
    replaceChildren(this.#list, el("p", { class: "failure", role: "alert" }, message));
    replaceChildren(this.#verdict, "–");
  }

  showVerdict(text: string): void {
    replaceChildren(this.#verdict, text);
  }

  show(file: CheckReport): void {
    this.#chosen = null;
    const { findings } = file;
    const summary = el("p", { class: "summary" });
    for (const severity of ["error", "warning", "note"] as const) {
      const n = file.counts[severity];
      summary.append(el("span", { class: `badge ${severity}${n === 0 ? " none" : ""}` }, plural(n, severity)));
    }
    const looked = `${plural(file.primitives, "primitive")}, ${count(file.primitivesWithTangents)} with tangents; looked at ${plural(file.normalMaps, "normal map")}: what the channels hold, and which way green points (told by ${count(file.normalMapsWithGreen)}).`;
    replaceChildren(this.#list, summary, el("p", { class: "quiet" }, looked));
    if (findings.length === 0) this.#list.append(el("p", { class: "fine" }, "Nothing is wrong."));
    for (const severity of ["error", "warning", "note"] as const) {
      const own = findings.filter((finding) => finding.severity === severity);
      if (own.length === 0) continue;
      const items = el("ul", { "aria-label": titles[severity] });
      for (const finding of own.slice(0, kFirst)) items.append(el("li", {}, this.#item(finding)));
      const rest = own.slice(kFirst);
      if (rest.length > 0) {
        const more = el("button", { class: "plain", type: "button" }, `Show ${count(rest.length)} more`);
        more.addEventListener("click", () => {
          const focus = items.children.length;
          more.parentElement!.remove();
          for (const finding of rest) items.append(el("li", {}, this.#item(finding)));
          items.children[focus - 1]?.querySelector("button")?.focus();
        });
        items.append(el("li", {}, more));
      }
      this.#list.append(el("h3", {}, titles[severity]), items);
    }
  }

  #item(finding: Finding): HTMLElement {
    const where = placeOf(finding);
    const details = el("div", { class: "details", hidden: true },
      el("p", { class: "mend" }, el("strong", {}, "Mend: "), finding.remedy),
      remedyOptions(finding) && el("button", { class: "plain mend-this", type: "button", onclick: () => this.mend(finding) }, "Set Mend to this"),
      finding.vertices.length > 0 && el("p", { class: "quiet" }, `First at vertices ${finding.vertices.join(", ")}.`));
    const button = el("button", { class: `finding ${finding.severity}`, type: "button", "aria-expanded": "false", "data-code": finding.code },
      el("span", { class: "code" }, finding.code),
      el("span", { class: "message" }, finding.message),
      where && el("span", { class: "quiet" }, where));
    button.addEventListener("click", () => {
      const isOpen = button.getAttribute("aria-expanded") === "true";
      if (this.#chosen && this.#chosen !== button) this.#fold(this.#chosen);
      button.setAttribute("aria-expanded", String(!isOpen));
      details.hidden = isOpen;
      this.#chosen = isOpen ? null : button;
      if (!isOpen) this.choose(finding);
    });
    return el("div", {}, button, details);
  }

  #fold(button: HTMLButtonElement): void {
    button.setAttribute("aria-expanded", "false");
    (button.nextElementSibling as HTMLElement).hidden = true;
  }
}

/** Where, in words: the names that a person gave, and the place in the file. */
function placeOf({ mesh, primitive, meshName, materialName, place }: Finding): string {
  if (place === "") return "";
  const parts = [mesh >= 0 && `mesh ${mesh}${meshName ? ` “${meshName}”` : ""}, primitive ${primitive}`, materialName && `material “${materialName}”`];
  return [...parts.filter(Boolean), `at ${place}`].join(", ");
}
