// SPDX-License-Identifier: MIT
// Numbers and texts in files that a module with 32-bit addresses could misread: the module must reject what the tool,
// which counts in 64 bits, rejects, and read what it reads.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { describe, it } from "node:test";
import { check, generate, identify, inspect, ready, TspaceError } from "tspace/gltf";
import { gridModel } from "./models.mjs";
import { npmCodecs, ofTool, plain, tool } from "./tool.mjs";

await ready;
const codecs = await npmCodecs();

/** Returns the JSON of a model with all kinds of counts and indices of glTF. */
function fullModel() {
  const json = JSON.parse(gridModel().model.toString());
  const [primitive] = json.meshes[0].primitives;
  primitive.mode = 4;
  primitive.targets = [{ POSITION: primitive.attributes.POSITION }];
  primitive.extensions = { KHR_materials_variants: { mappings: [{ material: 0, variants: [0] }] } };
  json.materials[0].normalTexture = { index: 0, texCoord: 0, extensions: { KHR_texture_transform: { texCoord: 0 } } };
  const normals = json.accessors[primitive.attributes.NORMAL];
  Object.assign(normals, { byteOffset: 0, sparse: {
    count: 1, indices: { bufferView: primitive.indices, byteOffset: 0, componentType: 5125 },
    values: { bufferView: primitive.attributes.NORMAL, byteOffset: 0 },
  } });
  json.bufferViews[primitive.attributes.POSITION].byteStride = 12;
  json.nodes = [{ mesh: 0 }];
  json.scenes = [{ nodes: [0] }];
  json.scene = 0;
  return json;
}

/** Returns the paths of a value's numbers, such as "/accessors/0/count", except in "min", "max" and "variants". */
function numbersIn(value, path = "") {
  return Object.entries(value).flatMap(([key, member]) => {
    if (typeof member === "number") return [`${path}/${key}`];
    return typeof member === "object" && key !== "min" && key !== "max" && key !== "variants" ? numbersIn(member, `${path}/${key}`) : [];
  });
}
/** Returns the text of fullModel() with spell(number) instead of the number at this path. */
function withNumber(path, spell) {
  const json = fullModel();
  const keys = path.slice(1).split("/"), last = keys.pop();
  const parent = keys.reduce((value, key) => value[key], json);
  const number = BigInt(parent[last]);
  parent[last] = "@";
  return Buffer.from(JSON.stringify(json).replace('"@"', spell(number)));
}

const ways = {
  "2^32 more": (number) => String(number + 2n ** 32n),
  "2^32 more, as a real number": (number) => `${number + 2n ** 32n}.0`,
  "2^35 more": (number) => String(number + 2n ** 35n),
  "2^63 more": (number) => String(number + 2n ** 63n),
};

/** Returns the report or the error code; other exceptions are rethrown. */
function verdict(call) {
  try {
    return call();
  } catch (error) {
    assert.ok(error instanceof TspaceError, error.stack);
    return { ok: false, code: error.code };
  }
}

describe("numbers beyond 32 bits", () => {
  // Data that does not affect frames is not validated: textures, images, scenes.
  const refused = numbersIn(fullModel()).filter((path) => !/normalTexture\/index|textures|mappings|\/scene|\/nodes/.test(path));

  it("are not truncated to 32 bits", () => {
    assert.equal(check(Buffer.from(JSON.stringify(fullModel()))).ok, true);
    assert.ok(refused.length > 25, refused.join(" "));
    for (const path of refused)
      for (const [way, spell] of Object.entries(ways))
        for (const call of [check, generate, identify])
          assert.ok(["invalidFile", "unsupportedFile"].includes(verdict(() => call(withNumber(path, spell))).code), `${path} with ${way}`);
  });

  it("are printed correctly in messages", () => {
    for (const [path, words] of [
      ["/meshes/0/primitives/0/attributes/POSITION", /there is no accessor 4294967296; the file has/],
      ["/accessors/0/count", /the accessor has 4294967312 elements/],
      ["/accessors/0/componentType", /the component type 4294972422 does not exist/],
      ["/meshes/0/primitives/0/mode", /the mode 4294967300 does not exist/],
      ["/buffers/0/byteLength", /byteLength.* is 4294968[0-9]+; the maximum of this build is 4294967295/],
    ])
      assert.throws(() => check(withNumber(path, ways["2^32 more"])), words);
  });

  it("have the verdict of the tool", { skip: !tool && "no tool here: build the preset release" }, () => {
    const folder = mkdtempSync(join(tmpdir(), "tspace-js-"));
    try {
      const cases = numbersIn(fullModel()).flatMap((path) => Object.values(ways).map((spell) => withNumber(path, spell)));
      const names = cases.map((text, i) => join(folder, `${String(i).padStart(4, "0")}.gltf`));
      names.forEach((name, i) => writeFileSync(name, cases[i]));
      for (const [verb, call, ...options] of [["check", (model, given) => check(model, { ...given, noImages: true }), "--no-images"], ["inspect", inspect], ["identify", identify]])
        ofTool(verb, ...options, folder).files.forEach((file, i) => {
          const wanted = file.ok ? plain(file) : { ok: false, code: file.error.code };
          const report = verdict(() => plain(call(readFileSync(file.input), { name: file.input, resources: () => undefined })));
          assert.deepEqual(report, wanted, `${verb} ${cases[i]}`);
        });
    } finally {
      rmSync(folder, { recursive: true });
    }
  });

  it("are rejected if their product overflows", { skip: !codecs && "npm's codecs are not installed" }, () => {
    const packed = generate(gridModel().model, { ...codecs, compress: "draco", all: true }).bytes;
    assert.equal(check(packed, codecs).ok, true);
    const size = new DataView(packed.buffer, packed.byteOffset).getUint32(12, true);
    const json = JSON.parse(Buffer.from(packed.buffer, packed.byteOffset + 20, size).toString());
    const data = Buffer.from(packed.subarray(20 + size + 8));
    for (const accessor of Object.values(json.meshes[0].primitives[0].attributes)) json.accessors[accessor].count = 2 ** 30;
    json.buffers[0].uri = `data:application/octet-stream;base64,${data.toString("base64")}`;
    // 2^30 elements of 12, 8 and 16 bytes: a multiple of 2^32, which is 0 in 32 bits.
    assert.throws(() => check(Buffer.from(JSON.stringify(json)), codecs), { code: "invalidFile", message: /declare [0-9]{11} bytes/ });
  });

  it("do not bypass the limit of compressed data", { skip: !codecs && "npm's codecs are not installed" }, () => {
    // Slightly more than 4 MiB of data for KHR_meshopt_compression: 1024 times as much is slightly more than 2^32.
    const noise = new Uint8Array(12 * 400_000);
    for (let i = 0, state = 1; i < noise.length; ++i) noise[i] = (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) >>> 24;
    const encoded = (rows) => codecs.meshopt.encoder.encodeGltfBuffer(rows, rows.length / 12, 12, "ATTRIBUTES", 1);
    const count = Math.ceil((2 ** 22 + 2000) / (encoded(noise).length / 400_000));
    const rows = noise.subarray(0, 12 * count), data = encoded(rows);
    assert.ok(data.length > 2 ** 22 && data.length < 2 ** 22 + 4096, String(data.length));
    const view = { buffer: 0, byteOffset: 0, byteLength: data.length, byteStride: 12, count, mode: "ATTRIBUTES" };
    const json = {
      asset: { version: "2.0" }, extensionsUsed: ["KHR_meshopt_compression"], extensionsRequired: ["KHR_meshopt_compression"],
      buffers: [{ byteLength: data.length, uri: "data.bin" }, { byteLength: rows.length, extensions: { KHR_meshopt_compression: { fallback: true } } }],
      bufferViews: [{ buffer: 1, byteLength: rows.length, byteStride: 12, extensions: { KHR_meshopt_compression: view } }],
      accessors: [{ bufferView: 0, componentType: 5126, count, type: "VEC3" }],
      meshes: [{ primitives: [{ mode: 0, attributes: { POSITION: 0 } }] }],
    };
    const { primitives } = inspect(Buffer.from(JSON.stringify(json)), { ...codecs, resources: { "data.bin": data } });
    assert.equal(primitives[0].vertices, count);
  });
});

describe("control characters", () => {
  const names = ["a\u0001b", "\u0000", "\u001f\u007f", "tab\tline\nquote\"\\", "\u0007é\u0008😀\u000b"];

  it("in names are preserved in reports", () => {
    for (const name of names) {
      const json = JSON.parse(gridModel().model.toString());
      json.meshes[0].name = json.materials[0].name = name;
      const text = Buffer.from(JSON.stringify(json));
      const { findings, ok } = check(text);
      assert.equal(ok, true);
      for (const finding of findings) assert.equal(finding.materialName, name);
      const { bytes, report } = generate(text);
      assert.equal(report.primitives[0].meshName, name);
      const size = new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true);
      const made = JSON.parse(Buffer.from(bytes.buffer, bytes.byteOffset + 20, size).toString());
      assert.equal(made.meshes[0].name, name);
      assert.equal(inspect(bytes).primitives[0].meshName, name);
      assert.equal(identify(bytes).ok, true);
    }
  });

  it("in other texts of a model are kept, or rejected with a message", () => {
    const text = gridModel().model.toString();
    for (const [from, to] of [['"normal.png"', '"a\\u0001.png"'], ['"a test"', '"a\\u0002test"'], ['"VEC3"', '"VEC\\u00033"'], ['"POSITION"', '"POS\\u0004"']]) {
      for (const call of [check, generate, identify, inspect]) {
        const got = verdict(() => call(Buffer.from(text.replace(from, to))));
        assert.ok(got.code === undefined || got.code !== "internal", JSON.stringify(got));
      }
    }
  });
});
