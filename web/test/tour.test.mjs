// SPDX-License-Identifier: MIT
// A tour with the keyboard alone, and what a screen reader announces on it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { missing, settled, withPage } from "./support.mjs";

/** Returns whether an element that matches a selector has the focus. */
const isOn = (tab, selector) => tab.evaluate((selector) => document.activeElement.matches(selector), selector);

/** Presses Tab (or Shift+Tab) until an element has the focus; returns the number of presses. */
async function tabTo(tab, selector, key = "Tab") {
  for (let i = 0; i < 80; ++i) {
    if (await isOn(tab, selector)) return i;
    await tab.keyboard.press(key);
  }
  throw new Error(`${selector} is not reached by ${key}`);
}

/** Records the texts of live regions when they change. */
const listen = (tab) => tab.evaluate(() => {
  window.heard = [];
  new MutationObserver((changes) => {
    for (const { target } of changes) {
      const region = (target.nodeType === 1 ? target : target.parentElement)?.closest("[role=status], [role=alert], [aria-live]"), text = region?.checkVisibility() ? region.textContent.trim() : "";
      if (text !== "" && window.heard.at(-1) !== text) window.heard.push(text);
    }
  }).observe(document.body, { childList: true, characterData: true, subtree: true });
});
const heard = async (tab, pattern) => assert.ok((await tab.evaluate(() => window.heard)).some((text) => pattern.test(text)), `${pattern} in ${JSON.stringify(await tab.evaluate(() => window.heard))}`);

for (const [width, height] of [[1280, 800], [390, 844]]) {
  test(`at ${width} pixels, a model is opened, examined, fixed, downloaded and closed by keyboard, and the focus is never lost`, { skip: missing }, async () => {
    await withPage(async (tab) => {
      await listen(tab);
      await tabTo(tab, '.sample[data-file="ring-directx.glb"]');
      await tab.keyboard.press("Enter");
      await tab.waitForFunction(() => document.querySelector(".model-name").textContent === "ring-directx.glb");
      assert.equal(await settled(tab), "ready");
      assert.ok(await isOn(tab, '.sample[aria-pressed="true"]'));
      await heard(tab, /^Bumps look like dents/);
      await tabTo(tab, ".finding");
      await tab.keyboard.press("Enter");
      assert.ok(await isOn(tab, '.finding[aria-expanded="true"]'));
      await tabTo(tab, "[type=radio]:checked");
      await tab.keyboard.press("ArrowRight");
      assert.notEqual(await tab.evaluate(() => window.tspaceView.views.stage.viewport.settings.look), "lit", "arrows select a look");
      await tabTo(tab, ".fix button.large");
      await tab.keyboard.press("Enter");
      await tab.waitForSelector(".fix a.large");
      assert.ok(await isOn(tab, ".fix .large"), "the focus is on what replaces the button");
      await heard(tab, /^Fixed/);
      await tabTo(tab, ".fix a.large");
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.keyboard.press("Enter")]);
      assert.equal(download.suggestedFilename(), "ring-directx-fixed.glb");
      await tabTo(tab, ".close", "Shift+Tab");
      await tab.keyboard.press("Enter");
      await tab.waitForSelector("html[data-state=closed]", { state: "attached" });
      assert.ok(await isOn(tab, ".open button"), "the focus is on the button that opens the next model");
    }, { width, height });
  });
}

test("a screen reader finds landmarks, headings and the names of all controls", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await tab.evaluate(() => document.querySelectorAll("details").forEach((details) => (details.open = true)));
    const tree = await tab.locator("body").ariaSnapshot();
    for (const part of [/^- banner:/m, /^- main:/m, /^- contentinfo:/m, /navigation "Samples"/, /region "Findings"/, /region "Picture"/, /complementary "Inspector"/, /heading "Drop a model.*" \[level=1\]/, /heading "What is wrong" \[level=2\]/,
      /img "The model\. Arrow keys rotate it/, /slider "Position of the split line/, /slider "Light"/, /button "Fix it.*Your file is not changed/, /button "Bumps look like dents/, /group "Look"/, /radio "Lit" \[checked\]/, /slider "Exposure/, /slider "Rotation/]) assert.match(tree, part);
    // No control without a name: its line ends after the role.
    assert.deepEqual(tree.split("\n").filter((line) => /^\s*- (button|link|slider|checkbox|radio|textbox|searchbox|combobox|img)\s*(\[[^\]]*\]\s*)*:?\s*$/.test(line)), []);
  });
});
