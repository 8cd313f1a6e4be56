// SPDX-License-Identifier: MIT
// What is wrong, a kind of finding at a time: a sentence, why it matters, how to mend it, and the places one after another. Also
// who made the tangents.
import { count, el, plural, replaceChildren } from "../dom.js";
import { remedyOptions } from "./advice.js";
import { figureLink } from "../lesson.js";
import meanings from "virtual:meanings";
import type { CheckReport, Finding, Severity } from "tspace/gltf";

const severities = ["error", "warning", "note"] as const;
const titles: Record<Severity, string> = { error: "Errors", warning: "Warnings", note: "Notes" };
/** From so many kinds or places on there is a field to filter them. */
const kFilterFrom = 6;

/** Findings of one kind. */
interface Group {
  code: string;
  severity: Severity;
  findings: Finding[];
}

function grouped(findings: Finding[]): Group[] {
  const groups = new Map<string, Group>();
  for (const finding of findings) {
    const key = `${finding.severity} ${finding.code}`, group = groups.get(key);
    if (group) group.findings.push(finding);
    else groups.set(key, { code: finding.code, severity: finding.severity, findings: [finding] });
  }
  return [...groups.values()];
}

export interface Choices {
  /** All findings of a kind, or one of them. */
  choose: (findings: Finding[], isOne: boolean) => void;
  mend: (finding: Finding) => void;
}

export class FindingsView {
  readonly element = el("section", { class: "panel findings", "aria-label": "Findings" });
  #verdict = el("p", { class: "verdict" });
  #list = el("div", { class: "list" });
  #open: { button: HTMLButtonElement; details: HTMLElement } | null = null;
  #filter = el("input", { type: "search", class: "filter", placeholder: "Filter by kind, part or material", "aria-label": "Filter the findings" });
  #findings: Finding[] = [];
  #groups: { group: Group; element: HTMLElement }[] = [];

  constructor(private choices: Choices) {
    this.#filter.addEventListener("input", () => this.#applyFilter());
    this.element.append(el("h2", {}, "What is wrong"), this.#list, el("h2", {}, "Who made the tangents"), this.#verdict);
    this.wait("Open a model to see its findings.");
  }

  wait(text: string): void {
    this.#open = null;
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

  /** Opens the entry of a finding, by its number in the report, where it is not open. */
  openFinding(number: number): void {
    const finding = this.#findings[number], found = this.#groups.find(({ group }) => group.findings.includes(finding));
    if (found && !(this.#open && found.element.contains(this.#open.button))) found.element.querySelector("button")?.click();
  }

  /** The number of the first finding of the entry that is open. */
  get chosen(): number | null {
    const open = this.#open, found = this.#groups.find(({ element }) => open !== null && element.contains(open.button));
    return found ? this.#findings.indexOf(found.group.findings[0]) : null;
  }

  show(file: CheckReport): void {
    this.#findings = file.findings;
    this.#open = null;
    const groups = grouped(file.findings);
    const summary = el("p", { class: "summary" });
    for (const severity of severities) {
      const n = file.counts[severity];
      summary.append(el("span", { class: `badge ${severity}${n === 0 ? " none" : ""}` }, plural(n, severity)));
    }
    const looked = `${plural(file.primitives, "primitive")}, ${count(file.primitivesWithTangents)} with tangents; ${file.normalMaps === 0 ? "no normal map to look at." : `looked at ${plural(file.normalMaps, "normal map")}: what the channels hold, and which way green points (told by ${count(file.normalMapsWithGreen)}).`}`;
    this.#filter.value = "";
    replaceChildren(this.#list, summary, el("p", { class: "quiet" }, looked), file.findings.length >= kFilterFrom && this.#filter);
    if (groups.length === 0) this.#list.append(el("p", { class: "fine" }, "Nothing is wrong."));
    this.#groups = [];
    for (const severity of severities) {
      const own = groups.filter((group) => group.severity === severity);
      if (own.length === 0) continue;
      const items = el("ul", { "aria-label": titles[severity] });
      for (const group of own) {
        const element = el("li", {}, ...this.#item(group));
        this.#groups.push({ group, element });
        items.append(element);
      }
      this.#list.append(el("h3", {}, titles[severity]), items);
    }
  }

  #applyFilter(): void {
    const wanted = this.#filter.value.trim().toLowerCase();
    for (const { group, element } of this.#groups) {
      const text = group.findings.map((finding) => `${finding.code} ${finding.message} ${placeOf(finding)} ${finding.place}`).join(" ");
      element.hidden = !text.toLowerCase().includes(wanted);
    }
  }

  #item(group: Group): HTMLElement[] {
    const { code, severity, findings } = group, [first] = findings;
    const meaning = meanings[code];
    const isOne = findings.length === 1;
    const details = el("div", { class: "details", hidden: true },
      meaning && el("p", {}, el("strong", {}, "What it does: "), meaning.why, "."),
      el("p", { class: "mend" }, el("strong", {}, "Mend: "), first.remedy),
      remedyOptions(first) && el("button", { class: "plain mend-this", type: "button", onclick: () => this.choices.mend(first) }, "Set Mend to this"),
      figureLink(code),
      isOne ? firstVertices(first) : this.#steps(findings));
    const button = el("button", { class: `finding ${severity}`, type: "button", "aria-expanded": "false", "data-code": code },
      el("span", { class: "message" }, isOne || !meaning ? first.message : meaning.what),
      el("span", { class: "quiet" }, isOne ? placeOf(first) : `${plural(findings.length, "place")}, the first: ${placeOf(first)}`),
      el("span", { class: "code" }, isOne && first.place !== "" ? `${code} ${first.place}` : code));
    button.addEventListener("click", () => this.#toggle(button, details, findings));
    return [button, details];
  }

  #toggle(button: HTMLButtonElement, details: HTMLElement, findings: Finding[]): void {
    const isOpening = details.hidden;
    if (this.#open && this.#open.button !== button) {
      this.#open.button.setAttribute("aria-expanded", "false");
      this.#open.details.hidden = true;
    }
    button.setAttribute("aria-expanded", String(isOpening));
    details.hidden = !isOpening;
    this.#open = isOpening ? { button, details } : null;
    if (isOpening) this.choices.choose(findings, findings.length === 1);
  }

  /** One place after another. */
  #steps(findings: Finding[]): HTMLElement {
    let at = -1;
    const text = el("p", { class: "quiet step", "aria-live": "polite" }, `${plural(findings.length, "place")}: all of them are shown.`);
    const go = (step: number) => {
      at = (at + step + (at < 0 && step < 0 ? 1 : 0) + findings.length) % findings.length;
      const finding = findings[at];
      replaceChildren(text, el("strong", {}, `${at + 1} of ${findings.length}: `), `${placeOf(finding)}: ${finding.message}`);
      this.choices.choose([finding], true);
    };
    const button = (name: string, step: number) => el("button", { type: "button", class: "small", onclick: () => go(step) }, name);
    return el("div", { class: "steps" }, el("div", { class: "row" }, button("Previous", -1), button("Next", 1)), text);
  }
}

const firstVertices = ({ vertices }: Finding): HTMLElement | false => vertices.length > 0 && el("p", { class: "quiet" }, `First at vertices ${vertices.join(", ")}.`);

/** Where, in words: the names that a person gave. */
function placeOf({ mesh, primitive, meshName, materialName, place }: Finding): string {
  if (place === "") return "";
  const parts = [mesh >= 0 && `mesh ${mesh}${meshName ? ` “${meshName}”` : ""}, primitive ${primitive}`, materialName && `material “${materialName}”`].filter(Boolean);
  return parts.length > 0 ? parts.join(", ") : `at ${place}`;
}
