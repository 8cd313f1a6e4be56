// SPDX-License-Identifier: MIT
// The example examples/gpu_page in Chromium: a screenshot shows lit models, and a heat map with small errors on finely tessellated surfaces.
import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { it } from "node:test";
import { missing, runPage } from "./browser.mjs";

const folder = process.env.TSPACE_EXAMPLES && join(process.env.TSPACE_EXAMPLES, "gpu_page");
const pngjs = await import("pngjs").catch(() => null);

const background = [0x23, 0x26, 0x2d];
/** Returns statistics of the pixels that are not background: their share, mean color, and mean difference of neighbors. */
function statisticsOf({ data, width }, { x, y, width: wide, height: high }) {
  const sum = [0, 0, 0];
  let covered = 0, steps = 0;
  for (let row = Math.round(y); row < Math.round(y + high) - 1; ++row) {
    for (let column = Math.round(x); column < Math.round(x + wide) - 1; ++column) {
      const at = 4 * (row * width + column), color = [...data.subarray(at, at + 3)];
      if (color.every((value, i) => Math.abs(value - background[i]) < 4)) continue;
      ++covered;
      color.forEach((value, i) => (sum[i] += value));
      steps += Math.abs(color[0] - data[at + 4]) + Math.abs(color[1] - data[at + 5]) + Math.abs(color[2] - data[at + 6]);
    }
  }
  return { share: covered / (wide * high), mean: sum.map((total) => Math.round(total / covered)), roughness: steps / covered };
}

it("shows a cloth and a morphing model next to derivative frames", { skip: missing || (!(folder && existsSync(folder)) && "no examples here") || (!pngjs && "pngjs is not installed"), timeout: 300_000 }, async (t) => {
  const [html, page] = ["index.html", "page.js"].map((name) => readFileSync(join(folder, name), "utf8"));
  let picture, boxes;
  const { hasAdapter } = await runPage({
    html, page, query: "?time=0.9", size: { width: 1200, height: 880 },
    body: async (tab) => {
      const bytes = await tab.screenshot();
      if (process.env.TSPACE_SCREENSHOT) writeFileSync(process.env.TSPACE_SCREENSHOT, bytes);
      picture = pngjs.PNG.sync.read(bytes);
      boxes = await tab.evaluate(() => [...document.querySelectorAll("canvas")].map((canvas) => canvas.getBoundingClientRect().toJSON()));
    },
  });
  if (!hasAdapter) return t.skip("this Chromium has no WebGPU adapter");
  assert.equal(boxes.length, 6);
  const views = boxes.map((box) => statisticsOf(picture, box));
  t.diagnostic(JSON.stringify(views));
  for (let model = 0; model < 6; model += 3) {
    const [own, derived, heat] = views.slice(model, model + 3);
    for (const { share } of [own, derived, heat]) assert.ok(share > 0.25 && share < 0.9, "the model is seen");
    own.mean.forEach((level, i) => assert.ok(Math.abs(level - derived.mean[i]) < 0.1 * level, "both frames are lit alike"));
    assert.ok(derived.roughness > 1.02 * own.roughness, "frames from derivatives show facets");
    assert.ok(heat.mean[2] > 2 * heat.mean[0] && heat.roughness > 10, "differences are small on most pixels, and not the same everywhere");
  }
});
