// SPDX-License-Identifier: MIT
// The model that `tspace view` embeds in the page: a data block per file, the model first.
import { fromBase64 } from "./base64.js";
import type { ModelFiles } from "./files.js";

/** When and by which command the page was created. */
export interface PageOrigin {
  version: string;
  date: string;
  command: string;
  /** Fragment of the address with which the page was saved: the view. */
  shown?: string;
}

/** Returns the origin of a page that `tspace view` created, or null. */
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
