// SPDX-License-Identifier: MIT
// Fixes the model like `tspace generate`: options, the equivalent command line, the changes, and the file. Each model
// starts with the options that its own findings require.
import { folderOf, zipOf } from "../model/folder.js";
import { checkbox, choice, count, disabledDuring, el, plural, replaceChildren, select } from "../dom.js";
import { fixedMapName, isMapName, type ModelFiles } from "../files.js";
import type { CheckReport, Finding, GeneratedPrimitive, GenerateReport, JudgedMap } from "tspace/gltf";
import { methods, type MapReading, type Method } from "../worker/protocol.js";
import { adviceFor, changeOfCounts, isWorse, mapReading, noExtras, remedyOptions, type Extras, type Tangents } from "./advice.js";

export interface FixedModel extends ModelFiles {
  report: unknown;
  /** The download, if it is not the model itself: the image of a lone normal map. */
  download?: { bytes: Uint8Array<ArrayBuffer>; type: string };
  /** Check report of the written file; null if it could not be checked. */
  checked: CheckReport | null;
}

/** Callbacks about a fix for other parts of the page. */
export interface Told {
  started: () => void;
  /** `url`: URL of the file, valid until the next fix. `isChanged`: its bytes differ from those of the opened file. */
  done: (fixed: FixedModel, url: string, isChanged: boolean) => void;
  failed: (message: string) => void;
}

const kMostRows = 200;
const actions: Record<string, string> = {
  generated: "added",
  replaced: "recomputed",
  unchanged: "recomputed, unchanged",
  kept: "kept",
  notNeeded: "not needed",
  notTriangles: "no triangles",
  impossible: "impossible",
  removed: "removed",
};
/** Switches in the order of the panel. All except the first are shown only if a finding requires them. */
const switches: readonly (readonly [keyof Extras, string])[] = [
  ["flipGreen", "Invert green in maps where it points down"],
  ["fixMaps", "Convert maps that are not encoded as glTF requires"],
  ["morphNormals", "Compute normals of morph targets"],
  ["overwriteNormals", "Recompute all normals"],
  ["fixWinding", "Flip triangles wound against their neighbors"],
  ["denoise", "Recompute all normals without the noise of the positions"],
  ["strip", "Remove tangents that no material needs"],
];

export class FixOptionsView {
  readonly element = el("details", { class: "panel mend" }, el("summary", {}, "Fix options"));
  #tangents: Tangents = "repair";
  #method: Method = "mikktspace";
  #isTurned = false;
  #extras: Extras = noExtras;
  /** Switches that the user has set; advice does not change them. */
  #touched = new Set<keyof Extras>();
  /** Options of a finding's own fix button, in addition to the advice. */
  #wanted: Partial<Extras> = {};
  #isCompressed = false;
  #model: ModelFiles | null = null;
  #checked: CheckReport | null = null;
  #reasons = el("div", { class: "reasons" });
  #unpacks = el("p", { class: "quiet" }, "The fixed file is not compressed, because this page has no encoders. The command-line tool can compress it.");
  #command = el("code", { class: "command" });
  #button = el("button", { type: "button", class: "main" }, "Fix with these options");
  #result = el("div", { class: "result", "aria-live": "polite" });
  #tangentsChoice;
  #methodChoice;
  #signsChoice;
  #boxes = new Map<keyof Extras, { element: HTMLElement; input: HTMLInputElement }>();

  /** Object URLs of the result, which are revoked with it. */
  #urls: string[] = [];

  constructor(private generate: (options: Record<string, unknown>) => Promise<FixedModel>, private open: (fixed: FixedModel) => void, private told: Told) {
    const changed = <T>(set: (value: T) => void) => (value: T) => {
      set(value);
      this.#refresh();
    };
    this.#tangentsChoice = choice("Tangents", [["repair", "repair"], ["overwrite", "recompute all"], ["missing", "add missing"]] as const, "repair", changed((v: Tangents) => (this.#tangents = v)));
    this.#methodChoice = select("Method", methods.map((name) => [name, name] as const), this.#method, changed((v: Method) => (this.#method = v)));
    this.#signsChoice = choice("Signs", [["gltf", "as in glTF"], ["turned", "inverted"]] as const, "gltf", changed((v: string) => (this.#isTurned = v === "turned")));
    for (const [name, text] of switches) {
      this.#boxes.set(name, checkbox(text, false, changed((on: boolean) => {
        this.#touched.add(name);
        this.#extras = { ...this.#extras, [name]: name === "morphNormals" ? (on ? "all" : null) : on };
      })));
    }
    this.#button.addEventListener("click", () => void this.#fix());
    this.element.append(el("div", { class: "rows" }, this.#tangentsChoice.element, this.#methodChoice.element, this.#signsChoice.element,
      ...[...this.#boxes.values()].map(({ element }) => element), this.#reasons, this.#unpacks, this.#command, this.#button, this.#result));
    this.#refresh();
  }

  /** Resets everything for another model. */
  reset(model: ModelFiles | null): void {
    this.#model = model;
    this.#checked = null;
    this.#isCompressed = false;
    this.#tangents = "repair";
    this.#method = "mikktspace";
    this.#isTurned = false;
    this.#touched.clear();
    this.#wanted = {};
    this.#tangentsChoice.set("repair");
    this.#methodChoice.input.value = "mikktspace";
    this.#signsChoice.set("gltf");
    this.#forgetResult();
    this.#refresh();
  }

  /** Sets whether the model is compressed: the page can decompress geometry, but not compress it. */
  setCompressed(isCompressed: boolean): void {
    this.#isCompressed = isCompressed;
    this.#refresh();
  }

  /** Turns on the switches that fix the findings of the report. */
  advise(report: CheckReport): void {
    this.#checked = report;
    this.#refresh();
  }

  /** Sets the panel to the remedy of a finding, and shows it. */
  prepare(finding: Finding): void {
    const options = remedyOptions(finding);
    if (!options) return;
    const { tangents, ...extras } = options;
    if (tangents) {
      this.#tangents = tangents;
      this.#tangentsChoice.set(tangents);
    }
    this.#wanted = { ...this.#wanted, ...extras };
    for (const name of Object.keys(extras)) this.#touched.delete(name as keyof Extras);
    this.#refresh();
    (this.element as HTMLDetailsElement).open = true;
    this.element.scrollIntoView({ block: "nearest" });
    this.#button.focus();
  }

  /** Fixes all findings with one click, with the given treatment of tangents. */
  async run(tangents: Tangents): Promise<void> {
    this.#tangents = tangents;
    this.#tangentsChoice.set(tangents);
    this.#refresh();
    await this.#fix();
  }

  /** Returns the options of the package, which are those of the tool in camelCase. */
  #options(): Record<string, unknown> {
    const { flipGreen, fixMaps, overwriteNormals, denoise, fixWinding, strip, morphNormals } = this.#extras;
    return {
      ...(this.#tangents === "repair" && { repair: true }),
      ...(this.#tangents === "overwrite" && { overwrite: true }),
      ...(this.#method !== "mikktspace" && { method: this.#method }),
      ...(this.#tangents === "overwrite" && this.#isTurned && { convention: "opengl" }),
      ...(flipGreen && { flipGreen: true }),
      ...(fixMaps && { fixMaps }),
      ...(morphNormals && { morphNormals }),
      ...(fixWinding && { fixWinding }),
      ...((overwriteNormals || denoise) && { overwriteNormals: true }),
      ...(denoise && { normals: "best", denoise: "auto" }),
      ...(strip && { strip: true }),
      ...(this.#isCompressed && { compress: "none" }),
    };
  }

  /** Sets the switches that the user has not set according to the findings. */
  #takeAdvice(): void {
    const { extras, reasons } = adviceFor(this.#checked, this.#tangents, this.#isTurned);
    const advised: Extras = { ...extras, ...this.#wanted };
    const set = <K extends keyof Extras>(name: K) => {
      if (!this.#touched.has(name)) this.#extras = { ...this.#extras, [name]: advised[name] };
      const { element, input } = this.#boxes.get(name)!;
      input.checked = Boolean(this.#extras[name]);
      element.hidden = name !== "flipGreen" && !advised[name] && !this.#extras[name];
    };
    for (const [name] of switches) set(name);
    replaceChildren(this.#reasons, ...reasons.map((reason) => el("p", { class: "quiet" }, reason)));
  }

  #refresh(): void {
    this.#takeAdvice();
    // Intentionally inverted signs are written only if all tangents are recomputed; a repair would correct them.
    this.#signsChoice.element.disabled = this.#tangents !== "overwrite";
    this.#unpacks.hidden = !this.#isCompressed;
    this.#button.disabled = this.#model === null;
    const words = Object.entries(this.#options()).map(([name, value]) => `--${name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}${value === true ? "" : ` ${String(value)}`}`);
    const name = this.#model?.name ?? "model.glb";
    if (isMapName(name)) return void replaceChildren(this.#command, `tspace convert-map ${shellWord(name)} -o ${shellWord(fixedName(name))}${this.#mapOptions()}`);
    const parts = ["tspace generate", shellWord(name), whole("-o"), shellWord(fixedName(name)), ...words.map(whole)];
    replaceChildren(this.#command, ...parts.flatMap((part, i) => (i === 0 ? [part] : [" ", part])));
  }

  /** Returns the options of `convert-map` for a lone normal map. */
  #mapOptions(): string {
    const { channels, curve, flipRed, flipGreen }: MapReading = (this.#checked && mapReading(this.#checked)?.reading) ?? {};
    return `${channels ? ` --channels ${channels}` : ""}${curve ? ` --${curve}` : ""}${flipRed ? " --flip-red" : ""}${flipGreen ? " --flip-green" : ""}`;
  }

  #forgetResult(): void {
    for (const url of this.#urls) URL.revokeObjectURL(url);
    this.#urls = [];
    replaceChildren(this.#result);
  }

  #urlOf(bytes: Uint8Array<ArrayBuffer>, type: string): string {
    const url = URL.createObjectURL(new Blob([bytes], { type }));
    this.#urls.push(url);
    return url;
  }

  async #fix(): Promise<void> {
    await disabledDuring([this.#button], () => this.#makeFixed());
    this.#button.disabled = this.#model === null;
  }

  async #makeFixed(): Promise<void> {
    this.#forgetResult();
    replaceChildren(this.#result, el("p", { class: "quiet" }, "Working…"));
    this.told.started();
    const model = this.#model;
    try {
      const fixed = await this.generate(this.#options());
      if (model === this.#model) this.#show(fixed);
    } catch (error) {
      if (model !== this.#model) return;
      const message = error instanceof Error ? error.message : String(error);
      replaceChildren(this.#result, el("p", { class: "failure", role: "alert" }, message));
      this.told.failed(message);
    }
  }

  /** Returns a download of the folder that a .gltf came with, as a .zip. */
  #folder(fixed: FixedModel): HTMLElement[] {
    const files = this.#model && folderOf(fixed.bytes, this.#model);
    if (!files) return [];
    const stem = fixed.name.replace(/\.glb$/, ""), url = this.#urlOf(zipOf(files, stem), "application/zip");
    return [el("a", { class: "button plain-link folder", href: url, download: `${stem}.zip` }, "Download the folder (.zip)")];
  }

  #show(fixed: FixedModel): void {
    const file = fixed.report as GenerateReport, url = this.#urlOf(fixed.download?.bytes ?? fixed.bytes, fixed.download?.type ?? "model/gltf-binary");
    this.told.done(fixed, url, file.changed);
    const look = el("button", { type: "button", onclick: () => this.open(fixed) }, "Open the fixed file");
    const sentence = verdictOf(fixed, this.#checked);
    // Only a file that is better than the previous one is offered as the main download.
    const download = el("a", { class: sentence.isGood ? "button" : "button plain-link", href: url, download: fixed.name }, `Download ${fixed.name}`);
    replaceChildren(this.#result,
      el("p", { class: sentence.isGood ? "fine" : "quiet" }, sentence.what),
      sentence.findings && el("p", { class: sentence.isWorse ? "failure" : "counts", role: sentence.isWorse ? "alert" : undefined }, sentence.findings),
      asksForAnew(fixed.checked) && this.#tangents !== "overwrite" && el("p", { class: "quiet" }, "The fix keeps tangents that deviate only slightly. Recompute all tangents to fix these too."),
      changeTable(file.primitives),
      file.normalMaps.length > 0 ? mapTable(file.normalMaps) : null,
      ...file.warnings.map((warning) => el("p", { class: "quiet" }, warning)),
      el("div", { class: "row" }, download, ...this.#folder(fixed), look));
  }
}

const changesTangents = ({ action, mendedVertices }: GeneratedPrimitive): boolean => mendedVertices > 0 || ["generated", "replaced", "removed"].includes(action);

const asksForAnew = (checked: CheckReport | null): boolean => checked !== null && checked.findings.some((finding) => finding.severity !== "note" && remedyOptions(finding)?.tangents === "overwrite");

/** Returns whether normals or triangles have changed, which a comparison of frames does not show. */
export const changesShape = ({ primitives }: GenerateReport): boolean => primitives.some(({ normalsGenerated, windingMended }) => normalsGenerated || windingMended > 0);

/** Returns what the fix did, and the results of `check` before and after. */
function verdictOf(fixed: FixedModel, before: CheckReport | null): { what: string; findings: string | null; isGood: boolean; isWorse: boolean } {
  const file = fixed.report as GenerateReport, after = fixed.checked;
  const findings = before && after ? changeOfCounts(before.counts, after.counts) : null;
  const worse = before !== null && after !== null && isWorse(before.counts, after.counts);
  if (!file.changed) return { what: "No changes were needed: the output is byte-identical to the input.", findings, isGood: false, isWorse: false };
  const sizes = `${count(file.inputBytes)} bytes before, ${count(file.outputBytes)} after.`;
  const others = [
    file.normalMaps.some(({ flipped, mended }) => flipped || mended) && "normal maps",
    file.primitives.some(({ normalsGenerated, morphNormals }) => normalsGenerated || morphNormals > 0) && "normals",
    file.primitives.some(({ windingMended }) => windingMended > 0) && "triangles",
  ].filter(Boolean);
  if (file.primitives.some(changesTangents)) return { what: `Done: ${sizes}`, findings, isGood: !worse, isWorse: worse };
  return { what: `The tangents are unchanged${others.length > 0 ? `; ${others.join(" and ")} changed` : ""}: ${sizes}`, findings, isGood: others.length > 0 && !worse, isWorse: worse };
}

/** Returns words of a command line that are not broken at hyphens. */
const whole = (words: string): HTMLElement => el("span", { class: "whole" }, words);

const shellWord = (name: string): string => (/^[\w./-]+$/.test(name) ? name : `'${name.replaceAll("'", "'\\''")}'`);

/** Returns the name of the fixed file: `crate.glb` becomes `crate-fixed.glb`. The page always writes GLB. */
export const fixedName = (name: string): string => isMapName(name) ? fixedMapName(name) : `${name.replace(/^.*\//, "").replace(/\.[^.]*$/, "")}-fixed.glb`;

function table(head: string[], rows: { cells: string[]; title?: string }[], extraClass = ""): HTMLElement {
  const body = el("tbody", {}, ...rows.slice(0, kMostRows).map(({ cells, title }) => el("tr", { title }, ...cells.map((text) => el("td", {}, text)))));
  const rest = rows.length - kMostRows;
  if (rest > 0) body.append(el("tr", {}, el("td", { colspan: head.length }, `and ${count(rest)} more`)));
  return el("table", { class: `changes ${extraClass}` }, el("thead", {}, el("tr", {}, ...head.map((text) => el("th", { scope: "col" }, text)))), body);
}

const changeTable = (primitives: GeneratedPrimitive[]): HTMLElement =>
  table(["Part", "Tangents", "Vertices"], primitives.map((one) => {
    const fixed = one.mendedVertices > 0 ? `, ${count(one.mendedVertices)} ${one.mendedVertices === 1 ? "vertex" : "vertices"} corrected` : "";
    const vertices = one.verticesBefore === one.verticesAfter ? count(one.verticesBefore) : `${count(one.verticesBefore)} → ${count(one.verticesAfter)}`;
    return {
      cells: [`${one.mesh}/${one.primitive} ${one.meshName || one.materialName}`, `${actions[one.action] ?? one.action}${fixed}${one.normalsGenerated ? ", normals computed" : ""}${one.windingMended > 0 ? `, ${plural(one.windingMended, "triangle")} flipped` : ""}`, vertices],
      title: [one.reason, ...one.notes].join(" "),
    };
  }));

const mapTable = (maps: JudgedMap[]): HTMLElement =>
  table(["Normal map", "What was done"], maps.map(({ image, name, flipped, mended, reason }) => ({ cells: [`${image} ${name}`, flipped ? "green inverted" : mended ? `converted: ${reason}` : `kept: ${reason}`] })), "maps");
