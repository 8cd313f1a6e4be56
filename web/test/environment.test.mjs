// SPDX-License-Identifier: MIT
// Environments: each looks as its name says, rotates, and is exposed; panoramas of the user replace them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ball, glbOfMesh } from "./shapes.mjs";
import { choose, drawn, missing, openBytes, shoot, withPage } from "./support.mjs";

const small = { width: 1000, height: 700 };

/** Opens a mirror ball, viewed horizontally along -z, with the light from behind it, which adds no highlight. */
async function showBall(tab) {
  await openBytes(tab, "ball.glb", glbOfMesh(ball(), { material: { pbrMetallicRoughness: { metallicFactor: 1, roughnessFactor: 0 } } }));
  await tab.evaluate(() => {
    const { stage } = window.tspaceView.views;
    stage.setSplit(1);
    stage.viewport.lookFrom([0, 0, 4, 0, 0, 0]);
    stage.viewport.light.set(0, 0, -1);
  });
  await drawn(tab);
}

/** Returns the mean color (0 to 1) of small areas of the ball. Its middle reflects +z, its sides the sides, its top what is above. */
async function seen(tab) {
  await drawn(tab);
  return tab.evaluate(() => {
    const { viewport } = window.tspaceView.views.stage, copy = viewport.draw(), { width, height } = copy, context = copy.getContext("2d");
    const { data } = context.getImageData(0, 0, width, height);
    let left = width, right = 0, top = height, bottom = 0;
    for (let i = 3; i < data.length; i += 4) {
      if (data[i] === 0) continue;
      const x = ((i - 3) / 4) % width, y = Math.floor((i - 3) / 4 / width);
      left = Math.min(left, x), right = Math.max(right, x), top = Math.min(top, y), bottom = Math.max(bottom, y);
    }
    const mean = (x0, x1, y0, y1) => {
      const sum = [0, 0, 0];
      let count = 0;
      for (let y = Math.round(top + y0 * (bottom - top)); y < top + y1 * (bottom - top); ++y) {
        for (let x = Math.round(left + x0 * (right - left)); x < left + x1 * (right - left); ++x) {
          const i = 4 * (y * width + x);
          if (data[i + 3] < 255) continue;
          for (let k = 0; k < 3; ++k) sum[k] += data[i + k] / 255;
          count += 1;
        }
      }
      return sum.map((x) => x / count);
    };
    // At 0.15 of the diameter from an edge the ball reflects what is perpendicular to the view.
    return { all: mean(0, 1, 0, 1), above: mean(0.42, 0.58, 0.1, 0.18), below: mean(0.42, 0.58, 0.82, 0.9), left: mean(0.1, 0.18, 0.46, 0.54), right: mean(0.82, 0.9, 0.46, 0.54), middle: mean(0.44, 0.56, 0.44, 0.56) };
  });
}

const light = ([r, g, b]) => (r + g + b) / 3;

/** Sets a slider of the panel Look. */
const slide = (tab, name, value) => tab.locator(".look").getByLabel(name).fill(String(value));

test("environments have the colors of their names", { skip: missing }, async (t) => {
  await withPage(async (tab) => {
    await showBall(tab);
    const found = {};
    for (const name of ["room", "studio", "sky", "sunset"]) {
      await choose(tab, name, ".look");
      found[name] = await seen(tab);
      t.diagnostic(`${name}: ${Object.entries(found[name]).map(([place, color]) => `${place} ${color.map((x) => x.toFixed(2)).join(" ")}`).join(", ")}`);
      await shoot(tab, `environment-${name}`);
    }
    const { room, studio, sky, sunset } = found;
    for (const color of [room.all, studio.all]) assert.ok(Math.max(...color) - Math.min(...color) < 0.05, `a room and a studio are gray: ${color}`);
    assert.ok(light(studio.middle) < 0.6 * light(room.middle), "the walls of a studio are dark");
    assert.ok(light(studio.left) > 2 * light(studio.middle) && light(studio.right) > 2 * light(studio.middle), "and lamps stand at its sides");
    assert.ok(sky.above[2] > 1.3 * sky.above[0] && sky.below[0] >= sky.below[2], "the sky is blue, and the ground is not");
    assert.ok(light(sky.above) > light(sky.below), "the sky is lighter than the ground");
    assert.ok(sunset.left[0] > 1.4 * sunset.left[2], "the sun of a sunset is orange");
    assert.ok(sunset.above[2] > sunset.above[0] && light(sunset.above) < light(sky.above), "below a dark blue sky");
  }, small);
});

/** Returns a panorama as an HDR file (Radiance, without run-length encoding). color(x, y) returns 8-bit red, green and blue, 128 being 1. */
function panorama(width, height, color) {
  const texels = Array.from({ length: width * height }, (_, i) => [...color(i % width, Math.floor(i / width)), 129]).flat();
  return Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`), Buffer.from(texels)]);
}

const give = (tab, name, buffer) => tab.getByLabel("Panorama as an HDR file").setInputFiles({ name, mimeType: "image/vnd.radiance", buffer });
const said = (tab, text) => tab.locator(".look [role=status]", { hasText: text }).waitFor();

test("a panorama of the user is reflected, rotates and is exposed, and a built-in environment replaces it", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await showBall(tab);
    const room = await seen(tab);
    // The middle of a panorama is at +x: the right half of its width lies at +z. The ball's left side reflects -x.
    const sides = panorama(64, 32, (x, y) => (y < 8 ? [20, 20, 100] : x >= 16 && x < 48 ? [100, 20, 20] : [20, 100, 20]));
    await give(tab, "sides.hdr", sides);
    await said(tab, /^Shown: sides\.hdr$/);
    const first = await seen(tab);
    assert.ok(first.above[2] > 1.5 * first.above[0], `blue above: ${first.above}`);
    assert.ok(first.right[0] > 1.5 * first.right[1] && first.left[1] > 1.5 * first.left[0], `red at +x, green at -x: ${first.right} and ${first.left}`);
    await shoot(tab, "environment-panorama");
    await slide(tab, "Rotation", 180);
    const turned = await seen(tab);
    assert.ok(turned.left[0] > 1.5 * turned.left[1] && turned.right[1] > 1.5 * turned.right[0], `a half turn swaps the sides: ${turned.left} and ${turned.right}`);
    assert.ok(turned.above[2] > 1.5 * turned.above[0], "but not above and below");
    await slide(tab, "Rotation", 0);
    assert.deepEqual(await seen(tab), first);
    await slide(tab, "Exposure", 1);
    const bright = await seen(tab);
    await slide(tab, "Exposure", -1);
    const dark = await seen(tab);
    assert.ok(light(bright.all) > 1.15 * light(first.all) && light(dark.all) < 0.85 * light(first.all), `${light(dark.all)}, ${light(first.all)}, ${light(bright.all)}`);
    await slide(tab, "Exposure", 0);
    await choose(tab, "room", ".look");
    assert.deepEqual(await seen(tab), room, "the room is shown again");
    assert.equal(await tab.locator(".look [role=status]").last().textContent(), "");
  }, small);
});

test("a damaged panorama is rejected, and the environment stays", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await showBall(tab);
    const before = await seen(tab), whole = panorama(64, 32, () => [100, 50, 20]);
    const files = { "short.hdr": whole.subarray(0, 3000), "head.hdr": whole.subarray(0, 20), "text.hdr": Buffer.from("#?RADIANCE\nno panorama\n") };
    for (const [name, bytes] of Object.entries(files)) {
      await give(tab, name, bytes);
      await said(tab, new RegExp(`^${name} cannot be read: `));
      assert.deepEqual(await seen(tab), before, name);
    }
    await give(tab, "picture.hdr", Buffer.from("GIF89a"));
    await said(tab, "picture.hdr is not an HDR panorama (Radiance).");
  }, small);
});
