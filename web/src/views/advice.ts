// SPDX-License-Identifier: MIT
// What the findings of a model ask Mend to do, and why. Only what the findings' own remedies name is switched on.
import { plural } from "../dom.js";
import type { CheckReport, Finding } from "tspace/gltf";

export type Tangents = "repair" | "overwrite" | "missing";

/** Options of `generate` that a switch of the panel stands for. */
export interface Extras {
  flipGreen: boolean;
  mendMaps: boolean;
  overwriteNormals: boolean;
  /** All normals anew, by what tells noise of positions from their shape. */
  denoise: boolean;
  mendWinding: boolean;
  /** Tangents that no material needs are taken away. */
  strip: boolean;
  morphNormals: "missing" | "all" | null;
}
export const noExtras: Extras = { flipGreen: false, mendMaps: false, overwriteNormals: false, denoise: false, mendWinding: false, strip: false, morphNormals: null };

/** What the first command of a remedy that works on the model does, or null where this page cannot do it. */
export function remedyOptions({ code, commands }: Finding): (Partial<Extras> & { tangents?: Tangents }) | null {
  // Of these the remedy says that both or neither is to be mended, which is more than one command.
  if (code === "greenFlipped") return { flipGreen: true };
  const command = commands.find(({ verb }) => verb === "generate");
  if (!command?.options.length) return null;
  const options: Partial<Extras> & { tangents?: Tangents } = {};
  for (const { name, value } of command.options) {
    if (name === "repair" || name === "overwrite") options.tangents = name;
    else if (name === "flip-green") options.flipGreen = true;
    else if (name === "mend-maps") options.mendMaps = true;
    else if (name === "overwrite-normals") options.overwriteNormals = true;
    else if (name === "mend-winding") options.mendWinding = true;
    else if (name === "strip") options.strip = true;
    else if (name === "denoise" && value === "auto") options.denoise = true;
    else if (name === "normals" && value === "best") continue; // which --denoise goes with
    else if (name === "morph-normals") options.morphNormals = value as "missing" | "all";
    else return null;
  }
  // Normals without the noise are all made anew.
  if (options.denoise) delete options.overwriteNormals;
  return options;
}

export interface Advice {
  extras: Extras;
  /** Sentences for the person. */
  reasons: string[];
}

/** Of inverted signs and a green that points down `check` makes a warning and a note where they cancel out. */
const cancels = ({ findings }: CheckReport): boolean => findings.some(({ code, severity }) => code === "signsInverted" && severity === "warning");

/** isTurned: signs are written the other way round, on purpose. */
export function adviceFor(report: CheckReport | null, tangents: Tangents, isTurned: boolean): Advice {
  const extras = { ...noExtras }, reasons: string[] = [];
  if (!report) return { extras, reasons };
  const serious = report.findings.filter(({ severity }) => severity !== "note");
  const down = report.findings.filter(({ code }) => code === "greenFlipped");
  const isAnew = tangents === "overwrite" && !isTurned;
  if (cancels(report)) {
    reasons.push(isAnew
      ? "Inverted signs and a green that points down cancel out in this file. All anew makes the signs right, so green has to be turned with them: it is switched on."
      : "Inverted signs and a green that points down cancel out, so this file renders right. Both stay as they are.");
  }
  if (isTurned && tangents === "overwrite") {
    if (down.length > 0) reasons.push("Signs that are turned go with a green that points down: it stays as it is.");
  } else if (down.some(({ severity }) => severity !== "note") || (isAnew && down.length > 0)) {
    extras.flipGreen = true;
    if (!cancels(report)) reasons.push(`Green points down in ${plural(down.length, "normal map")}: turning it is switched on.`);
  }
  const options = serious.map(remedyOptions);
  if (options.some((one) => one?.mendMaps)) {
    extras.mendMaps = true;
    reasons.push("A normal map holds something else than glTF wants: converting it is switched on.");
  }
  if (options.some((one) => one?.mendWinding)) {
    extras.mendWinding = true;
    reasons.push("Triangles are wound against their neighbours: turning them is switched on.");
  }
  const morph = options.map((one) => one?.morphNormals).filter(Boolean);
  if (morph.length > 0) {
    extras.morphNormals = morph.includes("all") ? "all" : "missing";
    reasons.push("Normals of morph targets do not follow the morphed surface: making them is switched on.");
  }
  return { extras, reasons };
}

const kinds = ["error", "warning", "note"] as const;

/** `4 errors, 1 warning → 0 errors, 0 warnings`: of each kind that was there before or after. */
export function changeOfCounts(before: CheckReport["counts"], after: CheckReport["counts"]): string {
  const shown = kinds.filter((kind) => before[kind] + after[kind] > 0);
  if (shown.length === 0) return "No finding before, none after.";
  const text = (counts: CheckReport["counts"]) => shown.map((kind) => plural(counts[kind], kind)).join(", ");
  return `${text(before)} → ${text(after)}`;
}
export const isWorse = (before: CheckReport["counts"], after: CheckReport["counts"]): boolean => {
  const kind = kinds.find((one) => before[one] !== after[one]);
  return kind !== undefined && after[kind] > before[kind];
};
