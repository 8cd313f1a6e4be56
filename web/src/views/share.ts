// SPDX-License-Identifier: MIT
// Exports: the findings as text, Markdown or JSON, and the picture.
import { el, plural, select } from "../dom.js";
import { heat, heatDegrees, css } from "../color.js";
import type { Viewport } from "../picture/viewport.js";
import type { CheckReport, IdentifyReport } from "tspace/gltf";

interface Saved {
  blob: Blob;
  name: string;
}
/** Reports of the commands on the open model, as far as they are computed. */
export interface Reports {
  inspect?: unknown;
  check?: unknown;
  identify?: unknown;
}
type Kind = "text" | "markdown" | "json";

const today = (): string => new Date().toISOString().slice(0, 10);

/** Formats the findings for an e-mail or an issue. */
export function reportAs(kind: Kind, name: string, { inspect, check, identify }: Reports): string {
  if (kind === "json") return JSON.stringify({ file: name, version: __VERSION__, date: today(), inspect, check, identify }, null, 2);
  const report = check as CheckReport | undefined, verdict = (identify as IdentifyReport | undefined)?.verdict;
  const isMarkdown = kind === "markdown", lines: string[] = [];
  lines.push(isMarkdown ? `### ${name}` : name, "");
  if (report) {
    lines.push(`${plural(report.counts.error, "error")}, ${plural(report.counts.warning, "warning")}, ${plural(report.counts.note, "note")}. tspace ${__VERSION__}, ${today()}.`, "");
    for (const { severity, code, effect, cause, remedy, place } of report.findings) {
      lines.push(isMarkdown ? `- **${severity}** \`${code}\` at \`${place || "the file"}\`: ${effect} Cause: ${cause}.` : `${severity.padEnd(8)} ${code} at ${place || "the file"}`);
      if (!isMarkdown) lines.push(`         ${effect} Cause: ${cause}.`);
      lines.push(isMarkdown ? `  - fix: ${remedy}` : `         fix: ${remedy}`);
    }
    if (report.findings.length === 0) lines.push("No errors were found.");
  }
  if (verdict) lines.push("", `Method that made the tangents: ${verdict}`);
  return `${lines.join("\n")}\n`;
}

/** Returns the picture with a strip below it: the file, the two sides, the look, and the version. */
export async function pictureFile(viewport: Viewport, title: string, sides: string, swatches: { color: string; text: string }[]): Promise<Blob | null> {
  const image = viewport.draw();
  if (!image) return null;
  const unit = Math.max(12, Math.round(image.width / 60)), strip = (swatches.length > 0 ? 4.3 : 3) * unit;
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
  drawSwatches(context, swatches, unit, image.height + 3.1 * unit, (image.width - 2 * unit) / Math.max(1, swatches.length));
  if (look === "error" || look === "difference") drawScale(context, image.width / 2, image.height + 1.7 * unit, image.width / 2 - unit, unit);
  return canvas.convertToBlob({ type: "image/png" });
}

function drawSwatches(context: OffscreenCanvasRenderingContext2D, swatches: { color: string; text: string }[], unit: number, top: number, width: number): void {
  context.font = `${Math.round(0.8 * unit)}px system-ui, sans-serif`;
  for (const [i, { color, text }] of swatches.entries()) {
    context.fillStyle = color;
    context.fillRect(unit + i * width, top, 0.8 * unit, 0.8 * unit);
    context.fillStyle = "#1b1f27";
    context.fillText(text, unit + i * width + 1.1 * unit, top + 0.7 * unit, width - 1.6 * unit);
  }
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
  readonly element = el("details", { class: "panel share" }, el("summary", {}, "Share"));
  #kind: Kind = "text";
  #said = el("p", { class: "quiet", role: "status" });

  constructor(private give: { report: (kind: Kind) => string; picture: () => Promise<Saved | null>; page: () => Promise<Saved | null>; link: () => string }) {
    const kind = select("Report as", [["text", "text"], ["markdown", "Markdown, for an issue tracker"], ["json", "JSON"]] as const, "text", (value) => (this.#kind = value));
    const button = (text: string, act: () => Promise<void>) => el("button", { type: "button", onclick: () => void act() }, text);
    this.element.append(el("div", { class: "rows" }, kind.element, el("div", { class: "row" },
      button("Copy the report", () => this.#copy(this.give.report(this.#kind))),
      button("Save the picture", () => this.#save(this.give.picture(), "No picture is shown.")),
      button("Save one HTML page", () => this.#save(this.give.page(), "No model is open.")),
      button("Copy the link", () => this.#copy(this.give.link()))),
      el("p", { class: "quiet" }, "The HTML page contains the model, its findings and this viewer, and works offline. The link restores this view; it contains a model only if that is one of the examples."), this.#said));
  }

  async #copy(text: string): Promise<void> {
    try {
      await navigator.clipboard.writeText(text);
      this.#said.textContent = "Copied.";
    } catch {
      this.#said.textContent = "The browser does not allow this page to copy to the clipboard.";
    }
  }

  async #save(making: Promise<Saved | null>, otherwise: string): Promise<void> {
    const made = await making;
    if (!made) return void (this.#said.textContent = otherwise);
    const url = URL.createObjectURL(made.blob);
    el("a", { href: url, download: made.name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
    this.#said.textContent = `Saved as ${made.name}.`;
  }
}
