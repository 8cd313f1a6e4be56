// SPDX-License-Identifier: MIT
// Opens a page with one module, bundled by Vite, in headless Chromium with WebGPU on SwiftShader.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";

const project = fileURLToPath(new URL("..", import.meta.url));
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const [vite, playwright, three] = await Promise.all(["vite", "playwright-core", "three"].map((name) => import(name).catch(() => null)));

/** Reason why no page can be opened here, or false. */
export const missing =
  (!chromium && "no Chromium here: scripts/js --all") ||
  (!(vite && playwright && three) && "Vite, playwright-core or three.js is not installed, or this node is too old for them");

const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };

/** Runs the module `page` until it sets window.result, and returns it. `files`: address to content; body(tab, result): called afterwards. */
export async function runPage({ page, html = '<!doctype html><meta charset="utf-8"><script type="module" src="./page.js"></script>', query = "", files = {}, body = () => {}, size = { width: 800, height: 600 } }) {
  const folder = mkdtempSync(join(tmpdir(), "tspace-webgpu-"));
  let server, browser;
  try {
    const source = mkdtempSync(join(project, "webgpu-"));
    try {
      writeFileSync(join(source, "index.html"), html);
      writeFileSync(join(source, "page.js"), page);
      await vite.build({ root: source, configFile: false, logLevel: "error", build: { outDir: folder, target: "esnext", emptyOutDir: true } });
    } finally {
      rmSync(source, { recursive: true });
    }
    server = createServer((request, answer) => {
      const address = new URL(request.url, "http://localhost").pathname;
      if (files[address]) return answer.end(files[address]);
      const path = join(folder, address === "/" ? "index.html" : address);
      if (!existsSync(path)) return answer.writeHead(404).end();
      answer.writeHead(200, { "Content-Type": types[extname(path)] ?? "application/octet-stream" }).end(readFileSync(path));
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    browser = await playwright.chromium.launch({
      executablePath: chromium,
      args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan"],
      env: { ...process.env, HOME: folder },
    });
    const tab = await browser.newPage({ viewport: size });
    const messages = [];
    tab.on("pageerror", (error) => messages.push(String(error)));
    tab.on("console", (message) => message.type() === "error" && messages.push(message.text()));
    await tab.goto(`http://127.0.0.1:${server.address().port}/${query}`);
    await tab.waitForFunction(() => window.result, null, { timeout: 240_000 }).catch((error) => assert.fail([...messages, error].join("\n")));
    const result = await tab.evaluate(() => window.result);
    assert.equal(result.error, undefined, messages.join("\n"));
    await body(tab, result);
    return result;
  } finally {
    await browser?.close();
    server?.close();
    rmSync(folder, { recursive: true });
  }
}
