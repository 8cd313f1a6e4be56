// SPDX-License-Identifier: MIT
// Test support: the page in headless Chromium, opened from disk.
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, relative } from "node:path";
import { pathToFileURL } from "node:url";
import { decode } from "fast-png";

const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const playwright = await import("playwright-core").catch(() => null);
export const page = process.env.TSPACE_PAGE;
export const shared = process.env.TSPACE_SHARED;
export const tool = process.env.TSPACE_TOOL;
export const screenshots = process.env.TSPACE_SCREENSHOTS;
export const missing = (!chromium && "no Chromium here: scripts/web --all") || (!playwright && "playwright-core is not installed") || false;
export const noShared = missing || (!(shared && existsSync(shared)) && "no shared models here");
export const noTool = noShared || (!tool && "the tool is not built");

/** Run all cases instead of a sample. */
export const isLong = process.env.TSPACE_LONG === "1";
/** Timeout in milliseconds, long enough for a busy machine. */
export const kPatience = 120_000;

/** Runs `test(tab)` with the page open. Any request, error or message of the console fails it. */
export async function withPage(test, { width = 1280, height = 800, scheme = "light", url = pathToFileURL(page).href, allowMessages = false, hasTouch = false, hasWebGl = true, mayAsk = null } = {}) {
  const home = mkdtempSync(join(tmpdir(), "tspace-home-"));
  const browser = await playwright.chromium.launch({
    executablePath: chromium,
    timeout: kPatience,
    args: [...(hasWebGl ? [] : ["--disable-3d-apis"]), "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
    env: { ...process.env, HOME: home, XDG_RUNTIME_DIR: home },
  });
  try {
    const tab = await browser.newPage({ viewport: { width, height }, colorScheme: scheme, reducedMotion: "reduce", hasTouch });
    tab.setDefaultTimeout(kPatience);
    const faults = [], requests = [];
    tab.on("pageerror", (error) => faults.push(`${error.message} ${error.stack ?? ""}`));
    tab.on("console", (message) => !allowMessages && ["error", "warning"].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text()) && faults.push(message.text()));
    tab.on("request", (request) => !/^(data|blob):/.test(request.url()) && requests.push(request.url()));
    await tab.goto(url);
    await settled(tab);
    const result = await test(tab, requests);
    if (requests.slice(1).some((asked) => !mayAsk?.test(asked))) throw new Error(`requests after the page itself: ${requests.slice(1).join(", ")}`);
    if (faults.length > 0) throw new Error(faults.join("\n"));
    return result;
  } finally {
    await browser.close();
    rmSync(home, { recursive: true, force: true });
  }
}

/** Waits until the check of the model is complete, failed or stopped; returns the state. */
export async function settled(tab, timeout = kPatience) {
  await tab.waitForSelector("html:is([data-state=ready], [data-state=failed], [data-state=stopped])", { state: "attached", timeout });
  return tab.evaluate(() => document.documentElement.dataset.state);
}

/** Opens a file, with the files that it may reference, as if they had been dropped. */
export async function openFile(tab, path, { name = path.split("/").pop(), others = {}, timeout } = {}) {
  const files = Object.fromEntries(Object.entries(others).map(([key, file]) => [key, readFileSync(file).toString("base64")]));
  await tab.evaluate(([name, model, files]) => {
    const decode = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const others = new Map(Object.entries(files).map(([key, text]) => [key, decode(text)]));
    void window.tspaceView.open(async () => ({ name, bytes: decode(model), others }));
  }, [name, readFileSync(path).toString("base64"), files]);
  return settled(tab, timeout);
}

/** Opens a sample by its file name, as if its picture had been clicked; returns the state. */
export async function openSample(tab, file) {
  await tab.locator(`.sample[data-file="${file}"]`).click();
  return settled(tab);
}

/** Opens a model that a test has generated. */
export async function openBytes(tab, name, bytes) {
  await tab.evaluate(([name, text]) => void window.tspaceView.open(async () => ({ name, bytes: Uint8Array.from(atob(text), (c) => c.charCodeAt(0)), others: new Map() })), [name, bytes.toString("base64")]);
  if ((await settled(tab)) !== "ready") throw new Error(`${name} is not shown`);
}

/** Returns the files that a .gltf references, by their decoded paths. */
export function named(path) {
  if (!path.endsWith(".gltf")) return {};
  const found = {};
  try {
    const json = JSON.parse(readFileSync(path, "utf8"));
    for (const { uri } of [...(json.buffers ?? []), ...(json.images ?? [])]) {
      if (typeof uri !== "string" || /^[a-z]+:/i.test(uri)) continue;
      const file = join(dirname(path), decodeURIComponent(uri));
      if (!relative(dirname(path), file).startsWith("..") && existsSync(file) && statSync(file).isFile()) found[decodeURIComponent(uri)] = file;
    }
  } catch {
    // Corrupt files may contain invalid JSON or URIs; files that they reference are then omitted.
  }
  return found;
}

export function filesBelow(folder, pattern) {
  return readdirSync(folder, { recursive: true }).filter((name) => pattern.test(name)).map((name) => join(folder, name)).sort();
}

/** Waits until the change has been drawn. */
export const drawn = (tab) => tab.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));

export async function shoot(tab, name, options = {}) {
  await drawn(tab);
  mkdirSync(screenshots, { recursive: true });
  return tab.screenshot({ path: join(screenshots, `${name}.png`), ...options });
}

/** Selects a radio button, such as a look or a method. */
export const choose = (tab, label, scope = "body") => tab.locator(`${scope} label`, { hasText: new RegExp(`^${label}$`) }).locator("input").check({ force: true });

/** Fixes the model with the selected options, and downloads it. */
export async function fixAndDownload(tab) {
  await tab.locator(".mend .main").click();
  await tab.waitForSelector(".result a:not(.folder)");
  const [download] = await Promise.all([tab.waitForEvent("download"), tab.locator(".result a:not(.folder)").click()]);
  return readFileSync(await download.path());
}

/** Returns the pixels of the picture, without overlays. */
export async function pixelsOf(tab) {
  await drawn(tab);
  return decode(await tab.locator(".frame").screenshot({ style: ".frame > :not(canvas) { visibility: hidden; }" }));
}

/** Returns the share of an image's pixels for which `holds(at)` is true; `at` is the index of the pixel's red value. */
export function shareOf({ width, height, channels }, holds) {
  let count = 0;
  for (let i = 0; i < width * height; ++i) count += holds(channels * i);
  return count / (width * height);
}

/** Returns the largest difference of red, green and blue between two pixels. */
export const farApart = (a, at, b, other) => Math.max(...[0, 1, 2].map((k) => Math.abs(a[at + k] - b[other + k])));

/** Returns the shares of pixels that are nearest to each named color; pixels far from all of them count as "other". */
export async function shares(tab, colors, area = { left: 0, top: 0, right: 1, bottom: 1 }) {
  await drawn(tab);
  const png = (await tab.locator(".frame canvas").screenshot({ style: ".frame > :not(canvas) { visibility: hidden; }" })).toString("base64");
  return tab.evaluate(async ([png, colors, area]) => {
    const bytes = Uint8Array.from(atob(png), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const x = Math.floor(image.width * area.left), y = Math.floor(image.height * area.top);
    const { data } = context.getImageData(x, y, Math.ceil(image.width * area.right) - x, Math.ceil(image.height * area.bottom) - y);
    const counts = Object.fromEntries([...Object.keys(colors), "other"].map((name) => [name, 0]));
    for (let i = 0; i < data.length; i += 4) {
      // Shading darkens colors, so only hue and saturation are compared.
      const most = Math.max(data[i], data[i + 1], data[i + 2], 1);
      let best = "other", nearest = 0.12;
      for (const [name, color] of Object.entries(colors)) {
        const top = Math.max(...color);
        const distance = Math.hypot(...color.map((c, k) => c / top - data[i + k] / most));
        if (distance < nearest && most > 30) [best, nearest] = [name, distance];
      }
      counts[best] += 1;
    }
    for (const name of Object.keys(counts)) counts[name] /= data.length / 4;
    return counts;
  }, [png, colors, area]);
}

/**
 * Returns the picture of the page as PNG, and the positions of camera and lamp. `split`: 1 draws the file's frames, 0
 * those of the right side.
 */
export const ownPicture = (tab, split = 1) => tab.evaluate(async (split) => {
  const { stage } = window.tspaceView.views, { viewport } = stage, { camera, target } = viewport;
  stage.setSplit(split);
  viewport.draw();
  const picture = await viewport.draw().convertToBlob({ type: "image/png" });
  const text = await new Promise((done) => {
    const reader = new FileReader();
    reader.onload = () => done(reader.result.split(",")[1]);
    reader.readAsDataURL(picture);
  });
  const { width, height } = viewport.canvas, light = viewport.light.clone().transformDirection(camera.matrixWorld);
  return { text, view: { width, height, position: camera.position.toArray(), target: target.toArray(), up: camera.up.toArray(), fov: camera.fov, near: camera.near, far: camera.far, light: light.toArray() } };
}, split);

/** Returns pixels blended with a gray background. */
export function overGray(text) {
  const { width, height, channels, data } = decode(Buffer.from(text, "base64")), rgb = new Float64Array(3 * width * height), covered = new Uint8Array(width * height);
  for (let i = 0; i < covered.length; ++i) {
    const alpha = channels === 4 ? data[4 * i + 3] / 255 : 1;
    covered[i] = alpha > 0;
    for (let k = 0; k < 3; ++k) rgb[3 * i + k] = data[channels * i + k] * alpha + 111 * (1 - alpha);
  }
  return { rgb, covered };
}

/** Returns the mean difference over the pixels that are not background in at least one picture. */
export function difference(one, other) {
  let sum = 0, count = 0;
  for (let i = 0; i < one.covered.length; ++i) {
    if (!one.covered[i] && !other.covered[i]) continue;
    count += 1;
    for (let k = 0; k < 3; ++k) sum += Math.abs(one.rgb[3 * i + k] - other.rgb[3 * i + k]) / 3;
  }
  return { mean: sum / Math.max(1, count), count };
}
