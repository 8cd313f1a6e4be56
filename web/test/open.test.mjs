// SPDX-License-Identifier: MIT
// Opening models: dropped files and folders, and the file picker. Also touch gestures.
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Glb } from "./glb.mjs";
import { drawn, missing, openBytes, openSample, settled, shoot, withPage } from "./support.mjs";

let folder;
const at = (...names) => join(folder, ...names);

/** Writes the page's crate as a .glb and as a .gltf with files in a folder, and an OBJ with a material. */
before(async () => {
  if (missing) return;
  folder = mkdtempSync(join(tmpdir(), "tspace-open-"));
  const bytes = await withPage((tab) => tab.evaluate(() => [...window.tspaceView.model.bytes]));
  const glb = new Glb(Buffer.from(bytes)), { json } = glb;
  mkdirSync(at("box", "maps"), { recursive: true });
  writeFileSync(at("crate.glb"), Buffer.from(bytes));
  for (const [i, image] of json.images.entries()) {
    image.uri = `maps/side%20${i}.png`;
    writeFileSync(at("box", "maps", `side ${i}.png`), glb.bytesOfView(image.bufferView));
    delete image.bufferView;
  }
  writeFileSync(at("box", "crate.bin"), glb.binary());
  writeFileSync(at("box", "crate.gltf"), JSON.stringify({ ...json, buffers: [{ byteLength: glb.binary().length, uri: "crate.bin" }] }));
  writeFileSync(at("quad.obj"), "mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl red\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
  writeFileSync(at("quad.mtl"), "newmtl red\nKd 1 0 0\n");
  writeFileSync(at("notes.txt"), "no model");
});
after(() => folder && rmSync(folder, { recursive: true, force: true }));

/** Drops files on the page with a real drop event of the browser. */
async function drop(tab, ...files) {
  const session = await tab.context().newCDPSession(tab);
  const data = { items: [], files, dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver"]) await session.send("Input.dispatchDragEvent", { type, x: 600, y: 400, data });
  assert.equal(await tab.evaluate(() => document.body.classList.contains("dropping")), true, "the page shows that it takes the files");
  await tab.evaluate(() => (document.documentElement.dataset.state = "dropped"));
  await session.send("Input.dispatchDragEvent", { type: "drop", x: 600, y: 400, data });
  await tab.waitForSelector("html:not([data-state=dropped])", { state: "attached" });
  assert.equal(await tab.evaluate(() => document.body.classList.contains("dropping")), false);
  return settled(tab);
}

const shown = (tab) => tab.evaluate(() => ({
  picture: document.documentElement.dataset.picture, name: window.tspaceView.model?.name, others: [...(window.tspaceView.model?.others.keys() ?? [])].sort(),
  codes: window.tspaceView.reports.check?.findings.map(({ code }) => code), maps: window.tspaceView.views.stage.viewport.scene.drawn.map(({ part }) => part.normalMap !== null),
}));

test("dropped files, folders and OBJs are shown and checked", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await openSample(tab, "ring-directx.glb");
    assert.equal(await drop(tab, at("crate.glb")), "ready");
    assert.deepEqual(await shown(tab), { picture: "drawn", name: "crate.glb", others: [], codes: ["signsWrong"], maps: [true] });
    const files = ["crate.bin", "maps/side 0.png", "maps/side 1.png"];
    assert.equal(await drop(tab, at("box")), "ready");
    assert.deepEqual(await shown(tab), { picture: "drawn", name: "crate.gltf", others: files, codes: ["signsWrong"], maps: [true] });
    assert.equal(await drop(tab, at("box", "crate.bin"), at("box", "maps"), at("box", "crate.gltf")), "ready");
    assert.deepEqual(await shown(tab), { picture: "drawn", name: "crate.gltf", others: files, codes: ["signsWrong"], maps: [true] });
    assert.equal(await drop(tab, at("quad.mtl"), at("quad.obj")), "ready");
    assert.equal((await shown(tab)).picture, "drawn");
    assert.match(await tab.locator(".remark").textContent(), /OBJ/);
    await shoot(tab, "dropped-obj");
  });
});

test("files that are not models, and missing files, are reported", { skip: missing }, async () => {
  await withPage(async (tab) => {
    assert.equal(await drop(tab, at("notes.txt")), "failed");
    assert.match(await tab.locator(".failure").textContent(), /notes\.txt has a format that this page does not support/);
    assert.equal(await drop(tab, at("box", "crate.gltf")), "failed");
    assert.match(await tab.locator(".failure").textContent(), /crate\.bin/);
    assert.equal(await drop(tab, at("crate.glb")), "ready");
  }, { allowMessages: true });
});

test("a .gltf and its files may be dropped one after the other, and missing files are listed", { skip: missing }, async () => {
  await withPage(async (tab) => {
    assert.equal(await drop(tab, at("box", "crate.gltf")), "failed");
    assert.match(await tab.locator(".failure").textContent(), /crate\.bin, maps\/side 0\.png, maps\/side 1\.png\. Drop them together with the model/);
    assert.equal(await drop(tab, at("box", "crate.bin")), "ready");
    assert.match(await tab.locator(".remark").textContent(), /files that were not dropped: maps\/side 0\.png, maps\/side 1\.png\./);
    assert.equal(await drop(tab, at("box", "maps", "side 0.png"), at("box", "maps", "side 1.png")), "ready");
    assert.deepEqual(await shown(tab), { picture: "drawn", name: "crate.gltf", others: ["crate.bin", "maps/side 0.png", "maps/side 1.png", "side 0.png", "side 1.png"], codes: ["signsWrong"], maps: [true] });
  }, { allowMessages: true });
});

test("a zip is opened like a folder, with a choice of several models", { skip: missing }, async () => {
  await withPage(async (tab) => {
    const { zipSync } = await import("fflate");
    const files = ["crate.gltf", "crate.bin", "maps/side 0.png", "maps/side 1.png"];
    writeFileSync(at("box.zip"), zipSync(Object.fromEntries(files.map((name) => [`deep/${name}`, readFileSync(at("box", name))]))));
    assert.equal(await drop(tab, at("box.zip")), "ready");
    assert.deepEqual(await shown(tab), { picture: "drawn", name: "crate.gltf", others: files.slice(1), codes: ["signsWrong"], maps: [true] });
    assert.equal(await tab.locator(".models").isVisible(), false);
    assert.equal(await drop(tab, at("crate.glb"), at("quad.obj"), at("quad.mtl")), "ready");
    assert.deepEqual(await tab.locator(".models option").allTextContents(), ["crate.glb", "quad.obj"]);
    await tab.locator(".models").selectOption("quad.obj");
    await tab.waitForFunction(() => window.tspaceView.model?.name === "quad.glb");
    assert.equal(await settled(tab), "ready");
    writeFileSync(at("broken.zip"), "PK no zip");
    assert.equal(await drop(tab, at("broken.zip")), "failed");
    assert.match(await tab.locator(".failure").textContent(), /broken\.zip is not a readable zip file/);
  });
});

test("files and folders can be chosen, too", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await tab.locator(".picker input").first().setInputFiles([at("quad.obj"), at("quad.mtl")]);
    await tab.waitForFunction(() => window.tspaceView.model?.name === "quad.glb");
    assert.equal(await settled(tab), "ready");
    await tab.locator(".picker input[webkitdirectory]").setInputFiles(at("box"));
    await tab.waitForFunction(() => window.tspaceView.model?.name === "crate.gltf");
    assert.equal(await settled(tab), "ready");
    assert.equal((await shown(tab)).picture, "drawn");
  });
});

/** Returns the camera's direction and distance from its target. */
const eye = (tab) => tab.evaluate(() => {
  const { camera, target } = window.tspaceView.views.stage.viewport;
  const way = camera.position.clone().sub(target), distance = way.length();
  return { distance, direction: way.divideScalar(distance).toArray() };
});
const degrees = (a, b) => (Math.acos(Math.min(1, a.reduce((sum, x, i) => sum + x * b[i], 0))) * 180) / Math.PI;

test("one finger rotates the model, and two fingers zoom", { skip: missing }, async () => {
  await withPage(async (tab) => {
    const session = await tab.context().newCDPSession(tab);
    const box = await tab.locator(".frame canvas").boundingBox();
    const place = (x, y, id) => ({ x: box.x + box.width * x, y: box.y + box.height * y, id });
    /** Moves fingers between positions, given as fractions of the picture. */
    const drag = async (from, to) => {
      const between = (t) => from.map(([x, y], id) => place(x + t * (to[id][0] - x), y + t * (to[id][1] - y), id));
      await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: between(0) });
      for (let step = 1; step <= 8; ++step) await session.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: between(step / 8) });
      await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
      await drawn(tab);
    };
    const start = await eye(tab);
    await drag([[0.4, 0.5]], [[0.7, 0.5]]);
    const turned = await eye(tab);
    assert.ok(degrees(start.direction, turned.direction) > 10, "turned");
    assert.ok(Math.abs(turned.distance / start.distance - 1) < 0.01, "and came no nearer");
    // Both fingers start next to the split line, because a finger on the line would drag it.
    await drag([[0.3, 0.3], [0.4, 0.3]], [[0.1, 0.3], [0.6, 0.3]]);
    const near = await eye(tab);
    assert.ok(near.distance < 0.8 * turned.distance, `${near.distance} of ${turned.distance}`);
    await drag([[0.1, 0.3], [0.8, 0.3]], [[0.45, 0.3], [0.55, 0.3]]);
    assert.ok((await eye(tab)).distance > 1.2 * near.distance, "and away again");
    assert.equal(await tab.evaluate(() => scrollY), 0, "the page does not scroll under the fingers");
    await tab.waitForSelector(".texel dl", { state: "attached" }); // the texel at the touched point is shown
  }, { width: 390, height: 844, hasTouch: true });
});

test("a fault of the page is not attributed to the file, and an error of three.js is, and the findings are still shown", { skip: missing }, async () => {
  await withPage(async (tab) => {
    const bytes = Buffer.from(await tab.evaluate(() => [...window.tspaceView.model.bytes])), glb = new Glb(bytes);
    glb.json.nodes[0].children = [7]; // tspace reads no nodes that do not exist, three.js does
    await openBytes(tab, "crate.glb", glb.finish());
    assert.match(await tab.locator(".remark").textContent(), /^There is no picture\. The loader of three\.js cannot read this file \(.+\)\. The findings do not depend on the picture\.$/);
    assert.ok((await tab.locator(".finding").count()) > 0);
    writeFileSync(at("broken.glb"), "glTF");
    assert.equal(await drop(tab, at("broken.glb")), "failed");
    assert.equal(await tab.locator(".remark").isVisible(), false, "nothing is said about the file before");
    await tab.evaluate(() => (window.tspaceView.views.stage.viewport.reset = () => undefined.parts));
    await openBytes(tab, "crate.glb", bytes);
    assert.match(await tab.locator(".remark").textContent(), /^There is no picture\. This page failed with an internal error \(TypeError: .*\), which does not mean that the file is damaged\. The findings do not depend on the picture\.$/);
    assert.ok((await tab.locator(".finding").count()) > 0);
  }, { allowMessages: true });
});
