// SPDX-License-Identifier: MIT
// What one takes along: the findings as text, Markdown or JSON, and the picture with what it shows.
import { el, plural, select } from "../dom.js";
import { heat, heatDegrees, css } from "../color.js";
import type { Reports } from "../app.js";
import type { Viewport } from "../picture/viewport.js";
import type { CheckReport, IdentifyReport } from "tspace/gltf";

type Kind = "text" | "markdown" | "json";

const today = (): string => new Date().toISOString().slice(0, 10);

/** The findings, as they are read in a mail or an issue. */
export function reportAs(kind: Kind, name: string, { inspect, check, identify }: Reports): string {
  if (kind === "json") return JSON.stringify({ file: name, version: __VERSION__, date: today(), inspect, check, identify }, null, 2);
  const report = check as CheckReport | undefined, verdict = (identify as IdentifyReport | undefined)?.verdict;
  const isMarkdown = kind === "markdown", lines: string[] = [];
  lines.push(isMarkdown ? `### ${name}` : name, "");
  if (report) {
    lines.push(`${plural(report.counts.error, "error")}, ${plural(report.counts.warning, "warning")}, ${plural(report.counts.note, "note")}. tspace ${__VERSION__}, ${today()}.`, "");
    for (const { severity, code, message, remedy, place } of report.findings) {
      lines.push(isMarkdown ? `- **${severity}** \`${code}\` at \`${place || "the file"}\`: ${message}` : `${severity.padEnd(8)} ${code} at ${place || "the file"}`);
      if (!isMarkdown) lines.push(`         ${message}`);
      lines.push(isMarkdown ? `  - mend: ${remedy}` : `         mend: ${remedy}`);
    }
    if (report.findings.length === 0) lines.push("Nothing is wrong.");
  }
  if (verdict) lines.push("", `Who made the tangents: ${verdict}`);
  return `${lines.join("\n")}\n`;
}

/** The picture with a strip below it: which file, which sides, the look, the version. */
export async function pictureFile(viewport: Viewport, title: string, sides: string): Promise<Blob | null> {
  const image = viewport.draw();
  if (!image) return null;
  const unit = Math.max(12, Math.round(image.width / 60)), strip = 3 * unit;
  const canvas = new OffscreenCanvas(image.width, image.height + strip), context = canvas.getContext("2d")!;
  context.fillStyle = getComputedStyle(viewport.canvas.parentElement!).backgroundColor;
  context.fillRect(0, 0, image.width, image.height);
  context.drawImage(image, 0, 0);
  context.fillStyle = "#fff";
  context.fillRect(0, image.height, image.width, strip);
  context.fillStyle = "#1b1f27";
  context.font = `${unit}px system-ui, sans-serif`;
  const { look } = viewport.settings;
  context.fillText(`${title}: ${sides}`, unit, image.height + 1.3 * unit, image.width - 2 * unit);
  context.fillText(`tspace ${__VERSION__}, ${today()}`, unit, image.height + 2.6 * unit);
  if (look === "error" || look === "difference") drawScale(context, image.width / 2, image.height + 1.7 * unit, image.width / 2 - unit, unit);
  return canvas.convertToBlob({ type: "image/png" });
}

function drawScale(context: OffscreenCanvasRenderingContext2D, left: number, top: number, width: number, unit: number): void {
  const gradient = context.createLinearGradient(left, 0, left + width, 0);
  heat.forEach((color, i) => gradient.addColorStop(i / (heat.length - 1), css(color)));
  context.fillStyle = gradient;
  context.fillRect(left, top, width, unit / 2);
  context.fillStyle = "#1b1f27";
  context.font = `${Math.round(0.7 * unit)}px system-ui, sans-serif`;
  heatDegrees.forEach((degrees, i) => context.fillText(`${degrees}°`, left + (width * i) / (heat.length - 1) - (i === 0 ? 0 : unit), top + 1.2 * unit));
}

export class ShareView {
  readonly element = el("details", { class: "panel share" }, el("summary", {}, "Take along"));
  #kind: Kind = "text";
  #said = el("p", { class: "quiet", role: "status" });

  constructor(private give: { report: (kind: Kind) => string; picture: () => Promise<{ blob: Blob; name: string } | null> }) {
    const kind = select("Report as", [["text", "text"], ["markdown", "Markdown"], ["json", "JSON"]] as const, "text", (value) => (this.#kind = value));
    const copy = el("button", { type: "button", onclick: () => void this.#copy() }, "Copy the report");
    const save = el("button", { type: "button", onclick: () => void this.#save() }, "Save the picture");
    this.element.append(el("div", { class: "rows" }, kind.element, el("div", { class: "row" }, copy, save), this.#said));
  }

  async #copy(): Promise<void> {
    const text = this.give.report(this.#kind);
    try {
      await navigator.clipboard.writeText(text);
      this.#said.textContent = "Copied.";
    } catch {
      this.#said.textContent = "The browser does not let the page copy.";
    }
  }

  async #save(): Promise<void> {
    const made = await this.give.picture();
    if (!made) return void (this.#said.textContent = "There is no picture.");
    const url = URL.createObjectURL(made.blob);
    el("a", { href: url, download: made.name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
    this.#said.textContent = `Saved as ${made.name}.`;
  }
}
