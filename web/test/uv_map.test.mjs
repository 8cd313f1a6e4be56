// SPDX-License-Identifier: MIT
// The UV map: linked with the model in both directions, zoomed, and for each UV set of the file.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { drawn, missing, noShared, openFile, openSample, shared, shoot, withPage } from "./support.mjs";

const marked = (tab, where) => tab.locator(where).first().getAttribute("data-marked");
const inModel = (tab) => marked(tab, ".frame canvas");
const inMap = (tab) => marked(tab, ".map canvas");
/** Opens the map, large or in the inspector. */
async function openMap(tab, isLarge) {
  await tab.locator(".uv summary").click();
  if (isLarge) await tab.getByRole("button", { name: "Show large" }).click();
  await drawn(tab);
}
/** Returns the screen position of a UV, computed from the window that the map reports. */
const windowOf = (tab) => tab.evaluate(() => {
  const { left, top, width, height } = document.querySelector(".map canvas").getBoundingClientRect();
  return { left, top, width, height, area: window.tspaceView.views.uvMap.area };
});
async function placeOf(tab, [u, v]) {
  const { left, top, width, height, area: [su, sv, ou, ov] } = await windowOf(tab);
  return { x: left + (u * su + ou) * width, y: top + (v * sv + ov) * height };
}
/** Returns the UVs of the center of a triangle of the first part. */
const middleOf = (tab, triangle) => tab.evaluate((t) => {
  const { uvs } = window.tspaceView.views.stage.viewport.scene.drawn[0].corners;
  return [0, 1].map((k) => (uvs[6 * t + k] + uvs[6 * t + 2 + k] + uvs[6 * t + 4 + k]) / 3);
}, triangle);

for (const [width, height, scheme] of [[1280, 800, "light"], [390, 844, "light"], [820, 1180, "dark"], [1920, 1080, "dark"]]) {
  test(`at ${width} pixels the position under the pointer in the model is shown in the map, and vice versa`, { skip: missing }, async () => {
    await withPage(async (tab) => {
      await openMap(tab, true);
      await tab.locator(".frame canvas").scrollIntoViewIfNeeded();
      const box = await tab.locator(".frame canvas").boundingBox();
      await tab.mouse.move(box.x + box.width * 0.42, box.y + box.height * 0.5);
      await tab.waitForFunction(() => document.querySelector(".frame canvas").dataset.marked);
      const triangle = await inModel(tab);
      assert.match(triangle, /^\d+$/);
      assert.equal(await inMap(tab), triangle);
      assert.match(await tab.locator(".texel dl").textContent(), new RegExp(`Triangle${triangle} `));
      await shoot(tab, `uv-large-${width}-${scheme}`);
      await tab.locator(".map canvas").first().scrollIntoViewIfNeeded();
      const place = await placeOf(tab, await middleOf(tab, Number(triangle)));
      await tab.mouse.move(place.x, place.y);
      assert.ok((await inModel(tab)).split(" ").includes(triangle), `${triangle} among ${await inModel(tab)}`);
      assert.equal(await inModel(tab), await inMap(tab));
      assert.match(await tab.locator(".large-map [role=status]").textContent(), /^UV 0\.\d{4} {2}0\.\d{4}: .*triangle/);
      // The visible part is the outlined one: its center has the color of the outline.
      const eye = () => tab.evaluate(() => window.tspaceView.views.stage.viewport.camera.position.toArray());
      const before = await eye();
      await tab.mouse.click(place.x, place.y);
      await drawn(tab);
      assert.notDeepEqual(await eye(), before, "a click flies to the triangle");
      await shoot(tab, `uv-flown-${width}-${scheme}`);
      assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    }, { width, height, scheme });
  });
}

test("the map is zoomed about the pointer, moved, and shown whole again, by mouse and by keys", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await openMap(tab, true);
    // Whole pixels, like mouse positions.
    const start = (await windowOf(tab)).area, box = await windowOf(tab), place = { x: Math.round(box.left + 0.4 * box.width), y: Math.round(box.top + 0.3 * box.height) };
    const uv = [((place.x - box.left) / box.width - start[2]) / start[0], ((place.y - box.top) / box.height - start[3]) / start[1]];
    await tab.mouse.move(place.x, place.y);
    for (let i = 0; i < 8; ++i) await tab.mouse.wheel(0, -200);
    await drawn(tab);
    const near = (await windowOf(tab)).area, there = await placeOf(tab, uv);
    assert.ok(near[0] > 20 * start[0], `${near[0]} and ${start[0]}`);
    assert.ok(Math.hypot(there.x - place.x, there.y - place.y) < 1, "what is under the pointer stays there");
    await shoot(tab, "uv-zoomed");
    await tab.mouse.down();
    await tab.mouse.move(place.x + 60, place.y + 30, { steps: 4 });
    await tab.mouse.up();
    const moved = await placeOf(tab, uv);
    assert.ok(Math.hypot(moved.x - place.x - 60, moved.y - place.y - 30) < 1, JSON.stringify([moved, place]));
    await tab.getByRole("button", { name: "Show all" }).click();
    await drawn(tab);
    const close = (a, b) => a.every((x, i) => Math.abs(x - b[i]) < 1e-6);
    assert.ok(close((await windowOf(tab)).area, start));
    await tab.locator(".map canvas").first().focus();
    for (const key of ["+", "+", "ArrowLeft"]) await tab.keyboard.press(key);
    await drawn(tab);
    assert.ok(!close((await windowOf(tab)).area, start));
    await tab.keyboard.press("0");
    await drawn(tab);
    assert.ok(close((await windowOf(tab)).area, start));
    await tab.getByRole("button", { name: "Back to the side panel" }).click();
    assert.equal(await tab.locator(".large-map").isVisible(), false);
    assert.equal(await tab.locator(".uv .map").isVisible(), true);
  });
});

test("overlapping triangles are all found, and each click shows the next one", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    await openFile(tab, join(shared, "models/khronos/BoomBoxWithAxes.glb"));
    await openMap(tab, true);
    // A UV that several triangles of the shown part cover, on mirrored halves.
    const overlap = await tab.evaluate(() => {
      const { uvs } = window.tspaceView.views.stage.viewport.scene.drawn[0].corners;
      const inside = (i, u, v) => {
        const d = (a, b) => (uvs[i + a] - u) * (uvs[i + b + 1] - v) - (uvs[i + a + 1] - v) * (uvs[i + b] - u);
        const s = [d(0, 2), d(2, 4), d(4, 0)];
        return s.every((x) => x > 1e-9) || s.every((x) => x < -1e-9);
      };
      for (let t = 0; t < uvs.length / 6; t += 5) {
        const u = (uvs[6 * t] + uvs[6 * t + 2] + uvs[6 * t + 4]) / 3, v = (uvs[6 * t + 1] + uvs[6 * t + 3] + uvs[6 * t + 5]) / 3;
        let count = 0;
        for (let i = 0; i < uvs.length; i += 6) count += inside(i, u, v);
        if (count > 1) return { uv: [u, v], count };
      }
      return null;
    });
    if (!overlap) return; // the islands of this model do not overlap
    for (let i = 0; i < 3; ++i) await tab.locator(".map canvas").first().press("0");
    const { x, y } = await placeOf(tab, overlap.uv);
    await tab.mouse.move(x, y);
    const found = (await inMap(tab)).split(" ");
    assert.ok(found.length >= 2, found.join());
    const eye = () => tab.evaluate(() => window.tspaceView.views.stage.viewport.camera.position.toArray().map((x) => x.toFixed(6)).join());
    const seen = new Set();
    for (let i = 0; i < found.length; ++i) {
      await tab.mouse.click(x, y);
      await drawn(tab);
      seen.add(await eye());
    }
    assert.ok(seen.size >= 2, "another place each time");
  }, { allowMessages: true });
});

test("each UV set of a file can be chosen, with its users and islands", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    const folder = join(shared, "models/khronos/MultiUVTest");
    const { readdirSync } = await import("node:fs");
    const names = readdirSync(folder), gltf = names.find((name) => /\.(gltf|glb)$/.test(name));
    const others = Object.fromEntries(names.filter((name) => name !== gltf).map((name) => [name, join(folder, name)]));
    assert.equal(await openFile(tab, join(folder, gltf), { others }), "ready");
    await openMap(tab, true);
    const sets = tab.locator(".large-map").getByLabel("UV set");
    const labels = await sets.locator("option").allTextContents();
    assert.equal(labels.length, 2);
    assert.match(labels.join("; "), /TEXCOORD_0, used by .*TEXCOORD_1, used by/);
    const pixels = () => tab.locator(".map canvas").first().screenshot();
    const first = await pixels();
    await sets.selectOption("1");
    await drawn(tab);
    await tab.waitForFunction(() => /island/.test(document.querySelector(".large-map [role=status]").textContent));
    assert.ok(!first.equals(await pixels()));
    assert.match(await tab.locator(".large-map").getByLabel("Background image").textContent(), /none/);
    await shoot(tab, "uv-second-set");
  }, { allowMessages: true });
});

test("marks are cleared for the next model", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await openMap(tab, true);
    const largest = await tab.evaluate(() => {
      const { uvs } = window.tspaceView.views.stage.viewport.scene.drawn[0].corners, size = (i) => Math.abs((uvs[i + 2] - uvs[i]) * (uvs[i + 5] - uvs[i + 1]) - (uvs[i + 4] - uvs[i]) * (uvs[i + 3] - uvs[i + 1]));
      let best = 0;
      for (let i = 0; i < uvs.length; i += 6) if (size(i) > size(best)) best = i;
      return best / 6;
    });
    const place = await placeOf(tab, await middleOf(tab, largest));
    await tab.mouse.move(place.x, place.y);
    assert.notEqual(await inModel(tab), "");
    await openSample(tab, "ring-directx.glb");
    assert.equal(await inModel(tab), "");
    assert.equal(await inMap(tab), "");
    await tab.waitForFunction(() => /island/.test(document.querySelector(".large-map [role=status]").textContent));
  });
});
