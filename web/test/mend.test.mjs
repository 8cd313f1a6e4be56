// SPDX-License-Identifier: MIT
// Files that the page repairs are byte-identical to the output of the tool.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { Glb } from "./glb.mjs";
import { choose, fixAndDownload, missing, named, noTool, openFile, openSample, settled, shared, shoot, tool, withPage } from "./support.mjs";

test("repairing the faulty crate leaves no finding, and shows the changes", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await tab.locator(".mend summary").click();
    await fixAndDownload(tab);
    assert.match(await tab.locator(".changes").textContent(), /vertices corrected/);
    // The picture now shows the downloaded file.
    await tab.locator(".figures", { hasText: "the fixed file" }).waitFor();
    assert.equal(await tab.locator(".side.right").textContent(), "fixed");
    assert.match(await tab.locator(".figures").textContent(), /Compared with the fixed file, 1,728 of 5,184 corners have the wrong sign; directions differ by 0\.00° on average/);
    await tab.locator(".result").scrollIntoViewIfNeeded();
    await shoot(tab, "mended");
    await tab.getByRole("button", { name: "Open the fixed file" }).click();
    assert.equal(await settled(tab), "ready");
    assert.match(await tab.locator(".findings .fine").textContent(), /No errors were found/);
    assert.equal(await tab.locator(".model-name").textContent(), "crate-signs-lost-fixed.glb");
  });
});

test("the tangents right of the line are those of the download for any method", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await tab.locator(".mend summary").click();
    await choose(tab, "recompute all", ".mend");
    for (const method of ["flat", "best"]) {
      await tab.locator(".mend select").selectOption(method);
      const glb = new Glb(await fixAndDownload(tab)), [primitive] = glb.primitives("TANGENT"), tangents = glb.numbers(primitive.attributes.TANGENT);
      const wanted = [...glb.indices(primitive)].flatMap((vertex) => [...tangents.subarray(4 * vertex, 4 * vertex + 4)]);
      await tab.waitForFunction((first) => window.tspaceView.views.stage.viewport.scene.drawn[0].frames?.tangents.every((x, i) => x === first[i]), wanted);
    }
    // Selecting a method shows its frames again, and selecting the fixed file shows that file.
    await tab.locator(".look select").first().selectOption("lengyel");
    await tab.locator(".figures", { hasText: "lengyel" }).waitFor();
    await tab.locator(".look select").first().selectOption("mended");
    await tab.locator(".figures", { hasText: "the fixed file" }).waitFor();
  });
});

test("downloads are byte-identical to the output of the displayed command line", { skip: noTool }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-mend-"));
  try {
    await withPage(async (tab) => {
      await tab.locator(".mend summary").click();
      const cases = [
        async () => {},
        async () => choose(tab, "recompute all", ".mend"),
        async () => tab.locator(".mend select").selectOption("best"),
        async () => choose(tab, "inverted", ".mend"),
      ];
      for (const name of ["crate-signs-lost.glb", "ring-directx.glb"]) {
        await openSample(tab, name);
        const model = await tab.evaluate(() => window.tspaceView.model.name);
        writeFileSync(join(folder, model), Uint8Array.from(await tab.evaluate(() => [...window.tspaceView.model.bytes])));
        for (const act of name === "ring-directx.glb" ? cases.slice(0, 1) : cases) {
          await act();
          if (name === "ring-directx.glb") await tab.getByLabel("Invert green in maps").uncheck(); // the page compresses PNGs differently
          const bytes = await fixAndDownload(tab);
          const [program, ...words] = (await tab.locator(".command").textContent()).split(" ");
          assert.equal(program, "tspace");
          execFileSync(tool, [...words, "--quiet"], { cwd: folder });
          assert.ok(bytes.equals(readFileSync(join(folder, words[words.indexOf("-o") + 1]))), words.join(" "));
        }
      }
    });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});

/** Returns whether two GLBs differ only in normals and tangents, and in normals by at most one quantization step. */
function areEqualButForRoundedNormals(a, b) {
  assert.deepEqual(a.json, b.json);
  const accessors = (...names) => new Set(a.primitives().flatMap(({ attributes }) => names.map((name) => attributes[name])).filter((index) => index !== undefined));
  const normals = accessors("NORMAL"), free = accessors("NORMAL", "TANGENT");
  for (const index of normals) {
    const [own, other] = [a, b].map((glb) => glb.numbers(index)), step = { 5120: 1 / 127, 5122: 1 / 32767 }[a.json.accessors[index].componentType];
    assert.ok(own.every((x, i) => Math.abs(x - other[i]) < 1.001 * step));
  }
  for (const index of a.json.accessors.keys()) if (!free.has(index)) assert.deepEqual(a.numbers(index), b.numbers(index));
}

test("fixed compressed models have the bytes of the tool's uncompressed output", { skip: noTool }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-mend-"));
  try {
    await withPage(async (tab) => {
      await tab.locator(".mend summary").click();
      const exact = ["features/BoxMeshopt.glb", "features/BoxDraco/BoxDraco.gltf", "derived/Suzanne_draco.glb"];
      // The normals of these models use a filter of meshopt, whose versions differ in the last bit.
      const filtered = ["features/pirate_meshopt.glb", "derived/BoomBoxWithAxes_meshopt.glb"];
      for (const name of [...exact, ...filtered]) {
        const path = join(shared, "models", name);
        assert.equal(await openFile(tab, path, { others: named(path) }), "ready", name);
        const bytes = await fixAndDownload(tab), words = (await tab.locator(".command").textContent()).split(" ").slice(1);
        assert.deepEqual(words.slice(-3), ["--repair", "--compress", "none"]);
        const out = join(folder, words[words.indexOf("-o") + 1]);
        words[words.indexOf("-o") + 1] = out;
        execFileSync(tool, [...words, "--quiet"], { cwd: dirname(path) });
        if (exact.includes(name)) assert.ok(bytes.equals(readFileSync(out)), name);
        else areEqualButForRoundedNormals(new Glb(bytes), new Glb(readFileSync(out)));
      }
    }, { allowMessages: true });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});

test("a .gltf with files is downloaded as a folder, in which only changed data differ", { skip: noTool }, async () => {
  const path = join(shared, "models/assets/sofa_03/sofa_03_1k.gltf"), { unzipSync, zipSync } = await import("fflate");
  await withPage(async (tab) => {
    const others = { ...named(path), "LICENSE.txt": join(shared, "models/README.md") };
    assert.equal(await openFile(tab, path, { others }), "ready");
    await tab.locator(".mend > summary").click();
    await choose(tab, "recompute all", ".mend");
    const glb = new Glb(await fixAndDownload(tab));
    const [download] = await Promise.all([tab.waitForEvent("download"), tab.locator(".result a.folder").click()]);
    assert.equal(download.suggestedFilename(), "sofa_03_1k-fixed.zip");
    const zip = Object.fromEntries(Object.entries(unzipSync(readFileSync(await download.path()))).map(([name, bytes]) => [name.replace(/^sofa_03_1k-fixed\//, ""), Buffer.from(bytes)]));
    assert.deepEqual(Object.keys(zip).sort(), [...Object.keys(others), "sofa_03_1k.gltf"].sort(), "the same names");
    const before = JSON.parse(readFileSync(path, "utf8")), after = JSON.parse(zip["sofa_03_1k.gltf"]);
    assert.deepEqual(after.images.map(({ uri }) => uri), before.images.map(({ uri }) => uri));
    const changed = Object.keys(others).filter((name) => !readFileSync(others[name]).equals(zip[name]));
    assert.deepEqual(changed, ["sofa_03.bin"]);
    // The values equal those in the GLB.
    const numbers = ({ json, binary }, index) => {
      const { bufferView, byteOffset = 0, count, type } = json.accessors[index], view = json.bufferViews[bufferView], start = (view.byteOffset ?? 0) + byteOffset, width = { VEC2: 8, VEC3: 12, VEC4: 16 }[type];
      const stride = view.byteStride ?? width;
      return Buffer.concat(Array.from({ length: count }, (_, i) => binary.subarray(start + i * stride, start + i * stride + width)));
    };
    for (const [m, mesh] of after.meshes.entries()) {
      for (const [p, { attributes }] of mesh.primitives.entries()) {
        for (const [name, index] of Object.entries(attributes)) {
          const own = numbers({ json: after, binary: zip["sofa_03.bin"] }, index), theirs = numbers({ json: glb.json, binary: glb.binary() }, glb.json.meshes[m].primitives[p].attributes[name]);
          assert.ok(own.length > 0 && own.equals(theirs), `${m}/${p} ${name}`);
        }
      }
    }
    // The folder can be opened again, and has no finding that was fixed.
    const folder = mkdtempSync(join(tmpdir(), "tspace-folder-"));
    try {
      writeFileSync(join(folder, "again.zip"), zipSync(Object.fromEntries(Object.entries(zip).map(([name, bytes]) => [`deep/${name}`, new Uint8Array(bytes)]))));
      await tab.locator(".picker input").first().setInputFiles(join(folder, "again.zip"));
      await tab.waitForFunction(() => window.tspaceView.model?.name === "sofa_03_1k.gltf" && document.documentElement.dataset.state === "ready");
      assert.equal(await tab.locator(".remark").isVisible(), false);
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
  }, { allowMessages: true });
});

test("an image changed by a fix keeps its name in the folder", { skip: missing }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-ring-")), { unzipSync } = await import("fflate");
  try {
    await withPage(async (tab) => {
      await openSample(tab, "ring-directx.glb");
      const glb = new Glb(Buffer.from(await tab.evaluate(() => [...window.tspaceView.model.bytes]))), { json } = glb, map = glb.bytesOfImage(0);
      writeFileSync(join(folder, "bricks map.png"), map);
      json.images[0] = { name: "bricks", uri: "maps/bricks%20map.png" };
      writeFileSync(join(folder, "ring.bin"), glb.binary());
      writeFileSync(join(folder, "ring.gltf"), JSON.stringify({ ...json, buffers: [{ byteLength: glb.binary().length, uri: "ring.bin" }] }));
      assert.equal(await openFile(tab, join(folder, "ring.gltf"), { others: { "ring.bin": join(folder, "ring.bin"), "maps/bricks map.png": join(folder, "bricks map.png") } }), "ready");
      await tab.locator(".mend > summary").click();
      const whole = new Glb(await fixAndDownload(tab));
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.locator(".result a.folder").click()]);
      const zip = unzipSync(readFileSync(await download.path())), own = Buffer.from(zip["ring-fixed/maps/bricks map.png"]);
      assert.deepEqual(Object.keys(zip).sort(), ["ring-fixed/maps/bricks map.png", "ring-fixed/ring.bin", "ring-fixed/ring.gltf"]);
      assert.ok(own.equals(whole.bytesOfImage(0)) && !own.equals(map), "green is turned in it");
      const after = JSON.parse(Buffer.from(zip["ring-fixed/ring.gltf"]).toString());
      assert.deepEqual(after.images, [{ name: "bricks", uri: "maps/bricks%20map.png" }]);
      assert.equal(after.buffers[0].byteLength, zip["ring-fixed/ring.bin"].length);
    });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
