// SPDX-License-Identifier: MIT
// Saves this page with an embedded model as one HTML file, like `tspace view`.
import { toBase64 } from "./base64.js";
import type { PageOrigin } from "./embedded.js";
import type { ModelFiles } from "./files.js";

const escaped = (text: string): string => text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;");

/** A lone normal map is embedded as the original image. */
const filesOf = ({ name, bytes, others, loneMap }: ModelFiles): [string, Uint8Array<ArrayBuffer>][] => [[name, loneMap?.file ?? bytes], ...others];

/** Returns the page with an embedded model. `shown`: fragment of the address that describes the view. */
export async function pageWith(model: ModelFiles, shown: string): Promise<Blob> {
  const blocks: string[] = [];
  for (const [name, bytes] of filesOf(model)) blocks.push(`<script type="application/octet-stream" data-name="${escaped(name)}">${await toBase64(bytes)}</script>\n`);
  const origin: PageOrigin = { version: __VERSION__, date: new Date().toISOString().slice(0, 10), command: `tspace view ${model.name}`, shown };
  // Scripts and styles are copied from this page, so that the hashes in its policy remain valid.
  const own = [...document.querySelectorAll('script[type="module"], script:not([type])')].filter((script) => script.closest("body"));
  const parts = [
    `<!doctype html>\n<html lang="en"><head>${document.head.innerHTML}</head>\n<body>\n`,
    document.querySelector("noscript")?.outerHTML ?? "",
    `<script type="application/json" id="origin">${JSON.stringify(origin).replaceAll("<", "\\u003c")}</script>\n`,
    ...blocks,
    ...own.map((script) => `<script type="module">${script.textContent}</script>`),
    "\n</body></html>\n",
  ];
  return new Blob(parts, { type: "text/html" });
}
