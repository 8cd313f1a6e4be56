// SPDX-License-Identifier: MIT
// What is in a file, and what one takes along: parts, images, the report as text, the picture with its words.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { decode } from "fast-png";
import { choose, drawn, missing, noShared, openFile, shared, shoot, withPage } from "./support.mjs";

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
    assert.ok(!before.equals(await tab.locator(".frame canvas").screenshot()), "the head is hidden");
    await tab.locator(".part-list input").first().check();
    await drawn(tab);
    assert.ok(before.equals(await tab.locator(".frame canvas").screenshot()), "and shown again");
    assert.ok((await tab.locator(".parts select option").count()) >= 2);
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
    assert.match(markdown, /^### crate-signs-lost\.glb\n[^]*\n- \*\*error\*\* `signsWrong`[^]*\n {2}- mend: .*generate --repair/);
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
