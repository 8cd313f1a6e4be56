// SPDX-License-Identifier: MIT
// Corrupt and hostile files produce findings or an error message, and never a hang, an exception or a blank page.
import assert from "node:assert/strict";
import { join, relative } from "node:path";
import { test } from "node:test";
import { filesBelow, isLong, named, noShared, openFile, shared, withPage } from "./support.mjs";

test("every corrupt file gives findings or an error message", { skip: noShared, timeout: 1_200_000 }, async () => {
  const all = filesBelow(join(shared, "bad"), /\.(glb|gltf|obj)$/i);
  assert.ok(all.length > 300);
  const files = all.filter((_, i) => isLong || i % 6 === 0);
  await withPage(async (tab) => {
    let refused = 0;
    for (const path of files) {
      const state = await openFile(tab, path, { others: named(path) }).catch((error) => assert.fail(`${relative(shared, path)}: ${error.message}`));
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
    assert.ok(refused > files.length / 10, `${refused} of ${files.length} refused`);
  }, { allowMessages: true });
});
