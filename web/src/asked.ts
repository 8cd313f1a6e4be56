// SPDX-License-Identifier: MIT
// A model that the page's address specifies with `?model=`: nothing is requested before the user agrees, and only from
// the server of that model (guard.js).
import { el } from "./dom.js";
import { fileUris, kMostBytes, kMostFiles, Refusal, type Named } from "./files.js";

/** Returns the URL of the requested model, or null. */
export function askedModel(): URL | null {
  const named = new URLSearchParams(location.search).get("model");
  if (!named) return null;
  try {
    const url = new URL(named, location.href);
    return /^https?:$/.test(url.protocol) ? url : null;
  } catch {
    return null;
  }
}

const nameOf = (url: URL): string => {
  const last = url.pathname.split("/").pop() ?? "";
  try {
    return decodeURIComponent(last) || "model";
  } catch {
    return last;
  }
};

async function bytesAt(url: URL): Promise<Uint8Array<ArrayBuffer>> {
  let answer: Response;
  try {
    answer = await fetch(url, { credentials: "omit", referrerPolicy: "no-referrer" });
  } catch {
    throw new Refusal(`${nameOf(url)} could not be loaded from ${url.host}: the server is unreachable, redirects to another server, or does not allow other pages to read its files (CORS). Download the file and drop it here.`);
  }
  if (!answer.ok) throw new Refusal(`${nameOf(url)} could not be loaded from ${url.host}: the server responded with status ${answer.status}.`);
  if (Number(answer.headers.get("content-length") ?? 0) > kMostBytes) throw new Refusal(`${nameOf(url)} is too large for this page, which supports models of up to 1 GB.`);
  return new Uint8Array(await answer.arrayBuffer());
}

const asFile = (path: string, bytes: Uint8Array<ArrayBuffer>): Named => ({ path, file: { size: bytes.length, arrayBuffer: async () => bytes.buffer } });

/** Downloads the model and, for a .gltf, the files on the same server that it references. */
export async function filesAt(url: URL): Promise<Named[]> {
  const bytes = await bytesAt(url), isKnown = /\.(glb|vrm|gltf|obj|zip)$/i.test(url.pathname);
  const name = isKnown ? nameOf(url) : `${nameOf(url)}${bytes[0] === 0x7b ? ".gltf" : bytes[0] === 0x50 ? ".zip" : ".glb"}`;
  const found = [asFile(name, bytes)];
  if (!/\.gltf$/i.test(name)) return found;
  for (const uri of fileUris(bytes).slice(0, kMostFiles)) {
    const own = new URL(uri, url);
    // Files on other servers, and files that do not exist, are reported as missing.
    if (own.origin === url.origin) await bytesAt(own).then((data) => found.push(asFile(decodeURIComponent(uri).replace(/^\.\//, ""), data))).catch(() => {});
  }
  return found;
}

/** Returns a bar that names the server to be contacted, and waits for a click. */
export function askFirst(url: URL, load: () => void): HTMLElement {
  const bar: HTMLElement = el("section", { class: "asked", "aria-label": "A model on a server" },
    el("p", {}, "The address of this page contains a link to a model: ", el("strong", {}, nameOf(url)), " on ", el("strong", {}, url.host), `. Nothing has been downloaded yet. Like any download, loading it reveals your network address to ${url.host}. The results stay in this browser.`),
    el("div", { class: "row" },
      el("button", { type: "button", class: "main", onclick: () => (bar.remove(), load()) }, `Load it from ${url.host}`),
      el("button", { type: "button", onclick: () => bar.remove() }, "Do not load it")));
  return bar;
}
