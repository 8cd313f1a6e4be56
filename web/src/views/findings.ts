// SPDX-License-Identifier: MIT
// Lists findings by kind: the visible effect, the cause, the fix, and each location. Also shows which tool computed the
// tangents.
import { count, el, plural, replaceChildren } from "../dom.js";
import { remedyOptions } from "./advice.js";
import { figureLink } from "../lesson.js";
import { sureText } from "./fix.js";
import type { CheckReport, Finding, Severity } from "tspace/gltf";

const severities = ["error", "warning", "note"] as const;
const titles: Record<Severity, string> = { error: "Errors: wrong shading", warning: "Warnings: possibly wrong shading", note: "Notes" };
/** From this number of kinds or locations on, there is a filter field. */
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
  /** Selects all findings of a kind, or one of them. */
  choose: (findings: Finding[], isOne: boolean) => void;
  addToFix: (finding: Finding) => void;
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
    this.element.append(el("h2", {}, "What is wrong"), this.#list, el("h2", {}, "Method of the tangents"), this.#verdict);
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

  /** Opens the entry of a finding, by its index in the report, unless it is open. */
  openFinding(number: number): void {
    const finding = this.#findings[number], found = this.#groups.find(({ group }) => group.findings.includes(finding));
    if (found && !(this.#open && found.element.contains(this.#open.button))) found.element.querySelector("button")?.click();
  }

  /** Index of the first finding of the open entry, or null. */
  get chosen(): number | null {
    const open = this.#open, found = this.#groups.find(({ element }) => open !== null && element.contains(open.button));
    return found ? this.#findings.indexOf(found.group.findings[0]) : null;
  }

  /** Lists the findings of a file. `isFixed`: the file is the fixed one rather than the one that was opened. */
  show(file: CheckReport, isFixed = false): void {
    this.#findings = file.findings;
    this.#open = null;
    const groups = grouped(file.findings);
    const summary = el("p", { class: "summary" });
    for (const severity of severities) {
      const n = file.counts[severity];
      summary.append(el("span", { class: `badge ${severity}${n === 0 ? " none" : ""}` }, plural(n, severity)));
    }
    const looked = file.image ? mapText(file.image) : `Examined: ${plural(file.primitives, "primitive")}, ${count(file.primitivesWithTangents)} with tangents; ${file.normalMaps === 0 ? "no normal map." : `${plural(file.normalMaps, "normal map")}; the relief of ${count(file.normalMapsWithGreen)} shows the direction of green.`}`;
    this.#filter.value = "";
    replaceChildren(this.#list, summary, isFixed && el("p", { class: "fine after" }, "These are the findings of the fixed file."), file.findings.length >= kFilterFrom && this.#filter);
    if (groups.length === 0) this.#list.append(el("p", { class: "fine" }, "No errors were found."));
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
    this.#list.append(el("p", { class: "quiet looked" }, looked));
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
    const isOne = findings.length === 1, sure = findings.map(sureText).find((text) => text !== "") ?? "";
    const details = el("div", { class: "details", hidden: true },
      el("p", { class: "mend" }, el("strong", {}, "Fix: "), first.remedy),
      sure !== "" && el("p", {}, el("strong", {}, `${sure}: `), "the finding is a statistical estimate from the texture or mesh."),
      remedyOptions(first) && el("button", { class: "plain mend-this", type: "button", onclick: () => this.choices.addToFix(first) }, "Add this to the fix"),
      figureLink(code),
      isOne ? firstVertices(first) : this.#steps(findings));
    const button = el("button", { class: `finding ${severity}`, type: "button", "aria-expanded": "false", "data-code": code },
      el("span", { class: "effect" }, first.effect),
      el("span", { class: "message" }, isOne ? first.cause : first.summary),
      el("span", { class: "quiet" }, [isOne ? placeOf(first) : `${plural(findings.length, "location")}, the first: ${placeOf(first)}`, sure].filter(Boolean).join("; ")),
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

  /** Returns buttons that step through the locations. */
  #steps(findings: Finding[]): HTMLElement {
    let at = -1;
    const text = el("p", { class: "quiet step", "aria-live": "polite" }, `${plural(findings.length, "location")}, all of them shown`);
    const go = (step: number) => {
      at = (at + step + (at < 0 && step < 0 ? 1 : 0) + findings.length) % findings.length;
      const finding = findings[at];
      replaceChildren(text, el("strong", {}, `${at + 1} of ${findings.length}: `), `${placeOf(finding)}: ${finding.cause}`);
      this.choices.choose([finding], true);
    };
    const button = (name: string, step: number) => el("button", { type: "button", class: "small", onclick: () => go(step) }, name);
    return el("div", { class: "steps" }, el("div", { class: "row" }, button("Previous", -1), button("Next", 1)), text);
  }
}

const contents: Record<string, string> = {
  normals: "a normal map in tangent space, as glTF requires", twoChannels: "a normal map that stores only x and y", unsignedZ: "a normal map that stores z unsigned in blue", xInAlpha: "a normal map that stores x in alpha (DXT5nm)",
  exchanged: "a normal map with exchanged channels", encoded: "a normal map that was stored as a color image (sRGB)", hemiOctahedral: "a normal map in hemi-octahedral encoding", objectSpace: "a normal map in object space",
  height: "a height map", picture: "a color image, not a normal map", constant: "one color",
};
const greens: Record<string, string> = { up: "Green points up, as in glTF and OpenGL", down: "Green points down, as in DirectX", mixed: "Green points up in one part and down in another" };

/** Describes a lone normal map. */
function mapText({ width, height, content, green, greenConfidence }: NonNullable<CheckReport["image"]>): string {
  const direction = greens[green] ? `${greens[green]} (${Math.round(100 * greenConfidence)} % confidence, if red points right)` : "The relief does not show in which direction green points";
  return `${width} x ${height} texels: ${contents[content] ?? content}.${content === "picture" || content === "height" || content === "constant" ? "" : ` ${direction}.`}`;
}

const firstVertices = ({ vertices }: Finding): HTMLElement | false => vertices.length > 0 && el("p", { class: "quiet" }, `First at vertices ${vertices.join(", ")}.`);

/** Describes the location of a finding with the names in the file. */
function placeOf({ mesh, primitive, meshName, materialName, place }: Finding): string {
  if (place === "") return "";
  const parts = [mesh >= 0 && `mesh ${mesh}${meshName ? ` “${meshName}”` : ""}, primitive ${primitive}`, materialName && `material “${materialName}”`].filter(Boolean);
  return parts.length > 0 ? parts.join(", ") : `at ${place}`;
}
