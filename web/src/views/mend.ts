// SPDX-License-Identifier: MIT
// Mends the model as `tspace generate` does: what to do, the same as a command line, what changed, and the file.
import { checkbox, choice, count, el, replaceChildren, select } from "../dom.js";
import type { ModelFiles } from "../files.js";
import type { GeneratedPrimitive, GenerateReport, JudgedMap } from "tspace/gltf";
import { methods, type Method } from "../worker/protocol.js";

type Tangents = "repair" | "overwrite" | "missing";

export interface Mended extends ModelFiles {
  report: unknown;
}

const kMostRows = 200;
const actions: Record<string, string> = {
  generated: "added",
  replaced: "computed anew",
  unchanged: "computed anew, same bits",
  kept: "kept",
  notNeeded: "not needed",
  notTriangles: "no triangles",
  impossible: "impossible",
  removed: "taken away",
};

export class MendView {
  readonly element = el("details", { class: "panel mend" }, el("summary", {}, "Mend"));
  #tangents: Tangents = "repair";
  #method: Method = "mikktspace";
  #isTurned = false;
  #turnsGreen = false;
  #isCompressed = false;
  #model: ModelFiles | null = null;
  #unpacks = el("p", { class: "quiet" }, "It goes out unpacked, for this page has no encoders. The tool has.");
  #command = el("code", { class: "command" });
  #button = el("button", { type: "button", class: "main" }, "Mend");
  #result = el("div", { class: "result", "aria-live": "polite" });
  #signs: HTMLFieldSetElement;

  constructor(private generate: (options: Record<string, unknown>) => Promise<Mended>, private open: (mended: Mended) => void) {
    const changed = <T>(set: (value: T) => void) => (value: T) => {
      set(value);
      this.#refresh();
    };
    const tangents = choice("Tangents", [["repair", "repair"], ["overwrite", "all anew"], ["missing", "add missing"]] as const, "repair", changed((v: Tangents) => (this.#tangents = v)));
    const method = select("Method", methods.map((name) => [name, name] as const), this.#method, changed((v: Method) => (this.#method = v)));
    const signs = choice("Signs", [["gltf", "as glTF wants"], ["turned", "turned"]] as const, "gltf", changed((v: string) => (this.#isTurned = v === "turned")));
    const green = checkbox("Turn green of maps where it points down", false, changed((v: boolean) => (this.#turnsGreen = v)));
    this.#signs = signs.element;
    this.#button.addEventListener("click", () => void this.#mend());
    this.element.append(el("div", { class: "rows" }, tangents.element, method.element, signs.element, green.element, this.#unpacks, this.#command, this.#button, this.#result));
    this.#refresh();
  }

  reset(model: ModelFiles | null): void {
    this.#model = model;
    this.#isCompressed = false;
    replaceChildren(this.#result);
    this.#refresh();
  }

  /** The page can unpack geometry, and not pack it. */
  setCompressed(isCompressed: boolean): void {
    this.#isCompressed = isCompressed;
    this.#refresh();
  }

  /** Options of the package, which are those of the tool in camelCase. */
  #options(): Record<string, unknown> {
    return {
      ...(this.#tangents === "repair" && { repair: true }),
      ...(this.#tangents === "overwrite" && { overwrite: true }),
      ...(this.#method !== "mikktspace" && { method: this.#method }),
      ...(this.#tangents === "overwrite" && this.#isTurned && { convention: "opengl" }),
      ...(this.#turnsGreen && { flipGreen: true }),
      ...(this.#isCompressed && { compress: "none" }),
    };
  }

  #refresh(): void {
    // A repair would turn such signs back.
    this.#signs.disabled = this.#tangents !== "overwrite";
    this.#unpacks.hidden = !this.#isCompressed;
    const words = Object.entries(this.#options()).map(([name, value]) => `--${name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}${value === true ? "" : ` ${String(value)}`}`);
    const name = this.#model?.name ?? "model.glb";
    const parts = ["tspace generate", shellWord(name), whole("-o"), shellWord(mendedName(name)), ...words.map(whole)];
    replaceChildren(this.#command, ...parts.flatMap((part, i) => (i === 0 ? [part] : [" ", part])));
    this.#button.disabled = this.#model === null;
  }

  async #mend(): Promise<void> {
    this.#button.disabled = true;
    replaceChildren(this.#result, el("p", { class: "quiet" }, "Working…"));
    try {
      this.#show(await this.generate(this.#options()));
    } catch (error) {
      replaceChildren(this.#result, el("p", { class: "failure", role: "alert" }, error instanceof Error ? error.message : String(error)));
    } finally {
      this.#button.disabled = this.#model === null;
    }
  }

  #show(mended: Mended): void {
    const file = mended.report as GenerateReport;
    const url = URL.createObjectURL(new Blob([mended.bytes], { type: "model/gltf-binary" }));
    const look = el("button", { type: "button", onclick: () => this.open(mended) }, "Look at it");
    replaceChildren(this.#result,
      el("p", { class: file.changed ? "fine" : "quiet" }, file.changed ? `Done: ${count(file.inputBytes)} bytes in, ${count(file.outputBytes)} out.` : "Nothing had to change: the file is the same, byte for byte."),
      changeTable(file.primitives),
      file.normalMaps.length > 0 ? mapTable(file.normalMaps) : null,
      ...file.warnings.map((warning) => el("p", { class: "quiet" }, warning)),
      el("div", { class: "row" }, el("a", { class: "button", href: url, download: mended.name }, `Download ${mended.name}`), look));
  }
}

/** Words of a command line that are not broken at their hyphens. */
const whole = (words: string): HTMLElement => el("span", { class: "whole" }, words);

const shellWord = (name: string): string => (/^[\w./-]+$/.test(name) ? name : `'${name.replaceAll("'", "'\\''")}'`);

/** `crate.glb` becomes `crate-mended.glb`; what comes out of memory is always GLB. */
export const mendedName = (name: string): string => `${name.replace(/^.*\//, "").replace(/\.[^.]*$/, "")}-mended.glb`;

function table(head: string[], rows: { cells: string[]; title?: string }[], extraClass = ""): HTMLElement {
  const body = el("tbody", {}, ...rows.slice(0, kMostRows).map(({ cells, title }) => el("tr", { title }, ...cells.map((text) => el("td", {}, text)))));
  const rest = rows.length - kMostRows;
  if (rest > 0) body.append(el("tr", {}, el("td", { colspan: head.length }, `and ${count(rest)} more`)));
  return el("table", { class: `changes ${extraClass}` }, el("thead", {}, el("tr", {}, ...head.map((text) => el("th", { scope: "col" }, text)))), body);
}

const changeTable = (primitives: GeneratedPrimitive[]): HTMLElement =>
  table(["Part", "Tangents", "Vertices"], primitives.map((one) => {
    const mended = one.mendedVertices > 0 ? `, ${count(one.mendedVertices)} ${one.mendedVertices === 1 ? "vertex" : "vertices"} mended` : "";
    const vertices = one.verticesBefore === one.verticesAfter ? count(one.verticesBefore) : `${count(one.verticesBefore)} → ${count(one.verticesAfter)}`;
    return {
      cells: [`${one.mesh}/${one.primitive} ${one.meshName || one.materialName}`, `${actions[one.action] ?? one.action}${mended}${one.normalsGenerated ? ", normals made" : ""}`, vertices],
      title: [one.reason, ...one.notes].join(" "),
    };
  }));

const mapTable = (maps: JudgedMap[]): HTMLElement =>
  table(["Normal map", "Green"], maps.map(({ image, name, flipped, reason }) => ({ cells: [`${image} ${name}`, flipped ? "turned" : `stays: ${reason}`] })), "maps");
