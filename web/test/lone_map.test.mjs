// SPDX-License-Identifier: MIT
// A normal map without a model: its contents, the direction of green, and one click that inverts it.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { decode, encode } from "fast-png";
import { Glb } from "./glb.mjs";
import { farApart, missing, noShared, noTool, openSample, pixelsOf, settled, shareOf, shoot, tool, withPage } from "./support.mjs";

const inFolder = async (act) => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-map-"));
  try {
    return await act(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
};

async function openMap(tab, path) {
  await tab.evaluate(() => (document.documentElement.dataset.state = "asked"));
  await tab.locator(".picker input").first().setInputFiles(path);
  return settled(tab);
}

async function ringMap(tab, folder) {
  await openSample(tab, "ring-directx.glb");
  const glb = new Glb(Buffer.from(await tab.evaluate(() => [...window.tspaceView.model.bytes]))), path = join(folder, "bricks.png");
  writeFileSync(path, glb.bytesOfImage(0));
  return path;
}

const looked = (tab) => tab.locator(".looked").textContent();

test("a DirectX PNG is detected, shown on a lit surface, and inverted by one click", { skip: missing }, async () => {
  await inFolder((folder) => withPage(async (tab) => {
    const path = await ringMap(tab, folder);
    assert.equal(await openMap(tab, path), "ready");
    assert.equal(await tab.evaluate(() => document.title), "bricks.png – tspace view");
    assert.match(await looked(tab), /^256 x 256 texels: a normal map in tangent space.*Green points down, as in DirectX \(\d+ % confidence/);
    assert.match(await tab.locator(".seen").textContent(), /^Bumps look like dents/);
    assert.match(await tab.locator(".fix button").textContent(), /invert green in 1 normal map/);
    const before = await pixelsOf(tab);
    await tab.evaluate(() => window.tspaceView.views.stage.viewport.setLight(0.7, -0.5));
    const other = await pixelsOf(tab);
    assert.ok(shareOf(before, (i) => farApart(before.data, i, other.data, i) > 6) > 0.05, "the light is followed");
    await shoot(tab, "lone-map");
    await tab.locator(".fix button.large").click();
    await tab.waitForSelector(".fix a.large");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.locator(".fix a.large").click()]);
    assert.equal(download.suggestedFilename(), "bricks-fixed.png");
    const fixed = decode(readFileSync(await download.path())), source = decode(readFileSync(path));
    assert.deepEqual([...fixed.data.subarray(0, 3000)], [...source.data.subarray(0, 3000)].map((x, i) => (i % source.channels === 1 ? 255 - x : x)));
    assert.match(await tab.locator(".seen").textContent(), /^Fixed:/);
    assert.match(await looked(tab), /Green points up, as in glTF and OpenGL/);
    await shoot(tab, "lone-map-fixed");
    const saved = join(folder, "fixed.png");
    await download.saveAs(saved);
    if (tool) assert.equal(JSON.parse(execFileSync(tool, ["check", "--json", saved])).files[0].image.green, "up");
  }));
});

test("DDS and KTX2 are checked by their texels", { skip: noTool }, async () => {
  await inFolder((folder) => withPage(async (tab) => {
    const path = await ringMap(tab, folder);
    for (const ending of ["dds", "ktx2"]) {
      const packed = join(folder, `bricks.${ending}`);
      execFileSync(tool, ["compress-map", path, "-o", packed, "--quiet"]);
      assert.equal(await openMap(tab, packed), "ready");
      assert.match(await looked(tab), /256 x 256 texels/);
      assert.equal(await tab.evaluate(() => document.documentElement.dataset.picture), "drawn");
    }
  }));
});

/** Clicks a conversion, and returns the downloaded file. */
async function converted(tab, name, folder) {
  const [download] = await Promise.all([tab.waitForEvent("download"), tab.locator(".convert button", { hasText: name }).click()]);
  const path = join(folder, download.suggestedFilename());
  await download.saveAs(path);
  return path;
}
const judged = (path) => JSON.parse(execFileSync(tool, ["check", "--json", path])).files[0].image;
const pixels = (path) => {
  const { width, height, depth, channels, data } = decode(readFileSync(path));
  return { width, height, depth, rgb: Array.from({ length: 3 * width * height }, (_, i) => data[channels * Math.floor(i / 3) + (i % 3)]) };
};

test("each conversion of a lone map takes one click, and equals the tool's", { skip: noTool }, async () => {
  await inFolder((folder) => withPage(async (tab) => {
    const path = await ringMap(tab, folder), wanted = join(folder, "wanted.png"), up = join(folder, "up.png");
    await openMap(tab, path);
    execFileSync(tool, ["convert-map", path, "-o", up, "--flip-green", "--bits", "8", "--quiet"]);
    const glTF = await converted(tab, "PNG, green up", folder);
    assert.equal(glTF, join(folder, "bricks-gltf.png"));
    assert.deepEqual(pixels(glTF), pixels(up));
    assert.equal(judged(glTF).green, "up");
    assert.deepEqual(pixels(await converted(tab, "PNG, green down", folder)), pixels(path), "the map is a map for DirectX already");
    for (const [name, file, args] of [
      ["KTX2, two channels", "bricks-gltf.ktx2", []], ["KTX2 for mobile", "bricks-gltf-eac.ktx2", ["--format", "eac-rg11"]], ["DDS, green up", "bricks-gltf.dds", []],
    ]) {
      const made = await converted(tab, name, folder), byTool = join(folder, `tool${file.slice(file.lastIndexOf("."))}`);
      assert.equal(made, join(folder, file));
      execFileSync(tool, ["compress-map", up, "-o", byTool, "--quiet", ...args]);
      assert.ok(readFileSync(made).equals(readFileSync(byTool)), file);
      assert.deepEqual([judged(made).green, judged(made).content], ["up", "twoChannels"]);
    }
    assert.equal(judged(await converted(tab, "DDS, green down", folder)).green, "down");
    // The reverse conversion: a two-channel texture becomes a PNG with three channels.
    for (const file of ["bricks-gltf.ktx2", "bricks-directx.dds"]) {
      assert.equal(await openMap(tab, join(folder, file)), "ready");
      const back = await converted(tab, "PNG, green up", folder), args = file.includes("directx") ? ["--flip-green"] : [];
      execFileSync(tool, ["convert-map", join(folder, file), "-o", wanted, "--quiet", ...args]);
      assert.deepEqual(pixels(back), pixels(wanted), file);
      assert.deepEqual([judged(back).green, judged(back).content], ["up", "normals"]);
    }
    await shoot(tab, "lone-map-convert");
  }));
});

test("the z of a two-channel PNG is reconstructed by one click", { skip: noTool }, async () => {
  await inFolder((folder) => withPage(async (tab) => {
    const path = await ringMap(tab, folder), two = join(folder, "two.png"), wanted = join(folder, "wanted.png");
    const { width, height, channels, depth, data } = decode(readFileSync(path));
    writeFileSync(two, encode({ width, height, channels, depth, data: data.map((c, i) => (i % channels === 2 ? 0 : c)) }));
    await openMap(tab, two);
    assert.match(await looked(tab), /a normal map that stores only x and y/);
    assert.match(await tab.locator(".fix button").textContent(), /store x, y and z in red, green and blue, invert green/);
    assert.match(await tab.locator(".mend .command").textContent(), /^tspace convert-map two.png -o two-fixed.png --channels rg --flip-green$/);
    await tab.locator(".fix button.large").click();
    await tab.waitForSelector(".fix a.large");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.locator(".fix a.large").click()]);
    const fixed = join(folder, download.suggestedFilename());
    await download.saveAs(fixed);
    execFileSync(tool, ["convert-map", two, "-o", wanted, "--channels", "rg", "--flip-green", "--quiet"]);
    assert.deepEqual(pixels(fixed), pixels(wanted));
    assert.match(await tab.locator(".seen").textContent(), /^Fixed:/);
  }));
});

test("a picture is not a normal map, and a corrupt file is reported", { skip: noShared }, async () => {
  await inFolder((folder) => withPage(async (tab) => {
    const broken = join(folder, "broken.png");
    writeFileSync(broken, "no PNG");
    assert.equal(await openMap(tab, broken), "failed");
    assert.match(await tab.locator(".failure").textContent(), /\S/);
    assert.doesNotMatch(await tab.locator(".failure").textContent(), /This page failed/);
  }, { allowMessages: true }));
});
