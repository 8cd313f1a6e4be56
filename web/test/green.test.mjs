// SPDX-License-Identifier: MIT
// Normal maps whose green points down are detected, displayed, and inverted as by the tool.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { decode, encode } from "fast-png";
import { Glb } from "./glb.mjs";
import { choose, drawn, fixAndDownload, missing, noTool, openFile, openSample, settled, shoot, tool, withPage } from "./support.mjs";

const codes = (tab) => tab.locator(".finding").evaluateAll((items) => items.map((item) => item.dataset.code));

async function ring(tab) {
  await openSample(tab, "ring-directx.glb");
  return new Glb(Buffer.from(await tab.evaluate(() => [...window.tspaceView.model.bytes])));
}

async function turned(tab) {
  await tab.locator(".mend > summary").click();
  await tab.getByLabel("Invert green in maps").check();
  return fixAndDownload(tab);
}

test("green that points down is detected, shown and fixed", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await ring(tab);
    assert.ok((await codes(tab)).includes("greenFlipped"));
    await tab.locator(".finding[data-code=greenFlipped]").click();
    assert.match(await tab.locator(".details:visible").textContent(), /--flip-green/);
    const before = await tab.locator(".frame canvas").screenshot();
    await choose(tab, "green inverted", ".look");
    await drawn(tab);
    assert.ok(!before.equals(await tab.locator(".frame canvas").screenshot()), "the picture has other light");
    await shoot(tab, "green-turned");
    await choose(tab, "on", ".look");
    await turned(tab);
    assert.match(await tab.locator(".command").textContent(), / --repair --flip-green$/);
    assert.match(await tab.locator(".changes.maps").textContent(), /bricks-directxgreen inverted/);
    await shoot(tab, "green-mended");
    await tab.getByRole("button", { name: "Open the fixed file" }).click();
    await settled(tab);
    assert.deepEqual(await codes(tab), []);
  });
});

/** The ring's map in other formats: 8 and 16 bits, with heights in alpha, JPEG and WebP. */
const kinds = {
  "8 bits": ({ image }) => encode(image),
  "8 bits and alpha": ({ image }) => encode({ ...image, channels: 4, data: withAlpha(image, Uint8Array, (i) => i % 256) }),
  "16 bits": ({ image }) => encode({ ...image, depth: 16, data: Uint16Array.from(image.data, (value, i) => 257 * value ^ i % 4) }),
  "16 bits and alpha": ({ image }) => encode({ ...image, channels: 4, depth: 16, data: withAlpha(image, Uint16Array, (i) => 99 * (i % 600), 257) }),
  "JPEG": ({ image, tab }) => byCanvas(tab, image, "image/jpeg", 0.9),
  "WebP": ({ image, tab }) => byCanvas(tab, image, "image/webp", 1),
};
/** Maximum mean difference from the tool's pixels, of 255. */
const kMostDifference = { "JPEG": 1.5, "WebP": 0 };

const withAlpha = ({ width, height, data }, Type, alpha, scale = 1) => Type.from({ length: 4 * width * height }, (_, i) => (i % 4 === 3 ? alpha(i >> 2) : scale * data[3 * (i >> 2) + (i % 4)]));

const byCanvas = async (tab, { width, height, data }, type, quality) => Buffer.from(await tab.evaluate(async ([width, height, data, type, quality]) => {
  const canvas = new OffscreenCanvas(width, height), image = new ImageData(width, height);
  for (let i = 0; i < image.data.length; ++i) image.data[i] = i % 4 === 3 ? 255 : data[3 * (i >> 2) + (i % 4)];
  canvas.getContext("2d").putImageData(image, 0, 0);
  return [...new Uint8Array(await (await canvas.convertToBlob({ type, quality })).arrayBuffer())];
}, [width, height, [...data], type, quality]));

const decodedByTab = (tab, file) => tab.evaluate(async (bytes) => {
  const bitmap = await createImageBitmap(new Blob([Uint8Array.from(bytes)]));
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
  context.drawImage(bitmap, 0, 0);
  return [...context.getImageData(0, 0, bitmap.width, bitmap.height).data];
}, [...file]);

/** Returns the parts of a GLB that do not depend on the size of its image. */
function withoutImage(glb) {
  const { json } = glb, own = json.images[0].bufferView;
  const views = json.bufferViews.map((_, i) => (i === own ? null : glb.bytesOfView(i).toString("base64")));
  return { ...json, buffers: null, bufferViews: json.bufferViews.map((view) => ({ ...view, byteOffset: 0, byteLength: 0 })), views };
}

test("inverted maps have the pixels of the tool, and all other data its bytes", { skip: noTool }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-green-"));
  try {
    await withPage(async (tab) => {
      const sample = await ring(tab), image = decode(sample.bytesOfImage(0));
      for (const [kind, fileOf] of Object.entries(kinds)) {
        const file = await fileOf({ image, tab }), glb = new Glb(sample.finish()), path = join(folder, "ring.glb"), wantedPath = join(folder, "wanted.glb");
        glb.json.images[0] = { ...glb.json.images[0], bufferView: glb.addView(file), mimeType: `image/${kind in kMostDifference ? kind.toLowerCase() : "png"}` };
        writeFileSync(path, glb.finish());
        await openFile(tab, path);
        assert.ok((await codes(tab)).includes("greenFlipped"), kind);
        const made = new Glb(await turned(tab));
        execFileSync(tool, ["generate", path, "-o", wantedPath, "--repair", "--flip-green", "--quiet"]);
        const wanted = new Glb(readFileSync(wantedPath));
        assert.deepEqual(withoutImage(made), withoutImage(wanted), kind);
        assert.equal(made.bytesOfImage(0).equals(wanted.bytesOfImage(0)), false, `${kind}: had they the same bytes, the page need not say that they differ`);
        if (kind in kMostDifference) {
          const [a, b] = [await decodedByTab(tab, made.bytesOfImage(0)), await decodedByTab(tab, wanted.bytesOfImage(0))];
          const far = a.reduce((sum, x, i) => sum + Math.abs(x - b[i]), 0) / a.length;
          assert.ok(far <= kMostDifference[kind], `${kind}: ${far} of 255 on average`);
        } else {
          const [a, b] = [made, wanted].map((one) => decode(one.bytesOfImage(0), { checkCrc: true }));
          assert.deepEqual([a.depth, a.channels, a.data], [b.depth, b.channels, b.data], kind);
        }
        await tab.locator(".mend > summary").click();
      }
    });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
