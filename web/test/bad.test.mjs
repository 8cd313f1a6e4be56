// SPDX-License-Identifier: MIT
// Broken and hostile files: a verdict or a sentence each, never a hang, an exception or a blank page.
import assert from "node:assert/strict";
import { join, relative } from "node:path";
import { test } from "node:test";
import { filesBelow, named, noShared, openFile, shared, withPage } from "./support.mjs";

test("every broken file ends in findings or a sentence", { skip: noShared, timeout: 600_000 }, async () => {
  const files = filesBelow(join(shared, "bad"), /\.(glb|gltf|obj)$/i);
  assert.ok(files.length > 300);
  await withPage(async (tab) => {
    let refused = 0;
    for (const path of files) {
      const state = await openFile(tab, path, { others: named(path), timeout: 30_000 }).catch((error) => assert.fail(`${relative(shared, path)}: ${error.message}`));
      const text = (await tab.locator(".findings .list").textContent()).trim();
      if (state === "failed") {
        refused += 1;
        assert.match(await tab.locator(".findings .failure").textContent(), /\w+ .*\w/, path);
      } else {
        assert.equal(state, "ready", path);
        assert.match(text, /\d+ errors?/, path);
        const picture = await tab.evaluate(() => document.documentElement.dataset.picture);
        if (picture !== "drawn") assert.notEqual(await tab.locator(".remark").textContent(), "", path);
      }
      assert.ok(await tab.locator("h1").isVisible());
    }
    assert.ok(refused > 50, `${refused} refused`);
  }, { allowMessages: true });
});
