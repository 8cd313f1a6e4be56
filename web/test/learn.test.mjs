// SPDX-License-Identifier: MIT
// The lesson in headless Chromium: the numbers of its figures are correct, also after dragging.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { after, before, it } from "node:test";

const lesson = process.env.TSPACE_LESSON;  // learn.html, one file
const pictures = process.env.TSPACE_SCREENSHOTS;
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const playwright = await import("playwright-core").catch(() => null);
const skip = (!chromium && "no Chromium here") || (!playwright && "playwright-core is not installed") || (!lesson && "the lesson was not built");

let browser, home;
before(async () => {
  if (skip) return;
  home = mkdtempSync(join(tmpdir(), "tspace-home-"));
  if (pictures) mkdirSync(pictures, { recursive: true });
  browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox", "--disable-gpu"], env: { ...process.env, HOME: home, XDG_RUNTIME_DIR: home } });
});
after(async () => {
  await browser?.close();
  if (home) rmSync(home, { recursive: true, force: true });
});

async function open(options = {}) {
  const tab = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
  tab.faults = [];
  tab.on("pageerror", (error) => tab.faults.push(String(error)));
  tab.on("request", (request) => request.url().startsWith("http") && tab.faults.push(`asked for ${request.url()}`));
  await tab.goto(pathToFileURL(lesson).href);
  await tab.waitForSelector("html[data-state=ready]", { timeout: 60_000 }).catch(async () => assert.fail([...tab.faults, await tab.textContent("#trouble")].join("\n")));
  return tab;
}

/** Returns the number after a name in a figure's text. */
const number = (tab, figure, name) =>
  tab.$$eval(`#${figure} .numbers div`, (rows, wanted) => rows.find((row) => row.querySelector("dt").textContent === wanted)?.querySelector("dd").textContent, name);
const press = async (tab, label, key, times) => {
  await tab.focus(`[aria-label="${label}"]`);
  for (let i = 0; i < times; ++i) await tab.keyboard.press(key);
};
const errors = (tab) =>
  tab.$$eval("#methods tbody tr", (rows) => Object.fromEntries(rows.map((row) => [row.cells[0].textContent, [...row.cells].slice(1).map((cell) => Number(cell.textContent))])));

it("decodes texels, and shows the effects of a wrong T and of green pointing down", { skip }, async () => {
  const tab = await open();
  const lit = () => tab.$eval("#relief image:nth-of-type(2)", (image) => image.getAttribute("href"));
  const before = await lit();
  assert.match(await number(tab, "relief", "effect"), /stand out/);
  const [, r, g, b, x, y, z] = (await number(tab, "relief", "a texel")).replaceAll("\u2212", "-").match(/rgb\((\d+), (\d+), (\d+)\).* = \((-?[\d.]+), (-?[\d.]+), (-?[\d.]+)\)/).map(Number);
  [[r, x], [g, y], [b, z]].forEach(([c, v]) => assert.ok(Math.abs((2 * c) / 255 - 1 - v) < 0.01));
  await tab.check("#down");
  assert.match(await number(tab, "relief", "effect"), /from below/);
  assert.notEqual(await lit(), before);
  await tab.uncheck("#down");
  assert.equal(await lit(), before);
  await press(tab, "direction of T", "Shift+ArrowUp", 12);
  await press(tab, "direction of T", "Shift+ArrowLeft", 12);
  assert.match(await number(tab, "relief", "effect"), /degrees off/);
  assert.notEqual(await lit(), before);
  assert.deepEqual(tab.faults, []);
});

/** Returns the brightness difference between the upper and the lower half of a bolt in the first figure. */
const boltFromAbove = (tab) => tab.$eval("#relief image:nth-of-type(2)", async (image) => {
  const bitmap = await createImageBitmap(await (await fetch(image.getAttribute("href"))).blob());
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
  context.drawImage(bitmap, 0, 0);
  const at = (u, v) => context.getImageData(Math.round(u * bitmap.width), Math.round((1 - v) * bitmap.height), 1, 1).data[0];
  return at(0.24, 0.76 + 0.05) - at(0.24, 0.76 - 0.05);
});

it("lights bolts as described: from above, and from below where they look like holes", { skip }, async () => {
  const tab = await open();
  assert.ok((await boltFromAbove(tab)) > 40, "they stand out");
  await tab.check("#down");
  assert.ok((await boltFromAbove(tab)) < -40, "lit from below");
  await tab.uncheck("#down");
  await press(tab, "direction of T", "Shift+ArrowUp", 4);
  await press(tab, "direction of T", "Shift+ArrowLeft", 30);
  assert.match(await number(tab, "relief", "effect"), /bolts look like holes/);
  assert.ok((await boltFromAbove(tab)) < -40, "and turned round they are holes");
});

it("starts with triangles of opposite orientation", { skip }, async () => {
  const tab = await open();
  const directions = await tab.$$eval("#average line.arrow.tangent.faint", (lines) => lines.map((l) => Math.atan2(l.y2.baseVal.value - l.y1.baseVal.value, l.x2.baseVal.value - l.x1.baseVal.value)));
  assert.ok(Math.max(...directions) - Math.min(...directions) > 0.2, directions.join());
});

it("inverts the sign when a triangle's UVs are mirrored", { skip }, async () => {
  const tab = await open();
  assert.match(await number(tab, "triangle", "the library"), /sign = \+1/);
  await press(tab, "UV of corner 2", "Shift+ArrowDown", 9);
  assert.match(await number(tab, "triangle", "determinant"), /= \u2212/);
  assert.match(await number(tab, "triangle", "the library"), /sign = \u22121/);
  assert.match(await number(tab, "triangle", "meaning"), /mirrored/);
  assert.deepEqual(tab.faults, []);
});

it("gives the T of the library's method lengyel for any vertices and normal", { skip }, async () => {
  const tab = await open();
  for (const [label, key] of [["outer vertex 1", "ArrowLeft"], ["outer vertex 3", "ArrowUp"], ["the normal", "ArrowRight"], ["outer vertex 5", "Shift+ArrowDown"]]) {
    await press(tab, label, key, 5);
    const degrees = (await number(tab, "average", "the library")).match(/([\d.]+) degrees/);
    assert.ok(Number(degrees[1]) < 0.01, degrees[0]);
  }
});

it("lights both halves from the top, except without the sign", { skip }, async () => {
  const tab = await open();
  assert.match(await number(tab, "mirror", "left half"), /sign = \u22121.*up$/);
  assert.match(await number(tab, "mirror", "right half"), /sign = \+1.*up$/);
  await tab.check("#dropped");
  assert.match(await number(tab, "mirror", "left half"), /down$/);
  assert.match(await number(tab, "mirror", "right half"), /up$/);
  await press(tab, "u at the left end", "Shift+ArrowLeft", 19);
  assert.match(await number(tab, "mirror", "left half"), /sign = \+1.*up$/);
});

it("gives equal shading in tangent space and object space for any rotation of the texture", { skip }, async () => {
  const tab = await open();
  const pixels = () => tab.$eval("#light canvas", (canvas) => [...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data]);
  const before = await pixels();
  await press(tab, "rotation of the texture", "Shift+ArrowUp", 7);
  const after = await pixels();
  assert.ok(before.every((value, i) => Math.abs(value - after[i]) <= 2));
  assert.ok(new Set(before).size > 50, "there is a bump");
  const one = (await number(tab, "light", "brightness")).match(/[\d.]+$/)[0];
  assert.match(await number(tab, "light", "in object space"), new RegExp(`is ${one.replace(".", "\\.")} as well`));
  await press(tab, "the light", "Shift+ArrowRight", 5);
  assert.ok((await pixels()).some((value, i) => Math.abs(value - after[i]) > 20), "the light is seen");
});

it("compares methods with the true surface", { skip }, async () => {
  const tab = await open();
  const sheet = await errors(tab);
  assert.ok(sheet.best[0] < 0.5 * sheet.lengyel[0] && sheet.best[0] < 0.5 * sheet.mikktspace[0], JSON.stringify(sheet));
  await tab.selectOption("#surface", "mirrored");
  const seam = await errors(tab);
  assert.ok(seam.lengyel[1] > 80 && seam.mikktspace[1] < 10, JSON.stringify(seam));
  await tab.selectOption("#surface", "bevel");
  const bevel = await errors(tab);
  assert.ok(Object.values(bevel).every(([mean, worst]) => mean <= worst && worst < 60), JSON.stringify(bevel));
  assert.ok(bevel.best[0] <= bevel.lengyel[0] + 1, JSON.stringify(bevel));
});

it("shows a rotatable ring with relief on one side of the line", { skip }, async () => {
  const tab = await open();
  const pixels = () => tab.$eval("#hero canvas", (canvas) => [...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data].filter((_, i) => i % 4 === 0));
  /** Returns the mean difference of neighboring pixels on the ring, left and right of the center, away from line and arrows. */
  const roughness = (red) => [[120, 300], [340, 520]].map(([from, to]) => {
    let sum = 0, count = 0;
    for (let y = 40; y < 160; ++y) for (let x = from; x < to; ++x) if (red[y * 640 + x] > 0 && red[y * 640 + x + 1] > 0) [sum, count] = [sum + Math.abs(red[y * 640 + x] - red[y * 640 + x + 1]), count + 1];
    return sum / count;
  });
  const before = await pixels(), [left, right] = roughness(before);
  assert.ok(right > 2 * left, `${left} ${right}`);
  await press(tab, "rotate the ring", "ArrowRight", 3);
  await tab.waitForTimeout(300);
  const turned = await pixels();
  assert.ok(turned.filter((value, i) => Math.abs(value - before[i]) > 20).length > 5000);
  await tab.$eval("#hero input", (line) => { line.value = "0"; line.dispatchEvent(new Event("input")); });
  await tab.waitForTimeout(300);
  const [all] = roughness(await pixels());
  assert.ok(all > 2 * left, "the relief is on both sides");
  assert.deepEqual(tab.faults, []);
});

it("accepts typed edges and frames, and shows the results", { skip }, async () => {
  const tab = await open();
  await tab.fill('[aria-label="edges in the texture: row 1, column 1"]', "-0.1");
  assert.match(await number(tab, "triangle", "determinant"), /= \u2212/);
  assert.match(await number(tab, "triangle", "meaning"), /mirrored/);
  // Expected T and B: computed from the edges by the matrix.
  const cells = await tab.$$eval("#triangle .system .matrix", (all) => all.map((one) => [...one.children].map((cell) => Number((cell.value ?? cell.textContent).replace("\u2212", "-")))));
  const [[s1, t1, s2, t2], [tx, ty, bx, by], [x1, y1, x2, y2]] = cells;
  [[s1 * tx + t1 * bx, x1], [s1 * ty + t1 * by, y1], [s2 * tx + t2 * bx, x2], [s2 * ty + t2 * by, y2]].forEach(([made, edge]) => assert.ok(Math.abs(made - edge) < 0.05, cells.join(" | ")));
  assert.match(await number(tab, "light", "the matrix"), /transpose is its inverse/);
  await tab.fill('[aria-label="T, B and N in columns: row 1, column 1"]', "0.3");
  assert.match(await number(tab, "light", "the matrix"), /no longer orthonormal/);
  // n.(M^T L) = (M n).L holds for this matrix too, but its inverse is not its transpose.
  const bright = (await number(tab, "light", "brightness")).match(/[\d.]+$/)[0], values = (text) => text.replaceAll("\u2212", "-").match(/-?\d+\.\d+/g).map(Number);
  assert.ok((await number(tab, "light", "in object space")).endsWith(`is ${bright} as well`));
  const matrix = await tab.$$eval("#light .system input", (fields) => fields.map((field) => field.valueAsNumber)), given = await tab.$eval('[aria-label="the light"]', (knob) => knob.getAttribute("aria-valuetext").split(", ").map(Number));
  const [lx, ly, lz] = values((await number(tab, "light", "the matrix")).match(/M\u207b\u00b9L = \(([^)]*)\)/)[1]);
  given.forEach((wanted, row) => assert.ok(Math.abs(matrix[3 * row] * lx + matrix[3 * row + 1] * ly + matrix[3 * row + 2] * lz - wanted) < 0.03, "M takes it back to L"));
  await press(tab, "rotation of the texture", "ArrowUp", 1);
  assert.match(await number(tab, "light", "the matrix"), /transpose is its inverse/);
  assert.deepEqual(tab.faults, []);
});

it("interpolates tangents between corners, shorter where they differ", { skip }, async () => {
  const tab = await open();
  const at = async () => Number((await number(tab, "across", "interpolated T")).match(/length ([\d.]+)/)[1]);
  const between = async () => Number((await number(tab, "across", "shaded normal")).match(/([\d.]+) degrees/)[1]);
  assert.ok((await at()) < 0.9 && (await between()) > 2);
  const lit = () => tab.$eval("#across image", (image) => image.getAttribute("href"));
  const before = await lit();
  await tab.check("#unit");
  assert.notEqual(await lit(), before);
  // These moves make the tangents of the three corners nearly parallel.
  await press(tab, "T at corner 1", "Shift+ArrowRight", 12);
  await press(tab, "T at corner 2", "Shift+ArrowUp", 1);
  assert.ok((await at()) > 0.95, String(await at()));
  assert.match(await number(tab, "across", "meaning"), /agree/);
});

it("scales T by the matrix and N by its inverse transpose, and reports the change of relief without normalization", { skip }, async () => {
  const tab = await open();
  const values = async (name) => (await number(tab, "scaled", name)).replaceAll("\u2212", "-").match(/-?\d+\.\d+/g).map(Number);
  assert.ok(Math.abs((await values("N by M"))[2] - 90) > 30, "N by the matrix leans");
  assert.equal((await values("N by the inverse transpose"))[3], 90);
  // Moves the scale from (1.6, 0.6) to (1.6, 1.5), and then to (1.5, 1.5).
  await press(tab, "scale of the node", "Shift+ArrowDown", 12);
  await press(tab, "scale of the node", "Shift+ArrowLeft", 1);
  assert.deepEqual((await values("the matrix")).slice(0, 2), [1.5, 1.5]);
  assert.equal((await values("N by M"))[2], 90, "a uniform scale keeps right angles");
  assert.equal((await values("without normalizing"))[0], 2.25, "the scale squared");
  assert.match(await number(tab, "scaled", "meaning"), /does not mirror/);
  await press(tab, "scale of the node", "Shift+ArrowLeft", 14);
  assert.match(await number(tab, "scaled", "meaning"), /node mirrors/);
  assert.equal((await values("N by the inverse transpose"))[3], 90);
  assert.deepEqual(tab.faults, []);
});

it("says that glTF does not specify whether interpolated frames are normalized", { skip }, async () => {
  const tab = await open();
  assert.match(await number(tab, "across", "meaning"), /glTF does not specify/);
  assert.match(await tab.textContent("#across"), /glTF does not\s+specify which/);
});

for (const width of [390, 1280])
  it(`draws no arrow of a method over another one or over a word, at ${width}`, { skip }, async () => {
    const tab = await open({ viewport: { width, height: 844 } });
    for (const surface of ["sheet", "bevel", "mirrored"]) {
      await tab.selectOption("#surface", surface);
      const { arrows, over } = await tab.$eval("#methods svg", (svg) => {
        const ends = (line) => [["x1", "y1"], ["x2", "y2"]].map((names) => names.map((name) => line[name].baseVal.value));
        const lines = [...svg.querySelectorAll("line.method")].map(ends), words = [...svg.querySelectorAll("text")].map((word) => word.getBBox());
        const points = ([a, b]) => [0, 0.25, 0.5, 0.75, 1, 1.25].map((t) => a.map((x, k) => x + t * (b[k] - x)));
        const isSameStart = (one, other) => Math.hypot(one[0][0] - other[0][0], one[0][1] - other[0][1]) < 0.01;
        const near = lines.flatMap((one, i) => lines.slice(i + 1).filter((other) => !isSameStart(one, other) && points(one).some(([x, y]) => points(other).some(([u, v]) => Math.hypot(x - u, y - v) < 4))));
        const hidden = words.filter(({ x, y, width, height }) => lines.some((line) => points(line).some(([u, v]) => u > x && u < x + width && v > y && v < y + 0.8 * height)));
        return { arrows: lines.length, over: near.length + hidden.length };
      });
      assert.ok(arrows >= 12, `${surface}: ${arrows} arrows`);
      assert.equal(over, 0, surface);
    }
    assert.deepEqual(tab.faults, []);
  });

it("splits vertices at a seam, and shows the effect of sharing them", { skip }, async () => {
  const tab = await open();
  const lit = () => tab.$eval("#seam image", (image) => image.getAttribute("href"));
  assert.match(await number(tab, "seam", "vertices"), /^8/);
  const right = await lit();
  await tab.check("#shared");
  assert.match(await number(tab, "seam", "vertices"), /^6/);
  assert.match(await number(tab, "seam", "meaning"), /wrong beside the seam/);
  assert.notEqual(await lit(), right);
  await press(tab, "direction of u on the right square", "Shift+ArrowRight", 20);
  await press(tab, "direction of u on the right square", "Shift+ArrowDown", 20);
  await press(tab, "direction of u on the right square", "Shift+ArrowLeft", 40);
  await press(tab, "direction of u on the right square", "Shift+ArrowUp", 10);
  const degrees = Number((await number(tab, "seam", "T at the seam")).match(/(\d+) degrees/)[1]);
  assert.ok(degrees > 90, String(degrees));
});

for (const width of [390, 1280])
  it(`has no word under a handle or over another word, and none smaller than 12.9 pixels, at ${width}`, { skip }, async () => {
    const tab = await open({ viewport: { width, height: 844 } });
    const covered = await tab.$$eval("svg text", (words) => words.flatMap((word) => {
      const own = word.getBoundingClientRect();
      const knobs = [...word.ownerSVGElement.querySelectorAll(".handle")].map((knob) => knob.getBoundingClientRect());
      // Uses the centers of letters, because their boxes include empty space.
      const [x, y, half] = [(own.left + own.right) / 2, (own.top + own.bottom) / 2, own.width / 2];
      return knobs.some((knob) => Math.abs((knob.left + knob.right) / 2 - x) < knob.width / 2 + half - 3 && Math.abs((knob.top + knob.bottom) / 2 - y) < knob.height / 2 + 0.25 * own.height) ? [`${word.closest("section").id}: ${word.textContent}`] : [];
    }));
    assert.deepEqual(covered, []);
    const crossed = await tab.$$eval("svg", (figures) => figures.flatMap((figure) => {
      const words = [...figure.querySelectorAll("text")].map((word) => ({ text: word.textContent, box: word.getBoundingClientRect() })).filter(({ box }) => box.width > 0);
      const touch = ({ box: a }, { box: b }) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 0.5 * Math.min(a.height, b.height);
      return words.flatMap((one, i) => words.slice(i + 1).filter((other) => touch(one, other)).map((other) => `${one.text} / ${other.text}`));
    }));
    assert.deepEqual(crossed, []);
    const small = await tab.$$eval("svg text", (words) => words.filter((word) => parseFloat(getComputedStyle(word).fontSize) * word.ownerSVGElement.getScreenCTM().a < 12.9).map((word) => word.textContent));
    assert.deepEqual(small, []);
  });

it("works by keyboard, on a phone, and in print", { skip }, async () => {
  const tab = await open({ viewport: { width: 390, height: 844 } });
  assert.ok(await tab.$$eval(".handle", (all) => all.length >= 21 && all.every((knob) => knob.tabIndex === 0 && knob.getAttribute("aria-label") && knob.getAttribute("aria-valuetext"))));
  assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await tab.emulateMedia({ media: "print" });
  assert.equal(await tab.$eval("#triangle svg", (svg) => svg.getBoundingClientRect().height > 50), true);
  assert.equal(await tab.$eval(".handles", (knobs) => getComputedStyle(knobs).display), "none");
});

for (const [name, options] of [["wide", {}], ["dark", { colorScheme: "dark" }], ["narrow", { viewport: { width: 390, height: 844 } }]])
  it(`leaves a picture: ${name}`, { skip: skip || (!pictures && "no folder for pictures") }, async () => {
    const tab = await open(options);
    const picture = await tab.screenshot({ path: join(pictures, `learn-${name}.png`), fullPage: true });
    assert.ok(picture.length > 20_000);
    const cut = await tab.$$eval("svg text", (words) => words.filter((word) => {
      const own = word.getBoundingClientRect(), box = word.ownerSVGElement.getBoundingClientRect();
      return own.width > 0 && (own.left < box.left - 0.5 || own.right > box.right + 0.5);
    }).map((word) => word.textContent));
    assert.deepEqual(cut, []);
  });
