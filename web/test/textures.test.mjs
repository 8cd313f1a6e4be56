// SPDX-License-Identifier: MIT
// KTX2 and DDS in the picture: the same pixels as in the tool, and a message for unsupported formats.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { deflateSync } from "node:zlib";
import { decode } from "fast-png";
import { Glb } from "./glb.mjs";
import { noShared, noTool, openFile, pixelsOf, shared, shareOf, shoot, tool, withPage } from "./support.mjs";

let folder;
before(() => (folder = mkdtempSync(join(tmpdir(), "tspace-textures-"))));
after(() => rmSync(folder, { recursive: true, force: true }));
const run = (...args) => execFileSync(tool, args, { stdio: ["ignore", "pipe", "pipe"] });

/** Returns a KTX2 with one block of ASTC, which the page's decoders do not support. */
function astc() {
  const file = ktx2(4, 4, Buffer.alloc(16), 0);
  file.writeUInt32LE(157, 12);
  file[104 + 12] = 162;
  return file;
}

/** Returns the pixels that the page's decoders read from a file. */
const decoded = (tab, path) => tab.evaluate(async (text) => {
  const file = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const { width, height, rgba } = await window.tspaceView.work.run("texture", { file });
  return { width, height, rgba: Array.from(rgba) };
}, readFileSync(path).toString("base64"));

/** Returns the tool's pixels: the output of flip-green, with green inverted back. */
function byTool(path) {
  const out = join(folder, "flipped.png");
  run("flip-green", path, "-o", out);
  const { width, height, channels, depth, data } = decode(readFileSync(out)), most = 2 ** depth - 1;
  const rgba = Array.from({ length: 4 * width * height }, (_, i) => {
    const k = i % 4, at = channels * Math.floor(i / 4);
    return (255 / most) * (k === 3 ? (channels === 4 ? data[at + 3] : most) : k === 1 ? most - data[at + 1] : data[at + k]);
  });
  rmSync(out);
  return { width, height, rgba };
}

/** Returns a KTX2 with 8-bit RGBA, uncompressed (0) or zlib-compressed (3). */
function ktx2(width, height, rgba, packing) {
  const descriptor = Buffer.alloc(4 + 24 + 4 * 16), level = packing === 3 ? deflateSync(rgba) : rgba;
  descriptor.writeUInt32LE(descriptor.length, 0);
  descriptor.writeUInt32LE((2 | ((descriptor.length - 4) << 16)) >>> 0, 8);
  descriptor.set([1, 1, 1, 0, 0, 0, 0, 0, 4], 12);
  [0, 1, 2, 15].forEach((channel, i) => {
    descriptor.set([8 * i, 0, 7, channel], 28 + 16 * i);
    descriptor.writeUInt32LE(255, 28 + 16 * i + 12);
  });
  const head = Buffer.alloc(80 + 24);
  head.set([0xab, 0x4b, 0x54, 0x58, 0x20, 0x32, 0x30, 0xbb, 0x0d, 0x0a, 0x1a, 0x0a]);
  [37, 1, width, height, 0, 0, 1, 1, packing].forEach((word, i) => head.writeUInt32LE(word, 12 + 4 * i));
  head.writeUInt32LE(head.length, 48);
  head.writeUInt32LE(descriptor.length, 52);
  const start = head.length + descriptor.length, padding = Buffer.alloc((8 - (start % 8)) % 8);
  head.writeBigUInt64LE(BigInt(start + padding.length), 80);
  head.writeBigUInt64LE(BigInt(level.length), 88);
  head.writeBigUInt64LE(BigInt(rgba.length), 96);
  return Buffer.concat([head, descriptor, padding, level]);
}

test("the page decodes KTX2 and DDS to the pixels of the tool", { skip: noTool }, async () => {
  const lamp = join(shared, "models/khronos/AnisotropyBarnLamp"), map = join(folder, "map.png");
  await withPage(async (tab) => {
    const images = await tab.evaluate(() => {
      const { bytes } = window.tspaceView.model;
      return [...bytes];
    });
    const glb = new Glb(Buffer.from(images)), { json } = glb;
    writeFileSync(map, glb.bytesOfImage(json.textures[json.materials[0].normalTexture.index].source));
    run("compress-map", map, "-o", join(folder, "map.ktx2"));
    run("compress-map", map, "-o", join(folder, "map.dds"));
    const width = 13, height = 7, rgba = Buffer.from(Array.from({ length: 4 * width * height }, (_, i) => (i * 73 + (i >> 3) * 11) & 255));
    for (const packing of [0, 3]) writeFileSync(join(folder, `plain-${packing}.ktx2`), ktx2(width, height, rgba, packing));
    const files = [...readdirSync(lamp).filter((name) => name.endsWith(".ktx2")).map((name) => join(lamp, name)), ...["map.ktx2", "map.dds", "plain-0.ktx2", "plain-3.ktx2"].map((name) => join(folder, name))];
    assert.ok(files.length >= 5);
    for (const file of files) {
      const own = await decoded(tab, file), theirs = byTool(file);
      assert.deepEqual([own.width, own.height], [theirs.width, theirs.height], file);
      // The tool reconstructs z of two-channel files; in a glTF, blue is read from the file, where it is absent.
      const hasBlue = !file.includes("map.");
      const most = own.rgba.reduce((most, value, i) => (i % 4 === 2 && !hasBlue ? most : Math.max(most, Math.abs(value - theirs.rgba[i]))), 0);
      // The tool may write 16 bits, which are rounded to 8 here.
      assert.ok(most <= 0.51, `${file}: ${most}`);
    }
    assert.deepEqual((await decoded(tab, join(folder, "plain-3.ktx2"))).rgba, [...rgba]);
  });
});

test("a model with KTX2 is drawn with its images, without a message about missing ones", { skip: noShared }, async () => {
  const lamp = join(shared, "models/khronos/AnisotropyBarnLamp"), names = readdirSync(lamp), gltf = names.find((name) => /\.(gltf|glb)$/.test(name));
  await withPage(async (tab) => {
    assert.equal(await openFile(tab, join(lamp, gltf), { others: Object.fromEntries(names.filter((name) => name !== gltf).map((name) => [name, join(lamp, name)])) }), "ready");
    assert.equal(await tab.locator(".remark").isVisible(), false, await tab.locator(".remark").textContent());
    const maps = await tab.evaluate(() => window.tspaceView.views.stage.viewport.scene.drawn.map(({ part }) => part.normalMap?.image.width ?? 0));
    assert.ok(maps.some((width) => width > 0), maps.join());
    await shoot(tab, "model-ktx2");
  }, { allowMessages: true });
});

test("a KTX2 is drawn, and the alternative image only if the KTX2 is corrupt", { skip: noShared }, async () => {
  // The bottle is yellow, and the alternative to the KTX2 is a single blue texel.
  const bottle = join(shared, "models/assets/ycb_mustard_bottle.glb"), broken = readFileSync(bottle);
  broken.writeUInt32LE(0x7fffffff, broken.indexOf("KTX 20") - 1 + 12);
  writeFileSync(join(folder, "broken.glb"), broken);
  await withPage(async (tab) => {
    for (const [path, isYellow] of [[bottle, true], [join(folder, "broken.glb"), false]]) {
      assert.equal(await openFile(tab, path), "ready");
      assert.equal(await tab.locator(".remark").isVisible(), false, await tab.locator(".remark").textContent());
      const image = await pixelsOf(tab), share = shareOf(image, (i) => image.data[i] > image.data[i + 2] + 60);
      assert.ok(isYellow ? share > 0.1 : share === 0, `${path}: ${share} of the picture is yellow`);
    }
  }, { allowMessages: true });
});

test("corrupt textures of hostile files cause a message", { skip: noTool }, async () => {
  await withPage(async (tab) => {
    const path = join(shared, "models/khronos/AnisotropyBarnLamp/AnisotropyBarnLamp_normalbump.ktx2"), whole = readFileSync(path);
    const failed = (bytes) => tab.evaluate(async (text) => {
      const file = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
      return window.tspaceView.work.run("texture", { file }).then(({ width, height }) => `${width} x ${height}`, (error) => error.message);
    }, bytes.toString("base64"));
    const said = new Set();
    for (let i = 1; i < 40; ++i) {
      const cut = await failed(whole.subarray(0, Math.floor((whole.length * i) / 40)));
      assert.doesNotMatch(cut, /^\d+ x/);
      said.add(cut);
      const broken = Buffer.from(whole);
      for (let k = 0; k < 4; ++k) broken[(i * 37 + k * 5) % 160] ^= 1 << (i + k) % 8;
      assert.match(await failed(broken), /./);
    }
    for (const sentence of said) assert.match(sentence, /^(it|the KTX2|the image) /);
    assert.equal(await failed(Buffer.from("no texture")), "it is neither KTX2 nor DDS");
    assert.equal(await failed(astc()), "it is a KTX2 with ASTC data, which this page cannot show; export it as PNG, JPEG or WebP, or as KTX2 with UASTC or ETC1S");
  }, { allowMessages: true });
});
