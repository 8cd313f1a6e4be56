// SPDX-License-Identifier: MIT
// Interaction with the picture: split line, frame, pointer, and the meaning of its colors.
import assert from "node:assert/strict";
import { test } from "node:test";
import { join } from "node:path";
import { choose, drawn, farApart, missing, noShared, openFile, openSample, pixelsOf, settled, shared, shareOf, shares, shoot, withPage } from "./support.mjs";

const red = [214, 32, 60];
const aboveLegend = { left: 0, top: 0, right: 1, bottom: 0.88 };
const settings = (tab) => tab.evaluate(() => ({ ...window.tspaceView.views.stage.viewport.settings }));

test("the line between both sides is dragged, and a held key shows the right side alone", { skip: missing }, async () => {
  await withPage(async (tab) => {
    const box = await tab.locator(".frame").boundingBox();
    await tab.mouse.move(box.x + box.width * (await settings(tab)).split, box.y + 40);
    await tab.mouse.down();
    await tab.mouse.move(box.x + box.width * 0.25, box.y + 60, { steps: 4 });
    await tab.mouse.up();
    assert.ok(Math.abs((await settings(tab)).split - 0.25) < 0.01, "the line is where the mouse left it");
    assert.equal(Math.round(Number(await tab.locator(".split").inputValue()) / 10), 25);
    await tab.keyboard.down("b");
    assert.equal((await settings(tab)).split, 0);
    await tab.keyboard.up("b");
    assert.ok(Math.abs((await settings(tab)).split - 0.25) < 0.01);
  });
});

/** Drags with the mouse or with a finger. */
async function drag(tab, isTouch, from, to) {
  if (!isTouch) {
    await tab.mouse.move(from.x, from.y);
    await tab.mouse.down();
    await tab.mouse.move(to.x, to.y, { steps: 4 });
    return tab.mouse.up();
  }
  const session = await tab.context().newCDPSession(tab), send = (type, touchPoints) => session.send("Input.dispatchTouchEvent", { type, touchPoints });
  await send("touchStart", [from]);
  for (const t of [0.25, 0.5, 0.75, 1]) await send("touchMove", [{ x: from.x + t * (to.x - from.x), y: from.y + t * (to.y - from.y) }]);
  await send("touchEnd", []);
  await session.detach();
}

for (const [width, height] of [[390, 844], [820, 1180]]) {
  test(`at ${width} pixels line, model and light follow mouse and finger, and the colors change at the line`, { skip: missing }, async () => {
    await withPage(async (tab) => {
      await choose(tab, "Signs");
      const box = await tab.evaluate(() => document.querySelector(".frame").getBoundingClientRect().toJSON());
      const at = (x, y) => ({ x: box.left + x * box.width, y: box.top + y * box.height });
      const eye = () => tab.evaluate(() => window.tspaceView.views.stage.viewport.camera.position.toArray());
      const near = (a, b, part) => Math.hypot(...a.map((x, k) => x - b[k])) < part * Math.hypot(...b);
      const start = await eye();
      let share = (await settings(tab)).split; // initially, the split line is at the fault
      for (const isTouch of [false, true]) {
        // A touch next to the handle still moves the line, not the model.
        for (const next of [0.7, 0.35]) {
          const off = isTouch ? 14 / box.width : 0;
          await drag(tab, isTouch, at(share + off, isTouch ? 0.62 : 0.4), at(next, 0.6));
          assert.ok(Math.abs((await settings(tab)).split - next) < 0.01, `${isTouch ? "finger" : "mouse"}: ${(await settings(tab)).split}, not ${next}`);
          share = next;
          assert.ok(near(await eye(), start, 1e-6), "the model stays");
          const line = await tab.locator(".split-line").boundingBox();
          assert.ok(Math.abs(line.x + line.width / 2 - at(share, 0).x) < 1, "the line is drawn where the colors change");
          // Left of the line, the crate's wrong signs are striped red; right of it there are none.
          const left = await shares(tab, { red }, { left: 0, top: 0.1, right: share - 0.01, bottom: 0.85 }), right = await shares(tab, { red }, { left: share + 0.01, top: 0.1, right: 1, bottom: 0.85 });
          assert.ok(left.red > 0.005 && right.red < 0.001, `${left.red} left of ${share}, ${right.red} right of it`);
        }
        await drag(tab, isTouch, at(0.6, 0.5), at(0.75, 0.4));
        const turned = await eye();
        assert.ok(!near(turned, start, 0.05), "beside the line the model turns");
        await tab.locator(".frame canvas").focus();
        await tab.keyboard.press("0");
        await tab.waitForFunction((start) => window.tspaceView.views.stage.viewport.camera.position.toArray().every((x, k) => Math.abs(x - start[k]) < 1e-6), start);
        const light = await tab.locator(".light").boundingBox(), text = () => tab.locator(".light").getAttribute("aria-valuetext"), before = await text();
        const inLight = (x, y) => ({ x: light.x + x * light.width, y: light.y + y * light.height });
        await drag(tab, isTouch, inLight(0.5, 0.5), isTouch ? inLight(0.2, 0.3) : inLight(0.8, 0.7));
        assert.notEqual(await text(), before, "the light moves");
      }
      assert.equal(await tab.evaluate(() => scrollY), 0, "the page does not scroll under the finger");
    }, { width, height, hasTouch: true });
  });
}

test("the difference of lighting is 0 for equal frames, and 180 degrees for lost signs", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await choose(tab, "Difference");
    let seen = await shares(tab, { none: [41, 48, 89], some: [33, 120, 181], more: [237, 224, 64] }, aboveLegend);
    assert.ok(seen.none > 0.1 && seen.some + seen.more > 0.005, JSON.stringify(seen));
    await shoot(tab, "difference");
    await openSample(tab, "crate.glb");
    seen = await shares(tab, { none: [41, 48, 89], some: [33, 120, 181], more: [237, 224, 64] }, aboveLegend);
    assert.ok(seen.none > 0.1 && seen.some + seen.more < 0.0005, JSON.stringify(seen));
  });
});

/** Returns the bounding box of all pixels that are not background, as fractions of the picture. */
const filled = async (tab) => {
  const { width, height, channels, data } = await pixelsOf(tab), ground = channels * (4 * width + 4);
  let left = width, right = 0, top = height, bottom = 0;
  for (let y = 3; y < height - 3; ++y) {
    for (let x = 3; x < width - 3; ++x) { // pixels at the border may be blended with the page around the picture
      if (farApart(data, channels * (y * width + x), data, ground) < 12) continue;
      left = Math.min(left, x), right = Math.max(right, x), top = Math.min(top, y), bottom = Math.max(bottom, y);
    }
  }
  return { width: (right - left + 1) / width, height: (bottom - top + 1) / height };
};

for (const [width, height] of [[390, 844], [820, 1180], [1280, 800]]) {
  test(`at ${width} pixels a model fills 85 % of the picture, without distortion, and the pointer selects the triangle under it`, { skip: missing }, async () => {
    await withPage(async (tab) => {
      for (const name of ["crate-signs-lost.glb", "ring-directx.glb"]) {
        await openSample(tab, name);
        await drawn(tab);
        const { width: across, height: high } = await filled(tab);
        const canvas = await tab.locator(".frame canvas").boundingBox(), frame = await tab.locator(".frame").boundingBox();
        const most = Math.max(across * frame.width / canvas.width, high * frame.height / canvas.height);
        assert.ok(most > 0.82 && most < 0.88, `${name}: ${across} x ${high}`);
        const aspects = await tab.evaluate(() => {
          const { canvas, camera } = window.tspaceView.views.stage.viewport, { width, height } = canvas.getBoundingClientRect();
          return [canvas.width / canvas.height, camera.aspect, width / height];
        });
        assert.ok(aspects.every((one) => Math.abs(one / aspects[2] - 1) < 0.01), aspects.join());
        // Triangles that face the camera, each at the center of its projection.
        const places = await tab.evaluate(() => {
          const { scene, camera, canvas } = window.tspaceView.views.stage.viewport, [drawn] = scene.drawn, { left, top, width, height } = canvas.getBoundingClientRect();
          const p = drawn.corners.positions, found = [], v = camera.position.clone();
          for (let t = 0; t < p.length / 9 && found.length < 200; t += 7) {
            const middle = v.clone().fromArray([0, 1, 2].map((k) => (p[9 * t + k] + p[9 * t + 3 + k] + p[9 * t + 6 + k]) / 3)).applyMatrix4(drawn.part.places[0]).project(camera);
            found.push({ triangle: t, x: left + (middle.x + 1) * width / 2, y: top + (1 - middle.y) * height / 2 });
          }
          return found;
        });
        const hits = await tab.evaluate(async (places) => {
          const { viewport } = window.tspaceView.views.stage, { left, top } = viewport.canvas.getBoundingClientRect();
          const found = [];
          for (const { x, y, triangle } of places) found.push([await viewport.pick(x - left, y - top), triangle]);
          return found;
        }, places);
        const right = hits.filter(([hit, wanted]) => hit === wanted).length;
        // Triangles on the far side are hidden.
        assert.ok(right > 0.25 * hits.length, `${name}: ${right} of ${hits.length}`);
      }
    }, { width, height });
  });
}

test("surfaces follow their materials: vertex colors, reflections, unlit materials, and bones", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    const open = (name) => openFile(tab, join(shared, "models/khronos", name));
    await open("BoxVertexColors.glb");
    const image = await pixelsOf(tab), { data } = image;
    const share = shareOf(image, (i) => Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 60);
    assert.ok(share > 0.2, `vertices have colors: ${share}`);
    await open("CesiumMan.glb");
    const sizes = await tab.evaluate(() => {
      const [drawn] = window.tspaceView.views.stage.viewport.scene.drawn, p = drawn.corners.positions, rest = drawn.part.arrays;
      const extent = (data, at) => [0, 1, 2].map((k) => {
        let low = Infinity, high = -Infinity;
        for (let i = 0; i < at.length; ++i) low = Math.min(low, data[3 * at[i] + k]), high = Math.max(high, data[3 * at[i] + k]);
        return high - low;
      });
      return { posed: extent(p, Array.from({ length: p.length / 3 }, (_, i) => i)), rest: extent(rest.positions, [...rest.indices]) };
    });
    // The figure is upright (y), although the file's positions extend along z.
    assert.ok(sizes.posed[1] > 1.4 && sizes.posed[2] < 1.3 && sizes.rest[2] > 1.4, JSON.stringify(sizes));
    await shoot(tab, "surface-skin");
    await open("ClearCoatTest.glb");
    await shoot(tab, "surface-clearcoat");
  }, { allowMessages: true });
});

test("the environment is reflected, and shadows only darken", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    await openFile(tab, join(shared, "models/khronos/Lantern.glb"));
    await tab.locator(".split").fill("1000");
    const seen = new Map();
    for (const name of ["room", "studio", "sky", "sunset"]) {
      await choose(tab, name, ".look");
      const image = await pixelsOf(tab);
      for (const [other, before] of seen) assert.ok(shareOf(image, (i) => farApart(image.data, i, before.data, i) > 6) > 0.03, `${name} is not ${other}`);
      seen.set(name, image);
    }
    await choose(tab, "room", ".look");
    const room = seen.get("room"), again = await pixelsOf(tab);
    assert.equal(shareOf(room, (i) => farApart(room.data, i, again.data, i) > 1), 0, "and back again");
    await tab.getByLabel("Shadows").check();
    const shaded = await pixelsOf(tab), light = ({ data }, i) => data[i] + data[i + 1] + data[i + 2];
    assert.ok(shareOf(shaded, (i) => light(shaded, i) < light(room, i) - 12) > 0.002, "the roof keeps the lamp off what is below it");
    assert.ok(shareOf(shaded, (i) => light(shaded, i) > light(room, i) + 6) < 0.0005);
    await shoot(tab, "shadows");
  }, { allowMessages: true, width: 1000, height: 700 });
});

test("animations move bones, nodes and weights, and return to the start", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    for (const [name, isSkin] of [["Fox.glb", true], ["AnimatedMorphCube.glb", false]]) {
      await openFile(tab, join(shared, "models/khronos", name));
      await tab.locator(".motion").evaluate((panel) => (panel.open = true));
      const places = () => tab.evaluate(() => [...window.tspaceView.views.stage.viewport.scene.drawn[0].corners.positions.slice(0, 3000)]);
      const tangentsAreUnit = () => tab.evaluate(() => window.tspaceView.views.stage.viewport.scene.drawn.every(({ frames }) => !frames || Array.from({ length: frames.tangents.length / 4 }, (_, i) => Math.hypot(...frames.tangents.subarray(4 * i, 4 * i + 3))).every((length) => Math.abs(length - 1) < 1e-3)));
      const rest = await places();
      await tab.locator(".motion select").first().selectOption("0");
      await tab.locator(".motion input[aria-label='Time of the animation']").fill("0.4");
      await drawn(tab);
      const moved = await places();
      const far = Math.max(...rest.map((x, i) => Math.abs(x - moved[i])));
      assert.ok(far > 0.001, `${name}: ${far}`);
      if (isSkin) assert.ok(await tangentsAreUnit());
      await shoot(tab, `motion-${name}`);
      await tab.locator(".motion select").first().selectOption("");
      assert.deepEqual(await places(), rest, name);
    }
    await openFile(tab, join(shared, "models/khronos/SimpleMorph.gltf"), {});
    await openSample(tab, "crate.glb");
    assert.equal(await tab.locator(".motion").isVisible(), false, "a crate does not move");
  }, { allowMessages: true });
});
