// SPDX-License-Identifier: MIT
// Compares the picture with plain three.js: the same model, environment, light and pose; and measures how many pixels a fault changes.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { loadavg } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { Glb } from "./glb.mjs";
import { difference, drawn, isLong, missing, named, noShared, openBytes, openFile, overGray, ownPicture, page, shared, withPage } from "./support.mjs";

const plain = process.env.TSPACE_PLAIN;
// Models with KTX2 textures use PNGs with the same content here, because plain three.js does not read KTX2.
const models = [
  "khronos/NormalTangentTest.glb", "khronos/BoomBoxWithAxes.glb", "khronos/Suzanne/Suzanne.gltf", "khronos/Fox.glb", "khronos/CesiumMan.glb", "khronos/ClearCoatTest.glb",
  "khronos/Lantern.glb", "khronos/SciFiHelmet.glb", "khronos/SheenCloth.glb", "khronos/SimpleInstancing.glb", "khronos/BoxVertexColors.glb", "khronos/TwoSidedPlane.glb",
  "khronos/AnisotropyStrengthTest.glb", "khronos/MorphStressTest.glb", "assets/Cat.glb", "assets/Ghost.glb", "assets/sofa_03/sofa_03_1k.gltf", "assets/tea_set_01/tea_set_01_1k.gltf",
  "assets/hp-mixed-reality-left.glb", "features/chr_knight.glb",
].map((name) => join(shared ?? "", "models", name));
const shown = models.filter((_, i) => isLong || i % 5 === 1);

test("models look like in three.js: mean difference of at most 3 of 255", { skip: noShared || (!plain && "the page of three.js alone is not built"), timeout: 3_600_000 }, async (t) => {
  const own = new Map();
  await withPage(async (tab) => {
    for (const path of shown) {
      assert.equal(await openFile(tab, path, { others: named(path) }), "ready", path);
      await drawn(tab);
      own.set(path, await ownPicture(tab));
    }
  }, { allowMessages: true });
  await withPage(async (tab) => {
    const means = [];
    for (const [path, { text, view }] of own) {
      const files = { ...named(path), [path.split("/").pop()]: path };
      const content = Object.fromEntries(Object.entries(files).map(([name, file]) => [name, readFileSync(file).toString("base64")]));
      const theirs = await tab.evaluate(([name, content, view]) => window.renderPlain(name, content, view), [path.split("/").pop(), content, view]);
      const { mean, count } = difference(overGray(text), overGray(theirs));
      t.diagnostic(`${path.split("/").pop()}: ${mean.toFixed(2)} of 255 over ${count} pixels`);
      assert.ok(count > 1000, path);
      assert.ok(mean <= 3, `${path}: ${mean}`);
      means.push(mean);
    }
    t.diagnostic(`mean over ${means.length} models ${(means.reduce((a, b) => a + b, 0) / means.length).toFixed(2)}, largest ${Math.max(...means).toFixed(2)}`);
  }, { url: pathToFileURL(plain).href, allowMessages: true });
});

test("on a cat with inverted signs a quarter of the pixels differ from the correct picture", { skip: noShared }, async (t) => {
  await withPage(async (tab) => {
    // The cat's normal map is for DirectX and its signs are inverted, which cancels out. With corrected signs alone,
    // the map is wrong.
    const glb = new Glb(readFileSync(join(shared, "models/assets/Cat.glb"))), seen = new Set();
    for (const { attributes } of glb.primitives("TANGENT")) {
      if (seen.has(attributes.TANGENT)) continue;
      seen.add(attributes.TANGENT);
      const numbers = glb.numbers(attributes.TANGENT);
      for (let i = 3; i < numbers.length; i += 4) numbers[i] = -numbers[i];
      const index = glb.addFloats(numbers, "VEC4");
      for (const primitive of glb.primitives("TANGENT")) if (primitive.attributes.TANGENT === attributes.TANGENT) primitive.attributes.TANGENT = index;
      seen.add(index);
    }
    await openBytes(tab, "cat.glb", glb.finish());
    await drawn(tab);
    const picture = (share) => tab.evaluate(async (share) => {
      const { stage } = window.tspaceView.views;
      stage.setSplit(share);
      stage.viewport.draw();
      const copy = stage.viewport.draw(), { data } = copy.getContext("2d").getImageData(0, 0, copy.width, copy.height);
      return Array.from(data);
    }, share);
    const file = await picture(1), right = await picture(0);
    const steps = [1, 2, 3, 4, 6, 10, 20], counts = steps.map(() => 0);
    let covered = 0;
    for (let i = 0; i < file.length; i += 4) {
      if (file[i + 3] === 0) continue;
      covered += 1;
      const apart = Math.max(...[0, 1, 2].map((k) => Math.abs(file[i + k] - right[i + k])));
      for (const [k, step] of steps.entries()) counts[k] += apart > step;
    }
    const share = (k) => counts[k] / covered;
    t.diagnostic(`of ${covered} pixels ${steps.map((step, k) => `${(100 * share(k)).toFixed(1)} % differ by more than ${step}`).join(", ")} of 255`);
    assert.ok(share(steps.indexOf(4)) >= 0.25, "by more than 4 of 255");
  }, { allowMessages: true });
});

const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];

test("the first picture of the page appears at most four times as late as that of three.js alone", { skip: missing || (!plain && "the page of three.js alone is not built"), timeout: 600_000 }, async (t) => {
  const urls = { page: pathToFileURL(page).href, plain: `${pathToFileURL(plain).href}#crate` }, times = { page: [], plain: [] };
  // A new browser for each, in turns.
  for (let i = 0; i < (isLong ? 11 : 5); ++i) {
    for (const [name, url] of Object.entries(urls)) {
      const ms = await withPage((tab) => tab.waitForFunction(() => performance.getEntriesByName("first picture")[0]?.startTime).then((mark) => mark.jsonValue()), { url, allowMessages: true });
      times[name].push(Math.round(ms));
    }
  }
  t.diagnostic(`page ${times.page.join(", ")} ms, three.js alone ${times.plain.join(", ")} ms; medians ${median(times.page)} and ${median(times.plain)} ms; load of the machine ${loadavg()[0].toFixed(1)}`);
  assert.ok(median(times.page) <= 4 * median(times.plain));
});
