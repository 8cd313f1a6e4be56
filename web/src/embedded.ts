// SPDX-License-Identifier: MIT
// The model that `tspace view` embeds in the page: a data block per file, the model first.
import { fromBase64 } from "./base64.js";
import type { ModelFiles } from "./files.js";

/** When the page was made, and by which command. */
export interface PageOrigin {
  version: string;
  date: string;
  command: string;
  /** The end of the address with which the page was saved: what was seen. */
  shown?: string;
}

/** Of a page that `tspace view` made. */
export function pageOrigin(): PageOrigin | null {
  const text = document.getElementById("origin")?.textContent;
  return text ? (JSON.parse(text) as PageOrigin) : null;
}

export function embeddedModel(): ModelFiles | null {
  const blocks = [...document.querySelectorAll<HTMLScriptElement>('script[type="application/octet-stream"]')];
  if (blocks.length === 0) return null;
  const [model, ...others] = blocks.map((block) => ({ name: block.dataset.name ?? "model.glb", bytes: fromBase64(block.textContent ?? "") }));
  return { ...model, others: new Map(others.map(({ name, bytes }) => [name, bytes])) };
}
