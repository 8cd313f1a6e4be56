// SPDX-License-Identifier: MIT
// Models of each kind: the page shows them, and its reports are those of the tool.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { test } from "node:test";
import { isLong, kPatience, named, noShared, noTool, openFile, shared, shoot, tool, withPage } from "./support.mjs";

const models = [
  "khronos/NormalTangentTest.glb", "khronos/BoomBoxWithAxes.glb", "khronos/Suzanne/Suzanne.gltf", "khronos/CesiumMan.glb", "khronos/Fox.glb",
  "khronos/PrimitiveModeNormalsTest.glb", "khronos/ClearCoatTest.glb", "khronos/SimpleInstancing.glb", "features/box_sparse.glb", "features/box-morph.gltf",
  "features/many-cubes/many-cubes.gltf", "features/chr_knight.glb", "features/TexCoord0to7/TexCoord2.gltf", "blender/01_sphere/01_sphere.gltf",
  "blender/09_texture_transform/09_texture_transform.gltf", "assets/Cat.glb", "assets/Ghost.glb",
].map((name) => join(shared ?? "", "models", name));
const compressed = [
  "features/BoxMeshopt.glb", "features/BoxDraco/BoxDraco.gltf", "features/pirate_meshopt.glb", "features/DracoSparseMesh/DracoSparseMesh.gltf",
  "features/meshopt-fallback/meshopt-fallback.gltf", "features/BoxTextured_meshopt.glb", "features/meshopt-no-fallback/meshopt-no-fallback.gltf",
  "derived/BoomBoxWithAxes_meshopt.glb", "derived/Suzanne_draco.glb", "derived/NormalTangentTest_draco.glb", "assets/Sneaker_draco.glb",
  "assets/MaterialsVariantsShoe_draco.glb", "assets/ChessBoard_draco.glb", "features/DenseSphere.glb",
].map((name) => join(shared ?? "", "models", name));

/** Returns the tool's report on one file, and its exit code. */
function reportOf(verb, path) {
  const run = () => execFileSync(tool, [verb, "--json", basename(path)], { cwd: dirname(path), encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });
  let text;
  try {
    text = run();
  } catch (error) {
    text = error.stdout; // findings
  }
  const { files, exitCode } = JSON.parse(text);
  return { ...files[0], exitCode };
}

for (const [kind, paths, every] of [["models of each kind", models, 3], ["models compressed by meshopt and Draco", compressed, 3]]) {
  test(`${kind} are drawn, and their reports are the tool's`, { skip: noTool, timeout: 4 * kPatience }, async () => {
    await withPage(async (tab) => {
      const there = paths.filter((path, i) => existsSync(path) && (isLong || i % every === 0));
      assert.ok(there.length > 3);
      for (const path of there) {
        assert.equal(await openFile(tab, path, { others: named(path) }), "ready", path);
        assert.equal(await tab.evaluate(() => document.documentElement.dataset.picture), "drawn", path);
        const reports = await tab.evaluate(() => window.tspaceView.reports);
        for (const verb of ["inspect", "check", "identify"]) assert.deepEqual(reports[verb], reportOf(verb, path), `${verb} of ${path}`);
        assert.equal(await tab.locator(".finding").count(), new Set(reports.check.findings.map(({ code, severity }) => severity + code)).size, path);
        await shoot(tab, `model-${basename(path).replace(/\.\w+$/, "")}`);
      }
    }, { allowMessages: true });
  });
}

test("an OBJ is shown as the GLB that it becomes", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    assert.equal(await openFile(tab, join(shared, "models/obj/spot.obj")), "ready");
    assert.match(await tab.locator(".remark").textContent(), /OBJ/);
    assert.equal(await tab.evaluate(() => window.tspaceView.reports.inspect.primitives[0].triangles), 5856);
    await shoot(tab, "model-obj");
  }, { allowMessages: true });
});

test("with 500k triangles the page stays responsive, and can be stopped", { skip: noShared || (!isLong && "only with --long"), timeout: 4 * kPatience }, async () => {
  const path = join(shared, "models/perf/Market_495k.glb");
  if (!existsSync(path)) return;
  await withPage(async (tab) => {
    const opened = openFile(tab, path, { timeout: 3 * kPatience });
    await tab.waitForSelector("html[data-picture=drawn]", { state: "attached" });
    // The picture is shown and the page responds to a click.
    await tab.locator(".look select").first().selectOption("flat");
    await shoot(tab, "model-500k");
    if (await tab.locator(".stop").isVisible()) await tab.locator(".stop").click();
    assert.ok(["stopped", "ready"].includes(await opened));
  }, { allowMessages: true });
});
