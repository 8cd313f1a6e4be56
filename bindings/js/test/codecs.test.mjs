// SPDX-License-Identifier: MIT
// Models compressed with meshopt and Draco, and normal maps, with codecs from npm.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { describe, it } from "node:test";
import { check, decodeImages, diff, generate, identify, inspect, ready, TspaceError } from "tspace/gltf";
import { gridModel } from "./models.mjs";
import { besideOf, filesIn, hasModels, npmCodecs, ofTool, plain, shared, skip } from "./tool.mjs";

await ready;
const [codecs, pngjs] = await Promise.all([npmCodecs(), import("pngjs").catch(() => null)]);
const missing = !(codecs && pngjs) && "meshoptimizer, draco3d or pngjs is not installed";
const { meshopt, draco } = codecs ?? {};
const decodePng = (bytes) => {
  const { width, height, data } = pngjs.PNG.sync.read(Buffer.from(bytes), { skipRescale: true });
  return { width, height, rgba: data };
};
const encodePng = ({ width, height, channels, bits, data }) => {
  const colorType = channels === 4 ? 6 : 2;
  const image = new pngjs.PNG({ width, height });
  image.data = data;
  return pngjs.PNG.sync.write(image, { colorType, inputColorType: colorType, bitDepth: bits, inputHasAlpha: channels === 4 });
};

const jsonOf = (glb) => JSON.parse(Buffer.from(glb.buffer, glb.byteOffset + 20, new DataView(glb.buffer, glb.byteOffset).getUint32(12, true)).toString());
/** Checks that body() throws a TspaceError with this code and all words in its message. */
const refuses = (code, words, body) =>
  assert.throws(body, (error) => {
    assert.ok(error instanceof TspaceError, String(error.stack));
    assert.equal(error.code, code, error.message);
    for (const word of words) assert.match(error.message, word);
    return true;
  });

const compressed = hasModels
  ? filesIn(join(shared, "models"), /(draco|meshopt|DenseSphere)[^/]*\.(glb|gltf)$/i).filter((path) => statSync(path).size < 1.45e6 && !path.includes("/perf/"))
  : [];

describe("compressed models", { skip: skip || missing }, () => {
  const optionsOf = (name) => ({ name, resources: besideOf(name), meshopt, draco });

  for (const [verb, call] of [["check", check], ["inspect", inspect], ["identify", identify]]) {
    it(`are ${verb}ed as by the tool`, () => {
      const paths = verb === "identify" ? compressed.filter((path) => statSync(path).size < 60e3) : compressed;
      const wanted = ofTool(verb, ...(verb === "check" ? ["--no-images"] : []), ...paths).files;
      wanted.forEach((file, i) => {
        assert.equal(file.ok, true, paths[i]);
        const report = call(readFileSync(paths[i]), { ...optionsOf(paths[i]), ...(verb === "check" && { noImages: true }) });
        assert.deepEqual(plain(report), plain(file), paths[i]);
      });
      assert.ok(paths.length > 5, String(paths.length));
    });
  }

  it("get the tangents of the tool, and stay compressed", () => {
    const folder = mkdtempSync(join(tmpdir(), "tspace-js-"));
    try {
      for (const name of compressed) {
        const out = join(folder, `${basename(name).replace(/\.[^.]*$/, "")}.glb`);
        const [report] = ofTool("generate", name, "-o", out, "--overwrite", "--all").files;
        const made = generate(readFileSync(name), { ...optionsOf(name), overwrite: true, all: true });
        assert.deepEqual(made.report.primitives, report.primitives, name);
        const wanted = readFileSync(out);
        const difference = diff(made.bytes, wanted, { meshopt, draco, tolerance: 0 });
        assert.equal(difference.exitCode, 0, `${name}: ${JSON.stringify(difference).slice(0, 500)}`);
        assert.deepEqual(jsonOf(made.bytes).extensionsUsed, jsonOf(wanted).extensionsUsed, name);
        assert.deepEqual(plain(inspect(made.bytes, { meshopt, draco })).primitives, plain(inspect(wanted, { meshopt, draco })).primitives);
      }
    } finally {
      rmSync(folder, { recursive: true });
    }
  });

  it("are decompressed on request, which needs no encoder", () => {
    for (const name of compressed.filter((path) => statSync(path).size < 60e3)) {
      const decoders = { meshopt: { decoder: meshopt.decoder }, draco: { decoder: draco.decoder } };
      const { bytes } = generate(readFileSync(name), { ...optionsOf(name), ...decoders, all: true, compress: "none" });
      assert.equal(inspect(bytes).primitives.every(({ compression }) => compression === "none"), true, name);
      const packed = generate(bytes, { meshopt, draco, compress: /draco/i.test(name) ? "draco" : "meshopt" });
      assert.ok(packed.report.changed, name);
    }
  });

  it("are rejected with a message if the codec or a part of it is missing", () => {
    const plainModel = gridModel().model;
    for (const [option, codec] of [["meshopt", meshopt], ["draco", draco]]) {
      const packed = generate(plainModel, { [option]: codec, compress: option }).bytes;
      const call = (given) => () => generate(packed, { overwrite: true, method: "flat", ...given });
      refuses("unsupportedFile", [new RegExp(`option ${option}`)], call({}));
      refuses("unsupportedFile", [/no encoder/, /compress/], call({ [option]: { decoder: codec.decoder } }));
      refuses("unsupportedFile", [/no encoder/], () => generate(plainModel, { [option]: { decoder: codec.decoder }, compress: option }));
      refuses("wrongType", [/decoder/, /npm/], call({ [option]: { encoder: codec.encoder } }));
      refuses("wrongType", [/decoder/, /npm/], call({ [option]: { decoder: {} } }));
      refuses("wrongType", [/encoder/, /npm/], call({ [option]: { decoder: codec.decoder, encoder: {} } }));
      refuses("wrongType", [new RegExp(option)], call({ [option]: 5 }));
      assert.equal(call({ [option]: codec })().report.primitives[0].action, "replaced");
    }
  });

  it("give a report or an error if they are corrupt", () => {
    let refused = 0;
    for (const name of compressed.filter((path) => /\.glb$/.test(path) && statSync(path).size < 30e3)) {
      const model = readFileSync(name);
      const begin = 20 + model.readUInt32LE(12) + 8;
      for (let i = 0; i < 60; ++i) {
        const broken = Uint8Array.from(model);
        broken[begin + ((i * 7919) % (model.length - begin))] ^= 1 << i % 8;
        try {
          check(broken, optionsOf(name));
        } catch (error) {
          assert.ok(error instanceof TspaceError && error.code !== "internal", `${name}: ${error.stack}`);
          refused += 1;
        }
      }
      assert.equal(check(model, optionsOf(name)).ok, true);
    }
    assert.ok(refused > 0);
  });
});

/** Returns a model with this PNG as its normal map. */
const withMap = (png) => gridModel({ image: `data:image/png;base64,${Buffer.from(png).toString("base64")}` }).model;

/** Returns a normal map of domes in a grid, with green up or down. */
function domes({ size = 128, bits = 8, channels = 3, isDown = false } = {}) {
  const top = 2 ** bits - 1;
  const data = new (bits === 16 ? Uint16Array : Uint8Array)(channels * size * size);
  const toNumber = (x) => Math.round(((x + 1) / 2) * top);
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const [u, v] = [((x % 32) - 15.5) / 20, ((y % 32) - 15.5) / 20];
      const green = isDown ? v : -v;
      data.set([toNumber(u), toNumber(green), toNumber(Math.sqrt(Math.max(0, 1 - u * u - v * v))), top].slice(0, channels), channels * (y * size + x));
    }
  return encodePng({ width: size, height: size, channels, bits, data });
}

describe("normal maps", { skip: missing }, () => {
  const codes = (model, options) => check(model, options).findings.map(({ code }) => code).filter((code) => /green|Unreadable/.test(code));

  it("are examined if decodeImage is given", () => {
    assert.deepEqual(codes(withMap(domes()), { decodeImage: decodePng }), []);
    assert.deepEqual(codes(withMap(domes({ isDown: true })), { decodeImage: decodePng }), ["greenFlipped"]);
    assert.deepEqual(codes(withMap(domes({ bits: 16, isDown: true })), { decodeImage: decodePng }), ["greenFlipped"]);
    assert.deepEqual(codes(withMap(domes()), {}), ["normalMapUnreadable"]);
  });

  it("are examined with asynchronous decoders before the call", async () => {
    const model = withMap(domes({ isDown: true }));
    const asked = [];
    const decodeImage = await decodeImages(model, async (bytes, mimeType) => {
      asked.push(mimeType);
      return decodePng(bytes);
    });
    assert.deepEqual(asked, ["image/png"]);
    assert.deepEqual(codes(model, { decodeImage }), ["greenFlipped"]);
    const failing = await decodeImages(model, () => Promise.reject(new Error("no such thing")));
    const [note] = check(model, { decodeImage: failing }).findings.filter(({ code }) => code === "normalMapUnreadable");
    assert.match(note.message, /no such thing/);
    await assert.rejects(decodeImages(new Uint8Array(3), decodePng), TspaceError);
    await assert.rejects(decodeImages(model, 5), TspaceError);
    refuses("wrongType", [/Promise/, /decodeImages/], () => check(model, { decodeImage: async () => undefined }));
  });

  it("are inverted without loss if green points down", async () => {
    for (const bits of [8, 16])
      for (const channels of [3, 4]) {
        const model = withMap(domes({ bits, channels, isDown: true }));
        const { bytes, report } = generate(model, { flipGreen: true, decodeImage: decodePng, encodeImage: encodePng });
        assert.deepEqual(report.normalMaps.map(({ flipped }) => flipped), [true], JSON.stringify(report.normalMaps));
        const pixels = [];
        await decodeImages(bytes, (png) => pixels.push(decodePng(png)));
        assert.deepEqual(pixels, [decodePng(domes({ bits, channels }))]);
        assert.deepEqual(codes(bytes, { decodeImage: decodePng }), []);
      }
    const up = generate(withMap(domes()), { flipGreen: true, decodeImage: decodePng, encodeImage: encodePng });
    assert.match(up.report.normalMaps[0].reason, /up already/);
  });

  it("are kept, with a reason in the report, if the caller's functions fail", () => {
    const model = withMap(domes({ bits: 16, isDown: true }));
    const why = (options) => generate(model, { flipGreenAll: true, decodeImage: decodePng, encodeImage: encodePng, ...options }).report.normalMaps[0].reason;
    const eight = (bytes) => ({ ...decodePng(bytes), rgba: Uint8Array.from(decodePng(bytes).rgba, (x) => x >> 8) });
    assert.match(why({ decodeImage: eight }), /16 bits/);
    assert.match(why({ encodeImage: undefined }), /encodeImage/);
    assert.match(why({ decodeImage: undefined }), /decodeImage/);
    assert.match(why({ encodeImage: () => domes({ size: 64, bits: 16 }) }), /differ from its input/);
    assert.match(why({ encodeImage: () => domes({ bits: 16, channels: 4 }) }), /channels/);
    assert.match(why({ encodeImage: () => new Uint8Array(9) }), /did not return a PNG/);
    assert.match(why({ decodeImage: () => null }), /no pixels/);
    assert.match(why({ decodeImage: () => ({ width: 1, height: 1, rgba: new Uint8Array(4) }) }), /1 x 1/);
    refuses("wrongType", [/rgba/], () => why({ decodeImage: () => ({ width: 128, height: 128 }) }));
    refuses("countMismatch", [/pixels/], () => why({ decodeImage: () => ({ width: 128, height: 128, rgba: new Uint8Array(3) }) }));
    refuses("wrongType", [/encodeImage/], () => why({ encodeImage: () => "text" }));
    refuses("wrongType", [/decodeImage/], () => why({ decodeImage: "png" }));
  });

  it("of shared models get the tool's verdicts", { skip }, () => {
    const paths = filesIn(join(shared, "models"), /\.(glb|gltf)$/).filter((path) => (statSync(path).size < 300e3 || /Lantern|Sneaker|BoomBoxWithAxes_/.test(path)) && /(assets|derived|features|khronos|asset-generator.M)/.test(path));
    const wanted = ofTool("check", ...paths).files;
    let compared = 0;
    wanted.forEach((file, i) => {
      if (!file.ok) return;
      let all = true;
      const decodeImage = (bytes, mimeType) => {
        all &&= mimeType === "image/png";
        return all ? decodePng(bytes) : undefined;
      };
      let report;
      try {
        report = check(readFileSync(paths[i]), { name: paths[i], resources: besideOf(paths[i]), meshopt, draco, decodeImage });
      } catch (error) {
        assert.fail(`${paths[i]}: ${error.stack}`);
      }
      if (!all || !(report.normalMaps > 0)) return;
      assert.deepEqual(plain(report), plain(file), paths[i]);
      compared += 1;
    });
    assert.ok(compared > 5, String(compared));
  });
});
