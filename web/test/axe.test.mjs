// SPDX-License-Identifier: MIT
// Accessibility of page and lesson: axe-core reports no violation in any state.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { test } from "node:test";
import { choose, drawn, fixAndDownload, missing, named, noShared, openFile, openSample, shared, withPage } from "./support.mjs";

const lesson = process.env.TSPACE_LESSON;
const axe = (() => {
  try {
    return readFileSync(fileURLToPath(import.meta.resolve("axe-core/axe.min.js")), "utf8");
  } catch {
    return null;
  }
})();
const skip = missing || (!axe && "axe-core is not installed");

/** Returns the violations that axe-core reports: rule and element. Its script bypasses the page's content security policy, which would reject it. */
async function objections(tab) {
  if (!(await tab.evaluate(() => "axe" in window))) await tab.evaluate(axe);
  const { violations } = await tab.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  return violations.flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target.join(" ")}: ${failureSummary.split("\n").slice(1).join(";").trim()}`));
}

test("axe-core reports a control without a name", { skip }, async () => {
  await withPage(async (tab) => {
    await tab.evaluate(() => document.querySelector(".split").removeAttribute("aria-label"));
    assert.match((await objections(tab)).join(), /^label: \.split/);
  });
});

const looks = ["Lit", "Difference", "Normals", "Signs", "Mirrored", "Error", "Islands"];
const sizes = ["light", "dark"].flatMap((scheme) => [[390, 844], [1280, 800]].map(([width, height]) => ({ scheme, width, height })));

for (const { scheme, width, height } of sizes) {
  test(`axe-core reports no violation on the page at ${width} pixels, ${scheme}`, { skip }, async () => {
    await withPage(async (tab) => {
      const found = [], look = async (where) => found.push(...(await objections(tab)).map((text) => `${where}: ${text}`));
      for (const name of looks) {
        await choose(tab, name);
        await drawn(tab);
        await look(name);
      }
      await tab.evaluate(() => document.querySelectorAll("details").forEach((details) => (details.open = true)));
      await tab.locator(".finding").first().click();
      await drawn(tab);
      await look("all open, and a finding");
      await fixAndDownload(tab);
      await look("mended");
      await tab.locator(".uv button", { hasText: "Large" }).click();
      await drawn(tab);
      await look("large UV map");
      await openSample(tab, "ring-directx.glb");
      await look("ring");
      await openSample(tab, "bear-by-ai.glb");
      await look("mesh by AI");
      for (const name of noShared ? [] : ["khronos/AnimatedMorphCube.glb", "blender/18_variants/18_variants.gltf"]) {
        const path = join(shared, "models", name);
        await openFile(tab, path, { others: named(path) });
        await tab.evaluate(() => document.querySelectorAll("details").forEach((details) => (details.open = true)));
        await look(name);
      }
      await tab.evaluate(() => window.tspaceView.fail("This file cannot be opened: it ends before its JSON does."));
      await look("failure");
      assert.deepEqual(found, []);
    }, { width, height, scheme, allowMessages: true });
  });

  test(`axe-core reports no violation in the lesson at ${width} pixels, ${scheme}`, { skip: skip || (!lesson && "the lesson was not built") }, async () => {
    await withPage(async (tab) => {
      assert.deepEqual(await objections(tab), []);
      await tab.evaluate(() => document.querySelectorAll("details").forEach((details) => (details.open = true)));
      assert.deepEqual(await objections(tab), []);
    }, { width, height, scheme, url: pathToFileURL(lesson).href });
  });
}
