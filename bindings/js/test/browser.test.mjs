// SPDX-License-Identifier: MIT
// Tests the package bundled by Vite, in headless Chromium: golden meshes, images, and invalid input.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createServer } from "node:http";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { it } from "node:test";
import { gridModel } from "./models.mjs";
import { shared, tool } from "./tool.mjs";

const project = fileURLToPath(new URL("..", import.meta.url));
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const [vite, playwright, pngjs] = await Promise.all(["vite", "playwright-core", "pngjs"].map((name) => import(name).catch(() => null)));
const golden = process.env.TSPACE_GOLDEN;
/** A typical normal map: a JPEG whose color channels have half the resolution. */
const photo = join(shared ?? "", "models/assets/sofa_03/textures/sofa_03_nor_gl_1k.jpg");
const missing =
  (!chromium && "no Chromium here: scripts/js --all") ||
  (!(vite && playwright) && "Vite or playwright-core is not installed, or this node is too old for them") ||
  (!(golden && existsSync(golden)) && "no golden meshes here");

const page = `const GRID = ${JSON.stringify(gridModel({ image: "IMAGE" }).model.toString())};
import { generateTangents, ready } from "tspace";
import * as small from "tspace/mikktspace";
import * as files from "tspace/gltf";
import { differences, readGolden } from "./golden.mjs";
await Promise.all([ready, small.ready, files.ready]);
const gridModel = (image) => new TextEncoder().encode(GRID.replace("IMAGE", image));
const names = await (await fetch("/golden/")).json();
let compared = 0;
const wrong = [];
for (const name of names) {
  const one = readGolden(await (await fetch("/golden/" + name)).arrayBuffer());
  if (!one.isPromised) continue;
  const options = { convention: "opengl", threshold: one.threshold, ngons: "skip" };
  for (const compute of [generateTangents, small.generateTangents])
    if (differences(compute(one.mesh, options), one.wanted) !== 0) wrong.push(name);
  compared += 1;
}
let code;
try { generateTangents({ positions: new Float32Array(9) }, {}); } catch (error) { code = error.code; }
let refused;
try { files.check(new TextEncoder().encode("{")); } catch (error) { refused = error.code; }
const model = new TextEncoder().encode(JSON.stringify({ asset: { version: "2.0" }, scenes: [] }));
const made = files.generate(model);
const canvas = new OffscreenCanvas(64, 64);
const context = canvas.getContext("2d", { alpha: false });
for (let y = 0; y < 64; ++y) for (let x = 0; x < 64; ++x) {
  context.fillStyle = "rgb(" + 4 * x + " " + 4 * y + " " + (x ^ y) + ")";
  context.fillRect(x, y, 1, 1);
}
const png = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
const image = "data:image/png;base64," + btoa(String.fromCharCode(...png));
const mapped = gridModel(image);
const noted = (options) => files.check(mapped, options).findings.some(({ code }) => code === "normalMapUnreadable");
const decoded = await files.decodeByCanvas(png, "image/png");
const exact = decoded.rgba.every((value, i) => value === [4 * ((i >> 2) % 64), 4 * (i >> 8), ((i >> 2) % 64) ^ (i >> 8), 255][i % 4]);
const base64 = (bytes) => {
  let text = "";
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(text);
};
const pictures = [];
async function decode(name, file) {
  const { width, height, rgba } = await files.decodeByCanvas(file, "image/" + name.split(" ")[0]);
  pictures.push({ name, width, height, file: base64(file), rgba: base64(rgba) });
}
for (const type of ["jpeg", "webp"]) for (const quality of [0.6, 0.95, 1])
  await decode(type + " of quality " + quality, new Uint8Array(await (await canvas.convertToBlob({ type: "image/" + type, quality })).arrayBuffer()));
const photo = await fetch("/photo");
if (photo.ok) await decode("jpeg of ../shared", new Uint8Array(await photo.arrayBuffer()));
const images = [noted({}), noted({ decodeImage: await files.decodeImages(mapped, files.decodeByCanvas) }), exact];
window.result = { pictures, images, compared, wrong, code, refused, glb: made.bytes.length, found: files.check(made.bytes).findings.length };
`;

/** Returns the largest difference between the browser's pixels and those of the tool, which writes them as a PNG with inverted green. */
function stepsFromTool({ name, width, height, file, rgba }, folder) {
  const [from, to] = [`picture.${name.split(" ")[0]}`, "picture.png"].map((each) => join(folder, each));
  writeFileSync(from, Buffer.from(file, "base64"));
  execFileSync(tool, ["flip-green", from, "-o", to, "--quiet"]);
  const wanted = pngjs.PNG.sync.read(readFileSync(to));
  assert.deepEqual([width, height], [wanted.width, wanted.height], name);
  const pixels = Buffer.from(rgba, "base64");
  assert.equal(pixels.length, wanted.data.length, name);
  let most = 0;
  for (let i = 0; i < pixels.length; ++i) most = Math.max(most, Math.abs(pixels[i] - (i % 4 === 1 ? 255 - wanted.data[i] : wanted.data[i])));
  return most;
}

it("gives the same bits in Chromium, bundled by Vite", { skip: missing, timeout: 300_000 }, async () => {
  const folder = mkdtempSync(join(project, "page-"));
  const home = mkdtempSync(join(tmpdir(), "tspace-home-"));
  let server, browser;
  try {
    writeFileSync(join(folder, "index.html"), '<!doctype html><script type="module" src="./page.mjs"></script>');
    writeFileSync(join(folder, "page.mjs"), page);
    writeFileSync(join(folder, "golden.mjs"), readFileSync(new URL("./golden.mjs", import.meta.url)));
    await vite.build({ root: folder, logLevel: "error", build: { target: "esnext", assetsInlineLimit: 0 } });
    const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };
    server = createServer((request, answer) => {
      const path = new URL(request.url, "http://here").pathname;
      try {
        if (path === "/golden/") return answer.end(JSON.stringify(readdirSync(golden).filter((name) => name.endsWith(".tsg"))));
        if (path === "/photo") return answer.end(readFileSync(photo));
        const file = path.startsWith("/golden/") ? join(golden, path.slice(8)) : join(folder, "dist", path === "/" ? "index.html" : path);
        answer.setHeader("content-type", types[extname(file)] ?? "application/octet-stream");
        answer.end(readFileSync(file));
      } catch {
        answer.writeHead(404).end();
      }
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox", "--disable-gpu"], env: { ...process.env, HOME: home, XDG_RUNTIME_DIR: home } });
    const tab = await browser.newPage();
    const messages = [];
    tab.on("pageerror", (error) => messages.push(String(error)));
    await tab.goto(`http://127.0.0.1:${server.address().port}/`);
    await tab.waitForFunction("window.result", undefined, { timeout: 120_000 }).catch((error) => assert.fail([...messages, error].join("\n")));
    const { pictures, images, compared, wrong, code, refused, glb, found } = await tab.evaluate("window.result");
    // `images`: whether a note on missing pixels appears without decodeImage and with it, and whether pixels are exact
    assert.deepEqual(images, [true, false, true]);
    if (tool && pngjs) {
      const steps = pictures.map((picture) => [picture.name, stepsFromTool(picture, folder)]);
      assert.ok(steps.every(([, most]) => most <= 1), JSON.stringify(steps));
      assert.equal(steps.length, existsSync(photo) ? 7 : 6);
    }
    assert.ok(compared > 300);
    assert.deepEqual(wrong, []);
    assert.equal(code, "invalidOption");
    assert.equal(refused, "invalidFile");
    assert.deepEqual([glb > 20, found], [true, 0]);
  } finally {
    await browser?.close();
    server?.close();
    for (const gone of [folder, home]) rmSync(gone, { recursive: true, force: true });
  }
});
