// SPDX-License-Identifier: MIT
// Renders the pictures of the samples with a built page and Chromium: the file's tangents on the left, correct tangents on the right. From the folder
// build/web/project: TSPACE_PAGE=../view.html node samples/pictures.mjs FOLDER
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { drawn, openSample, withPage } from "../test/support.mjs";

const [, , folder] = process.argv, kWidth = 120, kHeight = 80;

await withPage(async (tab) => {
  const files = await tab.locator(".sample").evaluateAll((all) => all.map(({ dataset }) => dataset.file));
  for (const file of files) {
    await openSample(tab, file);
    await drawn(tab);
    const text = await tab.evaluate(async ([width, height]) => {
      const { viewport } = window.tspaceView.views.stage;
      const all = viewport.draw(), scale = Math.max(width / all.width, height / all.height), small = new OffscreenCanvas(width, height), context = small.getContext("2d");
      context.fillStyle = "#6f7276";
      context.fillRect(0, 0, width, height);
      context.imageSmoothingQuality = "high";
      context.drawImage(all, (width - scale * all.width) / 2, (height - scale * all.height) / 2, scale * all.width, scale * all.height);
      const bytes = new Uint8Array(await (await small.convertToBlob({ type: "image/webp", quality: 0.72 })).arrayBuffer());
      return btoa(String.fromCharCode(...bytes));
    }, [kWidth, kHeight]);
    writeFileSync(join(folder, file.replace(".glb", ".webp")), Buffer.from(text, "base64"));
  }
}, { width: 1280, height: 800 });
