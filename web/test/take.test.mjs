// SPDX-License-Identifier: MIT
// Contents of a file, and exports: parts, images, the report as text, the picture with its labels.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { decode } from "fast-png";
import { choose, drawn, missing, noShared, noTool, openFile, shared, shoot, tool, withPage } from "./support.mjs";

const panel = (tab, name) => tab.locator(`details.${name} > summary`).click();

test("parts are hidden and shown, and images have their channels", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    await openFile(tab, join(shared, "models/assets/Cat.glb"));
    await panel(tab, "parts");
    const text = await tab.locator(".parts dl").textContent();
    assert.match(text, /Triangles4,285/);
    assert.match(text, /44 primitives, 44 with tangents/);
    const before = await tab.locator(".frame canvas").screenshot();
    await tab.locator(".part-list input").first().uncheck();
    await drawn(tab);
    assert.ok(!before.equals(await tab.locator(".frame canvas").screenshot()), "a part is hidden");
    await tab.locator(".part-list input").first().check();
    await drawn(tab);
    assert.ok(before.equals(await tab.locator(".frame canvas").screenshot()), "and shown again");
    const torso = tab.locator(".part-list label", { hasText: /^torso$/ }).locator("input"), hiddenPlaces = () => tab.evaluate(() => window.tspaceView.views.stage.viewport.scene.drawn.flatMap(({ hidden, part }) => (hidden.size > 0 ? [part.mesh] : [])));
    await torso.uncheck();
    assert.deepEqual(await hiddenPlaces(), [1, 2], "a node takes what is below it along");
    assert.equal(await tab.locator(".part-list label", { hasText: /polySurface5_/ }).locator("input").isChecked(), false);
    await torso.check();
    assert.deepEqual(await hiddenPlaces(), []);
    assert.ok((await tab.locator(".parts select option").count()) >= 2);
    assert.match(await tab.locator(".parts select option").first().textContent(), /^(base color|normal map) of .*, \d+ x \d+$/);
    const shown = () => tab.locator(".parts .map canvas").screenshot();
    const rgb = await shown();
    await choose(tab, "G", ".parts");
    assert.ok(!rgb.equals(await shown()));
    await tab.locator(".parts").scrollIntoViewIfNeeded();
    await shoot(tab, "parts");
  }, { allowMessages: true });
});

test("the report is copied as text, Markdown and JSON", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await tab.evaluate(() => {
      window.copied = [];
      Object.defineProperty(navigator, "clipboard", { value: { writeText: async (text) => void window.copied.push(text) } });
    });
    await panel(tab, "share");
    for (const kind of ["text", "markdown", "json"]) {
      await tab.locator(".share select").selectOption(kind);
      await tab.getByRole("button", { name: "Copy the report" }).click();
    }
    const [text, markdown, json] = await tab.evaluate(() => window.copied);
    assert.match(text, /^crate-signs-lost\.glb\n\n1 error, 0 warnings, 0 notes\. tspace [\d.]+, [\d-]+\.\n\nerror {4}signsWrong at \/meshes\/0\/primitives\/0\n/);
    assert.match(markdown, /^### crate-signs-lost\.glb\n[^]*\n- \*\*error\*\* `signsWrong`[^]* Cause: the sign \(w\) of [^]*\n {2}- fix: .*generate --repair/);
    assert.equal(JSON.parse(json).check.findings[0].code, "signsWrong");
  });
});

test("the picture is saved with the file, both sides and the version below it", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await choose(tab, "Difference");
    await drawn(tab);
    await panel(tab, "share");
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.getByRole("button", { name: "Save the picture" }).click()]);
    assert.equal(download.suggestedFilename(), "crate-signs-lost-difference.png");
    const path = await download.path(), image = decode(readFileSync(path)), canvas = await tab.locator(".frame canvas").evaluate(({ width, height }) => ({ width, height }));
    assert.equal(image.width, canvas.width);
    assert.ok(image.height > canvas.height + 20);
    const colors = new Set();
    for (let i = 0; i < image.width * canvas.height; i += 97) colors.add(image.data.subarray(image.channels * i, image.channels * i + 3).join());
    assert.ok(colors.size > 50, "the model is in it");
    await download.saveAs(join(process.env.TSPACE_SCREENSHOTS, "saved-picture.png"));
  });
});

test("a page of the tool states its date and command, and has no link to the lesson", { skip: noTool }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-view-"));
  try {
    const model = join(folder, "it's a crate.glb"), made = join(folder, "crate.html");
    const crate = await withPage((tab) => tab.evaluate(() => [...window.tspaceView.model.bytes]));
    writeFileSync(model, Buffer.from(crate));
    execFileSync(tool, ["view", "-q", model, "-o", made], { env: { ...process.env, SOURCE_DATE_EPOCH: "1767225600" } });
    await withPage(async (tab) => {
      assert.equal(await tab.locator(".model-name").textContent(), "it's a crate.glb");
      assert.equal(await tab.evaluate(() => document.documentElement.dataset.picture), "drawn");
      const text = await tab.locator(".parts .made").textContent();
      assert.match(text, /made on 2026-01-01 00:00 UTC by tspace \d+\.\d+\.\d+: tspace view -q '.*it'\\''s a crate\.glb' -o /);
      assert.equal(await tab.locator("a.lesson").count(), 0, "it may be anywhere, without the lesson beside it");
    }, { url: pathToFileURL(made).href });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
