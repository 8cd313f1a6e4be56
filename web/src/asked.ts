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
    throw new Refusal(`${url.host} did not give ${nameOf(url)}: it cannot be reached, sends to another server, or does not let other pages read its files (CORS). Download the file and drop it here.`);
  }
  if (!answer.ok) throw new Refusal(`${url.host} has no ${nameOf(url)}: it answered ${answer.status}.`);
  if (Number(answer.headers.get("content-length") ?? 0) > kMostBytes) throw new Refusal(`${nameOf(url)} is too large for this page, which reads models of up to 1 GB.`);
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
    el("p", {}, "The address of this page names a model: ", el("strong", {}, nameOf(url)), " on ", el("strong", {}, url.host), `. Nothing has been asked for yet. Loading it tells ${url.host} your network address, as any download does; what the page finds stays here.`),
    el("div", { class: "row" },
      el("button", { type: "button", class: "main", onclick: () => (bar.remove(), load()) }, `Load it from ${url.host}`),
      el("button", { type: "button", onclick: () => bar.remove() }, "Leave it")));
  return bar;
}
