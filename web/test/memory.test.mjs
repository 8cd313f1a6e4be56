// SPDX-License-Identifier: MIT
// Closing a model frees its memory; models of 100 MB load with progress, and loading them can be stopped.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { gridGlb } from "./glb.mjs";
import { drawn, missing, openBytes, settled, withPage } from "./support.mjs";

const kCycles = 10;

/** Returns the megabytes that the page uses after garbage collection, and its number of GPU resources. */
async function held(tab, session) {
  await drawn(tab);
  for (let i = 0; i < 3; ++i) await session.send("HeapProfiler.collectGarbage");
  const { usedSize, embedderHeapUsedSize = 0, backingStorageSize = 0 } = await session.send("Runtime.getHeapUsage");
  const card = await tab.evaluate(() => window.tspaceView.views.stage.viewport.resources);
  return { megabytes: (usedSize + embedderHeapUsedSize + backingStorageSize) / 2 ** 20, workers: tab.workers().length, ...card };
}

test("ten models are opened and closed, and their memory is freed", { skip: missing, timeout: 1_800_000 }, async (t) => {
  await withPage(async (tab) => {
    const session = await tab.context().newCDPSession(tab), model = gridGlb(20_000), after = [];
    for (let i = 0; i < kCycles; ++i) {
      await openBytes(tab, "grid.glb", model);
      const open = await held(tab, session);
      assert.ok(open.geometries > 0 && open.workers === 1);
      await tab.getByRole("button", { name: "Close the model" }).click();
      assert.equal(await tab.evaluate(() => document.documentElement.dataset.state), "closed");
      after.push(await held(tab, session));
      t.diagnostic(`${i + 1}: ${open.megabytes.toFixed(1)} MB open, ${after.at(-1).megabytes.toFixed(1)} MB closed; geometries ${open.geometries}, ${after.at(-1).geometries}; textures ${open.textures}, ${after.at(-1).textures}`);
    }
    const [first, last] = [after[1], after.at(-1)];
    assert.ok(last.megabytes < first.megabytes + 2, `${first.megabytes} MB after two, ${last.megabytes} MB after ten`);
    assert.deepEqual([last.geometries, last.textures, last.workers], [first.geometries, first.textures, 0], "the worker, and its memory, are gone");
    // The page still works.
    await openBytes(tab, "again.glb", gridGlb(500));
    assert.equal(await tab.locator(".model-name").textContent(), "again.glb");
  });
});

test("a model of 100 MB shows progress, can be stopped, is opened, and its memory is freed when it is closed", { skip: missing, timeout: 1_800_000 }, async (t) => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-large-")), path = join(folder, "large.glb");
  try {
    const bytes = gridGlb(300_000, 16);
    assert.ok(bytes.length > 100e6);
    writeFileSync(path, bytes);
    await withPage(async (tab) => {
      const session = await tab.context().newCDPSession(tab), before = await held(tab, session);
      const choose = async () => {
        await tab.evaluate(() => {
          document.documentElement.dataset.state = "asked";
          window.said = [];
          const bar = document.querySelector(".progress progress"), text = document.querySelector(".progress [role=status]");
          new MutationObserver(() => window.said.push([text.textContent, bar.value])).observe(text, { childList: true, characterData: true, subtree: true });
        });
        await tab.locator(".picker input").first().setInputFiles(path);
      };
      await choose();
      const stop = tab.locator(".progress .stop");
      await stop.waitFor();
      await tab.locator(".progress", { hasText: "Drawing" }).waitFor();
      const asked = Date.now();
      await stop.click();
      assert.equal(await settled(tab), "stopped");
      t.diagnostic(`stopped within ${Date.now() - asked} ms`);
      assert.match(await tab.locator(".progress").textContent(), /Stopped/);
      await choose();
      const started = Date.now();
      assert.equal(await settled(tab, 900_000), "ready");
      t.diagnostic(`${(bytes.length / 1e6).toFixed(0)} MB are judged after ${((Date.now() - started) / 1000).toFixed(1)} s`);
      const said = await tab.evaluate(() => window.said), names = new Set(said.map(([text]) => text)), values = said.map(([, value]) => value);
      for (const step of ["Reading the file", "Drawing", "Checking"]) assert.ok(names.has(step), `${step}: ${[...names]}`);
      assert.ok(new Set(values).size >= 4, `${values}`);
      assert.equal(await tab.evaluate(() => document.documentElement.dataset.picture), "drawn");
      assert.match(await tab.locator(".looked").textContent(), /1 with tangents/);
      const open = await held(tab, session);
      await tab.getByRole("button", { name: "Close the model" }).click();
      const closed = await held(tab, session);
      t.diagnostic(`${before.megabytes.toFixed(1)} MB before, ${open.megabytes.toFixed(1)} MB open, ${closed.megabytes.toFixed(1)} MB closed`);
      assert.ok(open.megabytes > before.megabytes + 100 && closed.megabytes < before.megabytes + 5, "its memory is freed");
      assert.deepEqual([closed.geometries, closed.workers], [0, 0]);
    });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
