// SPDX-License-Identifier: MIT
// Compares "tspace/textures" with the tool: equal pixels, bytes and verdicts.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { deflateSync, inflateSync } from "node:zlib";
import { compressMap, convertMap, readTexture, ready, TspaceError } from "tspace/textures";
import { ofTool, shared, tool } from "./tool.mjs";

await ready;
const [pngjs, zstddec, ktxParse] = await Promise.all(
  ["pngjs", "three/examples/jsm/libs/zstddec.module.js", "ktx-parse"].map((name) => import(name).catch(() => null)),
);
const noTool = (!tool && "no tool here: build the preset release") || (!pngjs && "pngjs is not installed");

let folder;
before(() => (folder = mkdtempSync(join(tmpdir(), "tspace-js-"))));
after(() => rmSync(folder, { recursive: true, force: true }));
const at = (name) => join(folder, name);
const run = (...args) => execFileSync(tool, args, { stdio: ["ignore", "pipe", "pipe"] });

/** Returns a map of gentle waves with a step; `most`: 255 or 65535. */
function waves(width, height, most = 255) {
  const Type = most === 255 ? Uint8Array : Uint16Array;
  const rgba = new Type(4 * width * height);
  for (let i = 0; i < width * height; ++i) {
    const u = ((i % width) + 0.5) / width, v = (Math.floor(i / width) + 0.5) / height;
    const x = 0.3 * Math.sin(7 * u) + (u > 0.6 ? 0.2 : 0), y = 0.25 * Math.sin(9 * (u + v)), z = Math.sqrt(1 - x * x - y * y);
    rgba.set([x, y, z].map((part) => Math.round((0.5 + 0.5 * part) * most)).concat(most), 4 * i);
  }
  return { width, height, rgba };
}
const roughness = (width, height) => ({ width, height, rgba: Uint8Array.from({ length: 4 * width * height }, (_, i) => [200, 60 + (i % 90), 10, 255][i % 4]) });

function writePng(name, { width, height, rgba }) {
  const is16 = rgba instanceof Uint16Array;
  const image = new pngjs.PNG({ width, height });
  image.data = is16 ? rgba : Buffer.from(rgba);
  writeFileSync(at(name), pngjs.PNG.sync.write(image, { colorType: 2, inputColorType: 6, inputHasAlpha: true, bitDepth: is16 ? 16 : 8 }));
}

/** Returns the tool's pixels of a texture: the PNG that flip-green writes, with green inverted back. */
function byTool(path) {
  const out = at("flipped.png");
  run("flip-green", path, "-o", out);
  const file = readFileSync(out), is16 = file[24] === 16, most = is16 ? 65535 : 255;
  const { width, height, data } = pngjs.PNG.sync.read(file, { skipRescale: true });
  rmSync(out);
  return { width, height, most, rgba: Array.from(data, (c, i) => (i % 4 === 1 ? most - c : c)) };
}

/** Returns a DDS with a DX10 header and consecutive levels. */
function dds(format, width, height, data, levels = 1) {
  const head = Buffer.alloc(148);
  head.write("DDS ");
  [124, 0x1007, height, width, 0, 0, levels].forEach((word, i) => head.writeUInt32LE(word, 4 + 4 * i));
  [32, 4].forEach((word, i) => head.writeUInt32LE(word, 76 + 4 * i));
  head.write("DX10", 84);
  [format, 3, 0, 1].forEach((word, i) => head.writeUInt32LE(word, 128 + 4 * i));
  return Buffer.concat([head, data]);
}
/** Returns the KTX2 with each level zlib-compressed. */
function packedByZlib(file) {
  const out = [Buffer.from(file)];
  out[0].writeUInt32LE(3, 44);
  let end = file.length;
  for (let i = 0; i < file.readUInt32LE(40); ++i) {
    const entry = 80 + 24 * i, from = Number(file.readBigUInt64LE(entry)), size = Number(file.readBigUInt64LE(entry + 8));
    const packed = deflateSync(file.subarray(from, from + size));
    out[0].writeBigUInt64LE(BigInt(end), entry);
    out[0].writeBigUInt64LE(BigInt(packed.length), entry + 8);
    out.push(packed);
    end += packed.length;
  }
  return Buffer.concat(out);
}
/** Returns reproducible random bytes. */
const noise = (count, seed = 1) => Buffer.from(Uint8Array.from({ length: count }, () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) >>> 24));

const refuses = (code, words, body) =>
  assert.throws(body, (error) => {
    assert.ok(error instanceof TspaceError, String(error.stack));
    assert.equal(error.code, code, error.message);
    assert.match(error.message, words);
    return true;
  });

describe("compressMap", () => {
  it("gives the bytes and the report of the tool", { skip: noTool }, () => {
    const cases = [
      [{}, [], 96, 64, 255], [{}, [], 37, 50, 65535], [{ quality: "quick" }, ["--quality", "quick"], 64, 64, 255],
      [{ quality: "best", signed: true }, ["--quality", "best", "--signed"], 32, 48, 65535],
      [{ format: "eac-rg11" }, ["--format", "eac-rg11"], 40, 24, 65535], [{ format: "rg8", noLevels: true }, ["--format", "rg8", "--no-levels"], 13, 7, 255],
    ];
    for (const [options, args, width, height, most] of cases)
      for (const container of options.format === "eac-rg11" ? ["ktx2"] : ["ktx2", "dds"]) {
        const image = waves(width, height, most);
        writePng("n.png", image);
        const { seconds, ok, input, inputFiles, output, outputFiles, schema, version, exitCode, ...wanted } = ofTool("compress-map", at("n.png"), "-o", at(`n.${container}`), ...args);
        const { bytes, report } = compressMap(image, { ...options, container });
        assert.ok(readFileSync(at(`n.${container}`)).equals(bytes), JSON.stringify([options, container]));
        for (const [name, value] of Object.entries(report)) assert.deepEqual(value, wanted[name], name);
        if (container === "ktx2" && ktxParse) assert.equal(ktxParse.read(bytes).levels.length, report.levels);
      }
  });

  it("increases roughness like the tool", { skip: noTool }, () => {
    const map = waves(64, 64), orm = roughness(32, 32);
    writePng("n.png", map);
    writePng("orm.png", orm);
    const wanted = ofTool("compress-map", at("n.png"), "-o", at("n.ktx2"), "--roughness", at("orm.png"), "-o2", at("orm.ktx2"), "--roughness-factor", "0.5");
    const made = compressMap(map, { roughness: orm, roughnessFactor: 0.5 });
    assert.ok(readFileSync(at("n.ktx2")).equals(made.bytes));
    assert.ok(readFileSync(at("orm.ktx2")).equals(made.roughness));
    assert.equal(made.report.meanWidenedRoughness, wanted.meanWidenedRoughness ?? wanted.files[0].meanWidenedRoughness);
    refuses("invalidOption", /the roughness: /, () => compressMap(map, { roughness: roughness(48, 32) }));
  });

  it("accepts textures, other files with decodeImage, and floats", () => {
    const image = waves(32, 32), fine = waves(32, 32, 65535);
    const { bytes } = compressMap(image, { format: "rg8", noLevels: true });
    assert.equal(compressMap(bytes).report.warnings.length, 1); // the warning states how channels were read
    const png = Uint8Array.from([0x89, 0x50, 0x4e, 0x47]);
    const types = [];
    assert.deepEqual(compressMap(png, { decodeImage: (file, type) => (types.push(type), image) }).bytes, compressMap(image).bytes);
    assert.deepEqual(types, ["image/png"]);
    const floats = { ...fine, rgba: Float32Array.from(fine.rgba, (c) => Math.fround(c / 65535)) };
    assert.deepEqual(compressMap(floats).bytes, compressMap(fine).bytes);
  });

  it("reports errors", () => {
    const image = waves(8, 8);
    refuses("unsupportedFile", /use the option decodeImage/, () => compressMap(Uint8Array.of(0x89, 0x50)));
    refuses("invalidOption", /a DDS cannot contain EAC/, () => compressMap(image, { format: "eac-rg11", container: "dds" }));
    refuses("unsupportedFile", /astcenc|ASTC/, () => compressMap(image, { format: "astc-4x4" }));
    refuses("invalidOption", /from 0 to 1/, () => compressMap(image, { roughness: image, roughnessFactor: 2 }));
    refuses("countMismatch", /has 255 numbers for 8 x 8/, () => compressMap({ ...image, rgba: new Uint8Array(255) }));
    refuses("wrongType", /decodeImage returned a Promise/, () => compressMap(Uint8Array.of(1), { decodeImage: async () => image }));
    refuses("invalidOption", /options.quallity is unknown/, () => compressMap(image, { quallity: "best" }));
    for (const rgba of [new Uint8Array(256).fill(255), new Uint8Array(256), new Float32Array(256).fill(NaN)]) {
      const { report } = compressMap({ ...image, rgba });
      assert.match(report.warnings.join(), Number.isNaN(rgba[0]) ? /64 texels of the image are NaN or infinite/ : /not unit vectors/);
      assert.ok(Number.isFinite(report.meanErrorDeg));
    }
  });
});

describe("convertMap", () => {
  it("gives the values of the tool for layouts, curves and flips", { skip: noTool }, () => {
    const cases = [
      [{ channels: "rg" }, ["--channels", "rg"]], [{ channels: "bgr" }, ["--channels", "bgr"]], [{ channels: "rG" }, ["--channels", "rG"]],
      [{ curve: "srgb" }, ["--srgb"]], [{ curve: "linearized", channels: "rg" }, ["--linearized", "--channels", "rg"]],
      [{ flipGreen: true }, ["--flip-green"]], [{ flipRed: true, flipGreen: true }, ["--flip-red", "--flip-green"]],
    ];
    for (const most of [255, 65535]) {
      const image = waves(37, 20, most);
      writePng("n.png", image);
      for (const [options, args] of cases) {
        const isByte = most === 255 && !options.channels && !options.curve && !options.flipRed;
        run("convert-map", at("n.png"), "-o", at("c.png"), ...args, "--bits", isByte ? "8" : "16", "-q");
        const { data } = pngjs.PNG.sync.read(readFileSync(at("c.png")), { skipRescale: true }), made = convertMap(image, options);
        assert.deepEqual([made.width, made.height, made.bitsBefore, made.numbers], [37, 20, most === 255 ? 8 : 16, isByte ? "uint8" : "uint16"]);
        assert.deepEqual(Array.from(made.rgba), Array.from(data), JSON.stringify(options));
      }
    }
  });

  it("reads x from alpha and two-channel textures, and rejects invalid inputs", () => {
    const { width, height, rgba } = waves(16, 16), alpha = rgba.slice();
    for (let i = 0; i < rgba.length; i += 4) alpha.set([9, rgba[i + 1], 9, rgba[i]], i);
    const made = convertMap({ width, height, rgba: alpha }, { channels: "ag" });
    for (let i = 0; i < rgba.length; i += 4) assert.deepEqual([made.rgba[i], made.rgba[i + 1], made.rgba[i + 3]], [257 * rgba[i], 257 * rgba[i + 1], 65535]);
    const { bytes } = compressMap({ width, height, rgba }), three = convertMap(bytes), read = readTexture(bytes);
    assert.deepEqual([three.numbers, three.howRead], ["uint16", read.howRead]);
    assert.deepEqual(three.rgba, read.rgba);
    assert.deepEqual(convertMap(bytes, { channels: "rg" }).rgba, read.rgba);
    refuses("invalidOption", /channels must be two or three of/, () => convertMap({ width, height, rgba }, { channels: "rr" }));
    refuses("invalidOption", /read from alpha, which the image does not have/, () => convertMap({ width, height, rgba }, { channels: "ag" }));
    assert.deepEqual(convertMap({ width, height, rgba: alpha }, { channels: "wyZ" }).rgba, convertMap({ width, height, rgba: alpha }, { channels: "agB" }).rgba);
    refuses("wrongType", /channels/, () => convertMap({ width, height, rgba }, { channels: 3 }));
    refuses("invalidOption", /^curve must be one of none.*, not null$/, () => convertMap({ width, height, rgba }, { curve: null }));
  });
});

describe("readTexture", () => {
  it("gives the pixels of the tool", { skip: noTool }, () => {
    const files = { 71: 8, 74: 16, 77: 16, 80: 8, 81: 8, 83: 16, 84: 16, 98: 16 };
    const names = Object.entries(files).map(([format, block], i) => {
      writeFileSync(at(`f${format}.dds`), dds(Number(format), 20, 12, noise(15 * block, i + 1)));
      return at(`f${format}.dds`);
    });
    writePng("n.png", waves(24, 20, 65535));
    for (const format of ["bc5", "eac-rg11", "rg8"]) {
      run("compress-map", at("n.png"), "-o", at(`${format}.ktx2`), "--format", format, "-q");
      names.push(at(`${format}.ktx2`));
    }
    for (const name of names) {
      const wanted = byTool(name), read = readTexture(readFileSync(name));
      assert.deepEqual([read.width, read.height, read.numbers], [wanted.width, wanted.height, wanted.most === 255 ? "uint8" : "uint16"], name);
      // BC4 and similar formats have intermediate values: the PNG is rounded after green was inverted, so values may
      // differ by one step.
      read.rgba.forEach((c, i) => assert.ok(Math.abs(c - wanted.rgba[i]) <= (i % 4 === 1 ? 1 : 0), `${name} ${i}: ${c} ${wanted.rgba[i]}`));
    }
  });

  it("reads each level, and reports the layout of two channels", () => {
    const image = waves(20, 12);
    for (const container of ["ktx2", "dds"]) {
      const { bytes, report } = compressMap(image, { format: "rg8", container });
      assert.equal(report.levels, 5);
      let end = 148;
      for (let level = 0; level < 5; ++level) {
        const read = readTexture(bytes, { level });
        assert.deepEqual([read.width, read.height, read.levels], [Math.max(20 >> level, 1), Math.max(12 >> level, 1), 5]);
        assert.deepEqual([read.container, read.format, read.channels, read.bits, read.isFloat, read.isSrgb], [container.toUpperCase(), "R8G8", 2, 8, false, false]);
        assert.deepEqual(read.layout, { x: "red", y: "green", z: null, isGuessed: false });
        assert.match(read.howRead, /x is read from red and y from green, so z is reconstructed from them/);
        const plain = readTexture(bytes, { level, vectors: false });
        assert.deepEqual([read.numbers, plain.numbers, plain.howRead], ["uint16", "uint8", ""]);
        for (let i = 0; i < read.width * read.height; ++i) {
          const [x, y, z] = [0, 1, 2].map((k) => read.rgba[4 * i + k]);
          assert.deepEqual([257 * plain.rgba[4 * i], 257 * plain.rgba[4 * i + 1], plain.rgba[4 * i + 2]], [x, y, 0]);
          assert.ok(Math.abs([x, y, z].reduce((sum, c) => sum + (c / 32767.5 - 1) ** 2, -1)) < 1e-3);
          if (container === "dds") assert.deepEqual([257 * bytes[end + 2 * i], 257 * bytes[end + 2 * i + 1]], [x, y]);
        }
        end += 2 * read.width * read.height;
      }
      refuses("invalidFile", /the texture has no mip level 5; its last mip level is 4/, () => readTexture(bytes, { level: 5 }));
    }
    const { bytes } = compressMap(waves(16, 16, 65535));
    const [coarse, fine, exact] = ["uint8", "uint16", "float"].map((numbers) => readTexture(bytes, { numbers }));
    assert.ok(coarse.rgba instanceof Uint8ClampedArray && fine.rgba instanceof Uint16Array && exact.rgba instanceof Float32Array);
    exact.rgba.forEach((c, i) => assert.ok(Math.abs(255 * c - coarse.rgba[i]) < 0.51 && Math.abs(65535 * c - fine.rgba[i]) < 0.51));
    assert.equal(readTexture(bytes).numbers, "uint16");
  });

  it("detects x in alpha and y in green, and reports that it is a guess", () => {
    const { width, height, rgba } = waves(16, 16);
    const packed = Buffer.alloc(rgba.length);
    for (let i = 0; i < rgba.length; i += 4) packed.set([255, rgba[i + 1], rgba[i + 1], rgba[i]], i);
    const read = readTexture(dds(28, width, height, packed));
    assert.deepEqual(read.layout, { x: "alpha", y: "green", z: null, isGuessed: true });
    assert.deepEqual([read.rgba[0], read.rgba[1], read.rgba[3]], [257 * rgba[0], 257 * rgba[1], 65535]);
    assert.match(read.howRead, /look as if/);
  });

  it("decompresses supercompressed KTX2 with functions of the caller", { skip: noTool || (!zstddec && "three is not installed") }, async () => {
    const image = waves(32, 32), plain = Buffer.from(compressMap(image).bytes), wanted = readTexture(plain);
    const byZlib = packedByZlib(plain);
    refuses("invalidFile", /zlib supercompression; use the option unzlib/, () => readTexture(byZlib));
    assert.deepEqual(readTexture(byZlib, { unzlib: (data) => inflateSync(data) }), wanted);
    for (const level of [1, 4]) assert.deepEqual(readTexture(byZlib, { level, unzlib: inflateSync }), readTexture(plain, { level }));
    for (const wrong of [() => new Uint8Array(5), () => assert.fail("broken")]) refuses("invalidFile", /the KTX2 is damaged/, () => readTexture(byZlib, { unzlib: wrong }));
    refuses("wrongType", /the result of unzlib must be a Uint8Array/, () => readTexture(byZlib, { unzlib: () => "text" }));
    writePng("n.png", image);
    run("compress-map", at("n.png"), "-o", at("z.ktx2"), "--zstd", "5", "-q");
    const decoder = new zstddec.ZSTDDecoder();
    await decoder.init();
    refuses("invalidFile", /Zstandard supercompression; use the option unzstd/, () => readTexture(readFileSync(at("z.ktx2"))));
    assert.deepEqual(readTexture(readFileSync(at("z.ktx2")), { unzstd: (data, size) => decoder.decode(data, size) }), wanted);
  });

  it("agrees with the tool on corrupt files, and works afterwards", { skip: noTool }, () => {
    const image = waves(20, 12);
    const good = [["ktx2", "bc5"], ["dds", "bc5"], ["ktx2", "rg8"]].map(([container, format]) => Buffer.from(compressMap(image, { container, format, quality: "quick" }).bytes));
    good.push(dds(98, 20, 12, noise(240)), Buffer.from("no texture"), Buffer.alloc(0));
    const broken = good.flatMap((file) => {
      const made = [file, file.subarray(0, file.length >> 1), file.subarray(0, 60), file.subarray(0, Math.max(file.length - 1, 0))];
      for (const [place, value] of [[12, 0xffffffff], [16, 0x7fffffff], [20, 0x40000000], [24, 0], [28, 99], [40, 32], [44, 2], [80, 1], [84, 0xffffffff], [88, 3], [128, 131], [140, 7]]) {
        const copy = Buffer.from(file);
        if (copy.length >= place + 4) made.push((copy.writeUInt32LE(value, place), copy));
      }
      return made;
    });
    const verdict = (body) => {
      try {
        body();
        return "ok";
      } catch (error) {
        assert.ok(error instanceof TspaceError, error.stack);
        return error.code;
      }
    };
    let refused = 0;
    for (const file of broken) {
      writeFileSync(at("broken"), file);
      const wanted = ofTool("compress-map", at("broken"), "-o", at("o.ktx2"), "--dry-run", "--quality", "quick");
      const own = verdict(() => compressMap(file, { quality: "quick" }));
      // The tool also checks for a TGA header, and reports unsupportedFile for data that is not an image.
      assert.equal(own, wanted.ok ? "ok" : wanted.error.code, JSON.stringify(wanted));
      assert.equal(verdict(() => readTexture(file)), own);
      refused += own === "ok" ? 0 : 1;
    }
    assert.ok(refused > 40, String(refused));
    assert.equal(readTexture(good[0]).format, "BC5");
  });

  it("reads the KTX2 of a model", { skip: (!shared && "no ../shared here") || (!zstddec && "three is not installed") }, async () => {
    const decoder = new zstddec.ZSTDDecoder();
    await decoder.init();
    const path = join(shared, "models/khronos/AnisotropyBarnLamp/AnisotropyBarnLamp_normalbump.ktx2");
    const read = readTexture(readFileSync(path), { unzstd: (data, size) => decoder.decode(data, size) });
    assert.deepEqual([read.format, read.layout, read.numbers], ["R8G8B8", null, "uint8"]);
  });
});
