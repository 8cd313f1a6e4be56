// SPDX-License-Identifier: MIT
// The example examples/gpu_page in Chromium: at several times, the frames on the GPU are those of the module for the same pose, and
// screenshots show lit models, and a heat map with small errors on finely tessellated surfaces.
import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { it } from "node:test";
import { ready } from "tspace";
import { missing, runPage } from "./browser.mjs";
import { compare, expected, posed, prepared } from "./planned_poses.mjs";

const folder = process.env.TSPACE_EXAMPLES && join(process.env.TSPACE_EXAMPLES, "gpu_page");
const pngjs = await import("pngjs").catch(() => null);

const background = [0x23, 0x26, 0x2d];
/** Returns statistics of the pixels that are not background: their share, mean color, and mean difference of neighbors. */
function statisticsOf({ data, width }, { x, y, width: wide, height: high }) {
  const sum = [0, 0, 0];
  let covered = 0, steps = 0;
  for (let row = Math.round(y); row < Math.round(y + high) - 1; ++row) {
    for (let column = Math.round(x); column < Math.round(x + wide) - 1; ++column) {
      const at = 4 * (row * width + column), color = [...data.subarray(at, at + 3)];
      if (color.every((value, i) => Math.abs(value - background[i]) < 4)) continue;
      ++covered;
      color.forEach((value, i) => (sum[i] += value));
      steps += Math.abs(color[0] - data[at + 4]) + Math.abs(color[1] - data[at + 5]) + Math.abs(color[2] - data[at + 6]);
    }
  }
  return { share: covered / (wide * high), mean: sum.map((total) => Math.round(total / covered)), roughness: steps / covered };
}

/** Returns the values of `array`, which has `from` values per vertex, without the last ones of each vertex. */
const narrowed = (array, from, to) => Float32Array.from(array.filter((_, i) => i % from < to));

/** Returns the arrays of a pose that the page has read back, and those that the module computes for its positions. */
function poseOf({ mesh: { positions, uvs, indices, target }, ...read }, time) {
  const mesh = { positions: Float32Array.from(positions), uvs: Float32Array.from(uvs), indices: Uint32Array.from(indices), targets: target ? [Float32Array.from(target)] : [] };
  const made = prepared(mesh, { convention: "opengl" }), given = narrowed(read.positions, 4, 3);
  // The page morphs by this weight in the shader, so the buffer contains the positions without the morph target.
  const moved = target ? posed({ ...made.vertices, positions: given }, [Math.fround(0.5 - 0.5 * Math.cos(2 * time))]) : given;
  const wanted = expected(made, moved);
  made.plan.destroy();
  return { positions: moved, normals: narrowed(read.normals, 4, 3), tangents: Float32Array.from(read.tangents), wanted };
}

/** Fails unless all vectors are finite and of unit length, T is perpendicular to N, and w is a sign. */
function assertFrames({ normals, tangents }, name) {
  for (let v = 0; v < normals.length / 3; ++v) {
    const n = normals.subarray(3 * v, 3 * v + 3), t = tangents.subarray(4 * v, 4 * v + 3), w = tangents[4 * v + 3];
    const dot = n[0] * t[0] + n[1] * t[1] + n[2] * t[2];
    assert.ok(Math.abs(Math.hypot(...n) - 1) < 1e-5 && Math.abs(Math.hypot(...t) - 1) < 1e-5 && Math.abs(dot) < 1e-5 && Math.abs(w) === 1, `${name}, vertex ${v}: N ${n}, T ${t}, w ${w}`);
  }
}

const skip = missing || (!(folder && existsSync(folder)) && "no examples here") || (!pngjs && "pngjs is not installed");

/** In seconds: the morphing model is a sphere first, and has lobes later. */
const times = [0.1, 0.9];

it("shows a cloth and a morphing model next to derivative frames, at several times", { skip, timeout: 400_000 }, async (t) => {
  await ready;
  const [html, page] = ["index.html", "page.js"].map((name) => readFileSync(join(folder, name), "utf8"));
  const pictures = [], reads = [];
  let boxes;
  const { hasAdapter } = await runPage({
    html, page, query: "?time=0", size: { width: 1200, height: 880 },
    body: async (tab, { hasAdapter }) => {
      if (!hasAdapter) return;
      for (const time of times) {
        reads.push(await tab.evaluate(async (seconds) => (await window.page.drawStill(seconds), window.page.read()), time));
        const bytes = await tab.screenshot();
        if (process.env.TSPACE_SCREENSHOTS) writeFileSync(join(process.env.TSPACE_SCREENSHOTS, `gpu_page-${time}.png`), bytes);
        pictures.push(pngjs.PNG.sync.read(bytes));
      }
      boxes = await tab.evaluate(() => [...document.querySelectorAll("canvas")].map((canvas) => canvas.getBoundingClientRect().toJSON()));
    },
  });
  if (!hasAdapter) return t.skip("this Chromium has no WebGPU adapter");
  assert.equal(boxes.length, 6);

  const names = reads[0].map(({ name }) => name);
  assert.deepEqual(names, ["cloth", "morphing model"]);
  names.forEach((name, model) => {
    const poses = times.map((time, i) => poseOf(reads[i][model], time));
    for (const [i, pose] of poses.entries()) {
      assertFrames(pose, `${name} at ${times[i]} s`);
      const { tangents, normals, wrongSigns } = compare(pose.wanted, pose);
      t.diagnostic(`${name} at ${times[i]} s, from the module: ${JSON.stringify({ tangents, normals, wrongSigns })}`);
      assert.equal(wrongSigns, 0);
      for (const { most, worst } of [tangents, normals]) assert.ok(most < 0.0005 && worst < 0.01, `${name} at ${times[i]} s: ${most}, ${worst} degrees`);
    }
    // The model moves, and its frames with it: those of the other time do not fit.
    const [first, second] = poses, moves = first.positions.map((x, i) => Math.abs(x - second.positions[i]));
    const { tangents, normals } = compare(first.wanted, second);
    t.diagnostic(`${name} between ${times.join(" and ")} s: ${JSON.stringify({ moves: Math.max(...moves), tangents, normals })}`);
    assert.ok(Math.max(...moves) > 0.1 && tangents.most > 10 && normals.most > 10, `${name} does not move`);
  });

  for (const picture of pictures) {
    const views = boxes.map((box) => statisticsOf(picture, box));
    t.diagnostic(JSON.stringify(views));
    for (let model = 0; model < 6; model += 3) {
      const [own, derived, heat] = views.slice(model, model + 3);
      for (const { share } of [own, derived, heat]) assert.ok(share > 0.25 && share < 0.9, "the model is seen");
      own.mean.forEach((level, i) => assert.ok(Math.abs(level - derived.mean[i]) < 0.1 * level, "both frames are lit alike"));
      assert.ok(derived.roughness > 1.02 * own.roughness, "frames from derivatives show facets");
      assert.ok(heat.mean[2] > 2 * heat.mean[0] && heat.roughness > 10, "differences are small on most pixels, and not the same everywhere");
    }
  }
  const [first, second] = pictures.map(({ data }) => data);
  let changed = 0;
  for (let at = 0; at < first.length; at += 4) changed += Math.abs(first[at] - second[at]) > 16 ? 1 : 0;
  assert.ok(changed > 0.1 * (first.length / 4), `only ${changed} pixels change between the two times`);
});
