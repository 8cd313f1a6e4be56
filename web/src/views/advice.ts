// SPDX-License-Identifier: MIT
// Derives the options of the fix from the findings of a model: the commands of their remedies, as returned by the
// engine.
import { plural } from "../dom.js";
import type { MapReading } from "../worker/protocol.js";
import type { CheckReport, Finding } from "tspace/gltf";

export type Tangents = "repair" | "overwrite" | "missing";

/** Options of `generate` that the panel has switches for. */
export interface Extras {
  flipGreen: boolean;
  fixMaps: boolean;
  overwriteNormals: boolean;
  /** Recomputes all normals with the method that removes noise from positions. */
  denoise: boolean;
  fixWinding: boolean;
  /** Removes tangents that no material needs. */
  strip: boolean;
  morphNormals: "missing" | "all" | null;
}
export const noExtras: Extras = { flipGreen: false, fixMaps: false, overwriteNormals: false, denoise: false, fixWinding: false, strip: false, morphNormals: null };

type Remedy = Partial<Extras> & { tangents?: Tangents };
const flags = new Set<string>(["flipGreen", "fixMaps", "overwriteNormals", "fixWinding", "strip"]);
const camel = (name: string): string => name.replace(/-./g, ([, letter]) => letter.toUpperCase());

/**
 * Returns the switches for the first command of a remedy that applies to the model, or null if the page has no switch
 * for it.
 */
export function remedyOptions({ code, commands }: Finding): Remedy | null {
  // If inverted signs and inverted green cancel out, the remedy has two commands: repair both or neither.
  if (code === "greenFlipped") return { flipGreen: true };
  const command = commands.find(({ verb }) => verb === "generate");
  if (!command) return null;
  const remedy: Remedy = command.options.length === 0 ? { tangents: "repair" } : {};
  for (const { name, value } of command.options) {
    const option = camel(name);
    if (option === "repair" || option === "overwrite") remedy.tangents = option;
    else if (flags.has(option)) Object.assign(remedy, { [option]: true });
    else if (option === "denoise" && value === "auto") remedy.denoise = true;
    else if (option === "normals" && value === "best") continue; // implied by --denoise
    else if (option === "morphNormals") remedy.morphNormals = value as "missing" | "all";
    else return null;
  }
  // Denoised normals replace all others.
  if (remedy.denoise) delete remedy.overwriteNormals;
  return remedy;
}

const curves: Record<string, MapReading["curve"]> = { srgb: "srgb", linearized: "linearized" };

/**
 * Returns how to convert a lone normal map to glTF's encoding with green pointing up, from the commands of its
 * findings, or null if the page cannot convert it. `isSure`: the encoding is certain.
 */
export function mapReading({ image, findings }: CheckReport): { reading: MapReading; isSure: boolean } | null {
  const reading: MapReading = {}, content = image?.content === "normals" ? undefined : findings.find(({ commands }) => commands.some(({ verb }) => verb === "convert-map"));
  const finding = content ?? findings.find(({ code }) => code === "greenFlipped");
  if (!image || (image.content !== "normals" && !content)) return null;
  for (const { name, value } of finding?.commands[0]?.options ?? []) {
    if (name === "channels") reading.channels = value;
    else if (curves[name]) reading.curve = curves[name];
    else if (name === "flip-red") reading.flipRed = true;
    else if (name !== "o" && name !== "flip-green") return null;
  }
  reading.flipGreen = finding?.code === "greenFlipped" || finding?.commands[0]?.options.some(({ name }) => name === "flip-green");
  return { reading, isSure: !content || content.commands.length === 1 };
}

export interface Advice {
  extras: Extras;
  /** Sentences for the user. */
  reasons: string[];
}

/**
 * Returns whether inverted signs and a green that points down cancel out; `check` then reports a warning and a note.
 */
const cancels = ({ findings }: CheckReport): boolean => findings.some(({ code, severity }) => code === "signsInverted" && severity === "warning");

/** Returns the options that the findings require. `isTurned`: inverted signs are written intentionally. */
export function adviceFor(report: CheckReport | null, tangents: Tangents, isTurned: boolean): Advice {
  const extras = { ...noExtras }, reasons: string[] = [];
  if (!report) return { extras, reasons };
  const serious = report.findings.filter(({ severity }) => severity !== "note");
  const down = report.findings.filter(({ code }) => code === "greenFlipped");
  const isOverwritten = tangents === "overwrite" && !isTurned;
  if (cancels(report)) {
    reasons.push(isOverwritten
      ? "Inverted signs and a green channel that points down cancel out in this file. Recomputed tangents have correct signs, so green must be inverted too. This option was selected for you."
      : "Inverted signs and a green channel that points down cancel out, so this file renders correctly. The fix keeps both.");
  }
  if (isTurned && tangents === "overwrite") {
    if (down.length > 0) reasons.push("The tangent signs are inverted, so green must point down: the fix keeps the green channel.");
  } else if (down.some(({ severity }) => severity !== "note") || (isOverwritten && down.length > 0)) {
    extras.flipGreen = true;
    if (!cancels(report)) reasons.push(`Green points down in ${plural(down.length, "normal map")}. The option that inverts it was selected for you.`);
  }
  const options = serious.map(remedyOptions);
  if (options.some((one) => one?.fixMaps)) {
    extras.fixMaps = true;
    reasons.push("A normal map is not encoded as glTF requires. The option that converts it was selected for you.");
  }
  if (options.some((one) => one?.fixWinding)) {
    extras.fixWinding = true;
    reasons.push("The winding of some triangles is opposite to that of their neighbors. The option that flips them was selected for you.");
  }
  const morph = options.map((one) => one?.morphNormals).filter(Boolean);
  if (morph.length > 0) {
    extras.morphNormals = morph.includes("all") ? "all" : "missing";
    reasons.push("The normals of morph targets do not follow the morphed surface. The option that computes them was selected for you.");
  }
  return { extras, reasons };
}

/**
 * Returns the finding to report first: one of the highest severity; among these, preferably one that is visible in this
 * picture rather than only in other viewers.
 */
export function worstOf({ findings }: CheckReport): Finding | undefined {
  const worst = findings.filter(({ severity }) => severity !== "note" && severity === findings[0].severity);
  return worst.find(({ code }) => code !== "tangentsMissing") ?? worst[0];
}

export interface Plan {
  tangents: Tangents;
  /** Descriptions of the steps, to follow "Fix it:". */
  steps: string[];
  /** Number of kinds of findings that require changes in a 3D program. */
  left: number;
}

/** Returns what one click does about all errors and warnings, or null if it can do nothing about them. */
export function planFor(report: CheckReport): Plan | null {
  if (report.image) return planForMap(report);
  // Signs that cancel out with inverted green render correctly.
  const serious = report.findings.filter(({ severity, code }) => severity !== "note" && !(code === "signsInverted" && cancels(report)));
  const remedies = serious.map(remedyOptions), wants = (tangents: Tangents, isError: boolean) => remedies.some((one, i) => one?.tangents === tangents && (!isError || serious[i].severity === "error"));
  // All tangents are recomputed only for errors, or if nothing else has to be repaired.
  const tangents: Tangents = wants("overwrite", true) || (wants("overwrite", false) && !wants("repair", false)) ? "overwrite" : "repair";
  const { extras } = adviceFor(report, tangents, false), codes = (holds: (finding: Finding) => boolean) => new Set(serious.filter(holds).map(({ code }) => code)).size;
  const isMissing = serious.some(({ code }) => code === "tangentsMissing" || code === "tangentsIgnored");
  const isWrong = serious.some((finding, i) => remedies[i]?.tangents === "repair" && finding.commands.some(({ verb, options }) => verb === "generate" && options.length > 0));
  const steps = [
    tangents === "overwrite" ? "recompute all tangents" : isWrong ? "recompute the wrong tangents" : isMissing || wants("repair", false) ? "add the missing tangents" : "",
    extras.flipGreen ? `invert green in ${plural(report.findings.filter(({ code }) => code === "greenFlipped").length, "normal map")}` : "",
    extras.fixWinding ? "flip triangles that face inward" : "",
    extras.morphNormals ? "compute normals of morph targets" : "",
  ].filter(Boolean);
  return steps.length === 0 ? null : { tangents, steps, left: codes((finding) => remedyOptions(finding) === null || remedyOptions(finding)?.fixMaps === true) };
}

/** Returns what one click does about a lone normal map. */
function planForMap(report: CheckReport): Plan | null {
  const serious = report.findings.filter(({ severity }) => severity !== "note"), found = mapReading(report);
  if (serious.length === 0 || !found?.isSure) return null;
  const { channels, curve, flipGreen } = found.reading, isDone = ({ code }: Finding) => code === "greenFlipped" || channels !== undefined || curve !== undefined;
  const steps = [channels || curve ? "store x, y and z in red, green and blue" : "", flipGreen ? "invert green in 1 normal map" : ""].filter(Boolean);
  return steps.length === 0 ? null : { tangents: "repair", steps, left: new Set(serious.filter((one) => !isDone(one)).map(({ code }) => code)).size };
}

const kinds = ["error", "warning", "note"] as const;

/** Formats counts such as `4 errors, 1 warning`, for the severities in `shown`; "no findings" if all are zero. */
export const countsText = (counts: CheckReport["counts"], shown: readonly (keyof CheckReport["counts"])[] = kinds.filter((kind) => counts[kind] > 0)): string =>
  shown.map((kind) => plural(counts[kind], kind)).join(", ") || "no findings";

/** Formats `4 errors, 1 warning → 0 errors, 0 warnings`: every severity that occurs before or after. */
export function changeOfCounts(before: CheckReport["counts"], after: CheckReport["counts"]): string {
  const shown = kinds.filter((kind) => before[kind] + after[kind] > 0);
  return shown.length === 0 ? "No findings before or after the fix." : `${countsText(before, shown)} → ${countsText(after, shown)}`;
}
export const isWorse = (before: CheckReport["counts"], after: CheckReport["counts"]): boolean => {
  const kind = kinds.find((one) => before[one] !== after[one]);
  return kind !== undefined && after[kind] > before[kind];
};
