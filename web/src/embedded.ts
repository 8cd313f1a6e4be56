// SPDX-License-Identifier: MIT
// The model that `tspace view` put into the page: a block of data for each file, the model first.
import { fromBase64 } from "./base64.js";
import type { ModelFiles } from "./files.js";

export function embeddedModel(): ModelFiles | null {
  const blocks = [...document.querySelectorAll<HTMLScriptElement>('script[type="application/octet-stream"]')];
  if (blocks.length === 0) return null;
  const [model, ...others] = blocks.map((block) => ({ name: block.dataset.name ?? "model.glb", bytes: fromBase64(block.textContent ?? "") }));
  return { ...model, others: new Map(others.map(({ name, bytes }) => [name, bytes])) };
}
