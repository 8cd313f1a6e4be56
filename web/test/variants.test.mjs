// SPDX-License-Identifier: MIT
// KHR_materials_variants: the page offers a choice if a file has variants, and shows the materials of each.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { farApart, missing, named, noShared, openFile, pixelsOf, settled, shared, shareOf, shoot, withPage } from "./support.mjs";

const materials = (tab) => tab.evaluate(() => window.tspaceView.views.stage.viewport.scene.drawn.map(({ part }) => part.material));
const eye = (tab) => tab.evaluate(() => window.tspaceView.views.stage.viewport.camera.position.toArray());
const shown = (tab, variant) => tab.waitForFunction((variant) => window.tspaceView.variant === variant && !document.querySelector(".progress.busy"), variant);

test("each variant is shown with its materials from the same camera, and the file's own materials are restored", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    const path = join(shared, "models/blender/18_variants/18_variants.gltf"), json = JSON.parse(readFileSync(path, "utf8"));
    const names = json.extensions.KHR_materials_variants.variants.map(({ name }) => name);
    assert.equal(await openFile(tab, path, { others: named(path) }), "ready");
    const choice = tab.locator(".look").getByLabel("Variant");
    assert.deepEqual(await choice.locator("option").allTextContents(), ["none (materials of the file)", ...names]);
    const own = await materials(tab), before = await pixelsOf(tab), place = await eye(tab);
    for (const i of names.keys()) {
      await choice.selectOption(String(i));
      await shown(tab, i);
      const wanted = json.meshes.flatMap(({ primitives }) => primitives.map(({ material, extensions }) =>
        extensions?.KHR_materials_variants.mappings.find(({ variants }) => variants.includes(i))?.material ?? material));
      assert.deepEqual((await materials(tab)).sort(), wanted.sort(), names[i]);
      assert.deepEqual(await eye(tab), place);
      const seen = await pixelsOf(tab), other = shareOf(seen, (k) => farApart(seen.data, k, before.data, k) > 12);
      assert.equal(other > 0.02, wanted.join() !== own.join(), `${names[i]}: ${other}`);
      await shoot(tab, `variant-${i}`);
    }
    await choice.selectOption("-1");
    await shown(tab, -1);
    assert.deepEqual(await materials(tab), own);
    const back = await pixelsOf(tab);
    assert.ok(shareOf(back, (k) => farApart(back.data, k, before.data, k) > 6) < 0.001, "and the same again");
  }, { allowMessages: true });
});

test("a file without variants has no choice, and one with empty mappings keeps its materials", { skip: missing }, async () => {
  await withPage(async (tab) => {
    assert.equal(await tab.locator(".look").getByLabel("Variant").isVisible(), false);
    await tab.evaluate(() => {
      const { bytes } = window.tspaceView.model, length = new DataView(bytes.buffer).getUint32(12, true);
      const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
      json.extensionsUsed = ["KHR_materials_variants"];
      json.extensions = { KHR_materials_variants: { variants: [{ name: "<b>one</b>" }, {}] } };
      json.meshes[0].primitives[0].extensions = { KHR_materials_variants: { mappings: [{ material: 0, variants: [7] }] } };
      const text = new TextEncoder().encode(JSON.stringify(json)), padded = new Uint8Array(4 * Math.ceil(text.length / 4)).fill(0x20);
      padded.set(text);
      const rest = bytes.subarray(20 + length), all = new Uint8Array(20 + padded.length + rest.length), view = new DataView(all.buffer);
      [0x46546c67, 2, all.length, padded.length, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
      all.set(padded, 20);
      all.set(rest, 20 + padded.length);
      void window.tspaceView.open(async () => ({ name: "odd.glb", bytes: all, others: new Map() }));
    });
    assert.equal(await settled(tab), "ready", await tab.locator(".findings").textContent());
    const own = await materials(tab), choice = tab.locator(".look").getByLabel("Variant");
    assert.deepEqual(await choice.locator("option").allTextContents(), ["none (materials of the file)", "<b>one</b>", "variant 1"]);
    await choice.selectOption("0");
    await shown(tab, 0);
    assert.deepEqual(await materials(tab), own);
  });
});

test("a variant with missing materials is reported, and the model is kept", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    assert.equal(await openFile(tab, join(shared, "models/assets/MaterialsVariantsShoe_draco.glb")), "ready");
    const own = await materials(tab), choice = tab.locator(".look").getByLabel("Variant");
    await choice.selectOption({ label: "beach" });
    await shown(tab, 1);
    assert.match(await tab.locator(".remark").textContent(), /names a material that is not in it/);
    assert.deepEqual(await materials(tab), own);
    await choice.selectOption({ label: "midnight" });
    await shown(tab, 0);
    assert.equal(await tab.locator(".remark").isVisible(), false);
  }, { allowMessages: true });
});
