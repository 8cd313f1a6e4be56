// SPDX-License-Identifier: MIT
// Comparing two versions of a model; also the exported page, links, and files stored in the browser.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { choose, drawn, farApart, missing, openSample, page, pixelsOf, settled, shareOf, shoot, withPage } from "./support.mjs";

const bytesOf = async (tab) => Buffer.from(await tab.evaluate(() => [...window.tspaceView.model.bytes]));
const inFolder = async (act) => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-two-"));
  try {
    return await act(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
};

test("two versions are shown left and right of the line, with the angle between them", { skip: missing }, async () => {
  await inFolder((folder) => withPage(async (tab) => {
    const path = join(folder, "right.glb");
    await openSample(tab, "crate.glb");
    writeFileSync(path, await bytesOf(tab));
    await openSample(tab, "crate-signs-lost.glb");
    await tab.locator(".open .picker input").last().setInputFiles(path);
    await tab.locator(".figures", { hasText: "the other file" }).waitFor();
    await tab.locator(".seen", { hasText: "Two versions" }).waitFor();
    assert.match(await tab.locator(".seen").textContent(), /left crate-signs-lost\.glb \(1 error\), right right\.glb \(no findings\)/);
    assert.deepEqual(await tab.locator(".side").allTextContents(), ["crate-signs-lost.glb", "right.glb"]);
    assert.match(await tab.locator(".figures").textContent(), /1,728 of 5,184 corners have a different sign/);
    await choose(tab, "Difference");
    await drawn(tab);
    await shoot(tab, "two-versions");
    await openSample(tab, "crate.glb");
    assert.equal(await tab.locator(".side.left").textContent(), "as in the file");
  }));
});

/** Returns both halves of the picture, without overlays. */
async function halves(tab) {
  const { width, height, channels, data } = await pixelsOf(tab), half = Math.floor(width / 2), take = (from) => {
    const out = { width: half, height, channels, data: new Uint8Array(channels * half * height) };
    for (let y = 0; y < height; ++y) out.data.set(data.subarray(channels * (y * width + from), channels * (y * width + from + half)), channels * y * half);
    return out;
  };
  return [take(0), take(width - half)];
}
const apart = (one, other) => shareOf(one, (i) => farApart(one.data, i, other.data, i) > 12);

test("side by side, both files have a picture with the same camera and the angle between them", { skip: missing }, async () => {
  await inFolder((folder) => withPage(async (tab) => {
    const right = join(folder, "right.glb"), beside = tab.locator(".stage .check", { hasText: "Side by side" });
    await openSample(tab, "crate.glb");
    assert.equal(await beside.isVisible(), false, "it is for two files");
    writeFileSync(right, await bytesOf(tab));
    const compare = async () => {
      await tab.locator(".open .picker input").last().setInputFiles(right);
      await tab.locator(".seen", { hasText: "Two versions" }).waitFor();
      await tab.locator(".figures", { hasText: "the other file" }).waitFor();
      await beside.locator("input").check();
    };
    // A file compared with itself: both pictures are equal for any camera.
    await compare();
    const [first, second] = await halves(tab);
    assert.ok(shareOf(first, (i) => farApart(first.data, i, first.data, 0) > 20) > 0.1, "the model is there");
    assert.ok(apart(first, second) < 0.01, `${apart(first, second)}`);
    await tab.locator(".frame canvas").focus();
    for (const key of ["ArrowLeft", "ArrowLeft", "ArrowUp", "+", "Shift+ArrowRight"]) await tab.keyboard.press(key);
    await tab.locator(".frame canvas").evaluate((canvas) => canvas.blur()); // removes the focus outline of the canvas, which surrounds both pictures
    const [turned, other] = await halves(tab);
    assert.ok(apart(first, turned) > 0.05, "the camera was moved");
    assert.ok(apart(turned, other) < 0.01, `${apart(turned, other)}`);
    // Two versions: each file's own frames, and the angle between them in both pictures.
    await openSample(tab, "crate-signs-lost.glb");
    assert.deepEqual(await tab.evaluate(() => window.tspaceView.views.stage.viewport.settings.isBeside), false);
    await compare();
    assert.deepEqual(await tab.locator(".side:visible").allTextContents(), ["crate-signs-lost.glb", "right.glb"]);
    await choose(tab, "Signs");
    const signs = await halves(tab);
    assert.ok(apart(...signs) > 0.02, "each picture has the signs of its own file");
    await choose(tab, "Difference");
    const [mine, theirs] = await halves(tab), isHot = ({ data }) => (i) => data[i] > data[i + 2] + 60;
    assert.ok(shareOf(mine, isHot(mine)) > 0.01, "the first file shows where they differ");
    assert.ok(Math.abs(shareOf(mine, isHot(mine)) - shareOf(theirs, isHot(theirs))) < 0.01, "so does the second, there");
    await shoot(tab, "side-by-side");
    // The left file is under the pointer in both pictures.
    const triangle = (x) => tab.evaluate((x) => {
      const { viewport } = window.tspaceView.views.stage, { width, height } = viewport.canvas.getBoundingClientRect();
      return viewport.pick(width * x, height / 2);
    }, x);
    assert.ok((await triangle(0.25)) >= 0);
    assert.equal(await triangle(0.25), await triangle(0.75));
  }));
});

test("one HTML page contains the model, its findings and the view", { skip: missing }, async () => {
  await inFolder(async (folder) => {
    const saved = join(folder, "saved.html");
    await withPage(async (tab) => {
      await choose(tab, "Signs");
      await tab.locator(".split").fill("250");
      await tab.waitForFunction(() => location.hash.includes("look=signs") && location.hash.includes("split=0.25"));
      await tab.locator(".share > summary").click();
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.getByRole("button", { name: "Save one HTML page" }).click()]);
      assert.equal(download.suggestedFilename(), "crate-signs-lost.html");
      await download.saveAs(saved);
    });
    await withPage(async (tab) => {
      assert.equal(await tab.evaluate(() => document.documentElement.dataset.state), "ready");
      assert.equal(await tab.locator(".model-name").textContent(), "crate-signs-lost.glb");
      assert.deepEqual(await tab.locator(".finding").evaluateAll((all) => all.map(({ dataset }) => dataset.code)), ["signsWrong"]);
      const { look, split } = await tab.evaluate(() => window.tspaceView.views.stage.viewport.settings);
      assert.deepEqual([look, split], ["signs", 0.25]);
    }, { url: pathToFileURL(saved).href });
  });
});

test("the user's model is available after a reload, until it is deleted", { skip: missing }, async () => {
  const server = createServer((_, response) => response.writeHead(200, { "content-type": "text/html" }).end(readFileSync(page)));
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  try {
    await inFolder((folder) => withPage(async (tab) => {
      const path = join(folder, "my.glb"), name = () => tab.locator(".model-name").textContent();
      await openSample(tab, "crate.glb");
      writeFileSync(path, await bytesOf(tab));
      await tab.locator(".picker input").first().setInputFiles(path);
      await tab.locator(".kept", { hasText: "my.glb is kept in this browser" }).waitFor();
      await tab.waitForFunction(() => window.tspaceView.model?.name === "my.glb" && document.documentElement.dataset.state === "ready" && !location.hash.includes("sample="));
      await tab.reload();
      await settled(tab);
      assert.equal(await name(), "my.glb");
      await tab.getByRole("button", { name: "Remove it" }).click();
      await tab.waitForFunction(() => document.querySelector(".kept").textContent === "");
      await tab.reload();
      await settled(tab);
      assert.equal(await name(), "crate-signs-lost.glb");
    }, { url: `http://127.0.0.1:${server.address().port}/`, mayAsk: /^http:\/\/127\.0\.0\.1/ }));
  } finally {
    server.closeAllConnections();
    server.close();
  }
});
