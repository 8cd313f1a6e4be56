// SPDX-License-Identifier: MIT
// The gallery of real faults: check detects each one, one click fixes it, and the two sides of the line show before and after.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { choose, drawn, farApart, fixAndDownload, missing, noTool, openSample, pixelsOf, settled, shareOf, shoot, tool, withPage } from "./support.mjs";

const found = {
  "crate-signs-inverted.glb": "signsInverted", "crate-signs-lost.glb": "signsWrong", "crate-seams-shared.glb": "mirroredSeamAveraged", "crate-along-normals.glb": "tangentsNotOrthogonal",
  "crate-wrong-set.glb": "uvSetWrong", "crate-wrong-axes.glb": "directionsWrong", "bear-by-ai.glb": "normalsAgainstWinding", "ring-directx.glb": "greenFlipped",
};
const codes = (tab) => tab.locator(".finding").evaluateAll((items) => items.map((item) => item.dataset.code));
const differing = (one, other) => shareOf(one, (i) => farApart(one.data, i, other.data, i) > 6);

async function side(tab, split) {
  await tab.locator(".split").fill(split);
  return pixelsOf(tab);
}

test("each fault of the gallery is detected, and fixed by the preset options", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await tab.locator(".mend > summary").click();
    assert.deepEqual((await tab.locator(".sample").evaluateAll((all) => all.map(({ dataset }) => dataset.file))).sort(), [...Object.keys(found), "crate.glb"].sort());
    for (const [label, code] of Object.entries(found)) {
      assert.equal(await openSample(tab, label), "ready");
      assert.ok((await codes(tab)).includes(code), `${label}: ${await codes(tab)}`);
      await fixAndDownload(tab);
      const asksForMore = tab.locator(".result p", { hasText: "Recompute all tangents to fix these too" });
      assert.equal(await asksForMore.count(), label === "crate-wrong-axes.glb" ? 1 : 0, `${label}: a repair keeps tangents that are a little off`);
      if (label === "crate-wrong-axes.glb") {
        await choose(tab, "recompute all", ".mend");
        await fixAndDownload(tab);
      }
      const counts = await tab.locator(".result .counts").textContent();
      assert.match(counts, /→ (0 errors)?(, )?(0 warnings)?(, \d+ notes?)?$/, `${label}: ${counts}`);
      await tab.waitForFunction(() => document.querySelector(".side.right").textContent === "fixed");
      assert.ok(differing(await side(tab, "1000"), await side(tab, "0")) > 0.005, `${label}: before and after differ`);
      await tab.locator(".split").fill("500");
      await shoot(tab, `fault-${code}`);
    }
  }, { width: 1400, height: 520 });
});

test("an AI-generated mesh is fixed with the bytes of the tool, and the fixed shape is shown right of the line", { skip: noTool }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-bear-"));
  try {
    await withPage(async (tab) => {
      await openSample(tab, "bear-by-ai.glb");
      assert.deepEqual(await codes(tab), ["normalsAgainstWinding", "positionsNoisy"]);
      await tab.locator(".finding").first().click();
      assert.match(await tab.locator(".finding").first().textContent(), /normals of 1024 of 5500 triangles/);
      assert.equal(await tab.locator(".frame canvas").getAttribute("data-outlined"), "1024", "all of them are outlined");
      await tab.locator(".finding").last().click();
      await tab.locator(".details:not([hidden]) .mend-this").click();
      assert.match(await tab.locator(".command").textContent(), / --repair --fix-winding --overwrite-normals --normals best --denoise auto$/);
      const bytes = await fixAndDownload(tab), [, ...words] = (await tab.locator(".command").textContent()).split(" ");
      writeFileSync(join(folder, "bear-by-ai.glb"), Uint8Array.from(await tab.evaluate(() => [...window.tspaceView.model.bytes])));
      execFileSync(tool, [...words, "--quiet"], { cwd: folder });
      assert.ok(bytes.equals(readFileSync(join(folder, "bear-by-ai-fixed.glb"))));
      await tab.waitForFunction(() => document.querySelector(".side.right").textContent === "fixed");
      // Hides the outline of the finding, and restores the initial camera.
      await tab.evaluate(() => window.tspaceView.views.place.clear());
      await tab.locator(".frame canvas").press("0");
      const before = await side(tab, "1000"), after = await side(tab, "0");
      assert.ok(differing(before, after) > 0.01, "the holes are closed");
      await tab.locator(".look select").first().selectOption("mikktspace");
      await drawn(tab);
      assert.ok(differing(before, await side(tab, "0")) < 0.001, "another right side is not the fixed file");
      await tab.getByRole("button", { name: "Open the fixed file" }).click();
      await tab.waitForFunction(() => window.tspaceView.model?.name === "bear-by-ai-fixed.glb");
      await settled(tab);
      assert.ok(differing(after, await side(tab, "1000")) < 0.01, "the former right side is the fixed file");
    }, { width: 1400, height: 520 });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
