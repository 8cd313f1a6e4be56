// SPDX-License-Identifier: MIT
// The entry "tspace/gltf": generated models, models of ../shared compared with the tool, and corrupt models.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { describe, it } from "node:test";
import { check, diff, generate, identify, inspect, ready, TspaceError } from "tspace/gltf";
import { gridModel } from "./models.mjs";
import { expectReport, hasSchemas } from "./schema.mjs";
import { besideOf, filesIn, hasModels, ofTool, plain, shared, skip } from "./tool.mjs";

await ready;

const { model } = gridModel();
const good = generate(model);

/** Returns the JSON of a .glb. */
const jsonOf = (glb) => JSON.parse(Buffer.from(glb.buffer, glb.byteOffset + 20, new DataView(glb.buffer, glb.byteOffset).getUint32(12, true)).toString());

/** Checks that body() throws a TspaceError with this code and a message of one line with all words, and that the module works afterwards. */
function refuses(code, words, body) {
  assert.throws(body, (error) => {
    assert.ok(error instanceof TspaceError, String(error.stack));
    assert.equal(error.code, code, error.message);
    assert.match(error.message, /^[^\n]+$/);
    for (const word of words) assert.match(error.message, word);
    return true;
  });
  assert.deepEqual(generate(model).bytes, good.bytes);
}

describe("models in memory", () => {
  it("have reports as docs/schema says", { skip: !hasSchemas && "no docs/schema here" }, () => {
    const turned = generate(model, { convention: "opengl", pack: "frame32", morphNormals: "all" });
    expectReport("generate", turned.report);
    expectReport("generate", generate(good.bytes).report);
    expectReport("check", check(turned.bytes));
    expectReport("inspect", inspect(turned.bytes));
    expectReport("identify", identify(turned.bytes));
    expectReport("diff", diff(good.bytes, turned.bytes));
    assert.throws(() => expectReport("check", { ...check(good.bytes), color: "red" }), /color/);
    assert.throws(() => expectReport("check", { ...check(good.bytes), findings: undefined }), /findings/);
  });

  it("get referenced files from an object, a Map or a function", () => {
    const { model: named, buffer } = gridModel({ uri: "data/a%20grid.bin" });
    const path = "data/a grid.bin";
    const asked = [];
    const ways = [{ [path]: buffer }, new Map([[path, buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.length)]]), (name) => {
      asked.push(name);
      return name === path ? buffer : undefined;
    }];
    for (const resources of ways) {
      const { bytes } = generate(named, { resources });
      assert.deepEqual(jsonOf(bytes).meshes, jsonOf(good.bytes).meshes);
      assert.equal(check(named, { resources }).exitCode, check(model).exitCode);
    }
    assert.deepEqual([...new Set(asked)].sort(), [path, "normal.png"]);
    refuses("invalidFile", [/a grid\.bin/], () => generate(named));
    refuses("invalidFile", [/a grid\.bin/, /not provided/], () => generate(named, { resources: {} }));
    assert.throws(() => generate(named, { resources: () => { throw new RangeError("mine"); } }), RangeError);
    refuses("wrongType", [/a grid\.bin/, /not "text"/], () => check(named, { resources: { [path]: "text" } }));
    refuses("wrongType", [/resources/], () => check(named, { resources: 5 }));
    refuses("invalidOption", [/must not call/], () => check(named, { resources: () => check(model) }));
  });

  it("are rejected with a message if the call is invalid", () => {
    refuses("wrongType", [/model must be a Uint8Array or an ArrayBuffer, not "model.glb"/], () => check("model.glb"));
    refuses("wrongType", [/model must be .* not undefined/], () => check());
    refuses("wrongType", [/options/], () => check(model, "all"));
    refuses("wrongType", [/ignore/], () => check(model, { ignore: [{}] }));
    refuses("wrongType", [/name/], () => check(model, { name: 5 }));
    refuses("wrongType", [/threshold/, /NaN/], () => generate(model, { threshold: NaN }));
    for (const call of [generate, check, inspect, identify, (a, options) => diff(a, a, options)])
      assert.throws(() => call(model, { treshold: 90 }), (error) =>
        error instanceof TypeError && error instanceof TspaceError && /options\.treshold is unknown; .*memoryLimit/.test(error.message));
    refuses("invalidOption", [/methods/, /method/], () => generate(model, { methods: "best" }));
    refuses("invalidOption", [/method/, /mikktspace/], () => generate(model, { method: "mikkt" }));
    refuses("invalidFile", [/./], () => check(new Uint8Array(0)));
    for (const [call, given, words] of [
      [generate, { memoryLimit: "3K" }, /^memoryLimit 3K: /], [generate, { crease: 400 }, /^crease 400: /],
      [generate, { packDrop: "all" }, /^packDrop needs pack$/], [generate, { repair: true, overwrite: true }, /^repair and overwrite cannot be used together$/],
      [generate, { weldDistance: -1 }, /^weldDistance -1: .*auto/], [generate, { morphNormals: "some" }, /^morphNormals some: /],
      [check, { angle: 900 }, /^angle 900: /], [check, { failOn: "never" }, /^failOn never: /],
      [(data, options) => diff(data, data, options), { worst: -1 }, /^worst -1: /],
    ]) {
      assert.throws(() => call(model, given), (error) => {
        assert.equal(error.code, "invalidOption", error.message);
        assert.match(error.message, words);
        assert.doesNotMatch(error.message, /--/);
        return true;
      });
    }
    // Words in quotes are the caller's, such as paths.
    const { model: other } = gridModel({ uri: "x%20--weld-distance's.bin" });
    refuses("invalidFile", [/'x --weld-distance's\.bin'/], () => generate(other, { resources: {} }));
    refuses("invalidFile", [/JSON/], () => check(Buffer.from("{")));
    const gone = Uint8Array.from(model);
    structuredClone(gone.buffer, { transfer: [gone.buffer] });
    refuses("detached", [/model/], () => check(gone));
  });

  it("accept the options of their types and of the module", () => {
    const types = ["gltf", "file_options"].map((name) => readFileSync(new URL(`../node_modules/tspace/src/${name}.d.ts`, import.meta.url), "utf8")).join("");
    const membersOf = (name) => {
      const [, parents = "", body = ""] = types.match(new RegExp(`interface ${name}(?: extends (.*?))? \\{(?:\\n([\\s\\S]*?)\\n)?\\}`));
      const own = [...body.matchAll(/^  (\w+)\?:/gm)].map((match) => match[1]);
      return [...own, ...(parents.match(/\w+Options/g) ?? []).flatMap(membersOf)];
    };
    const calls = { Generate: generate, Check: check, Model: inspect, Identify: identify, Diff: (a, options) => diff(a, a, options) };
    for (const [name, call] of Object.entries(calls)) {
      const wanted = membersOf(`${name}Options`).filter((member) => name !== "Diff" || member !== "name").sort();
      assert.throws(() => call(model, { "": 0 }), (error) => {
        assert.deepEqual(error.message.split("known names are ")[1].split(", ").sort(), wanted, name);
        return true;
      });
      for (const option of wanted) // the module may reject a wrong value, but never as an unknown name
        try {
          call(model, { [option]: "?" });
        } catch (error) {
          assert.doesNotMatch(error.message, /unknown option/, name);
        }
    }
  });

  it("leak no memory, even if they fail", () => {
    const broken = model.subarray(0, model.length - 9);
    const round = () => {
      generate(model);
      check(good.bytes);
      assert.throws(() => check(broken), TspaceError);
    };
    for (let i = 0; i < 30; ++i) round();
    globalThis.gc?.();
    const before = process.memoryUsage().rss;
    for (let i = 0; i < 300; ++i) round();
    globalThis.gc?.();
    assert.ok(process.memoryUsage().rss - before < 200e6, `${process.memoryUsage().rss - before} bytes more`);
  });
});

describe("the tool", { skip }, () => {
  const paths = hasModels ? filesIn(join(shared, "models"), /\.(glb|gltf)$/).filter((path) => statSync(path).size < 300e3) : [];
  const missing = /the option (draco|meshopt) is missing; it must be/;

  it("has the same output of inspect", () => {
    let compared = 0;
    ofTool("inspect", ...paths).files.forEach((file, i) => {
      const name = paths[i];
      let report;
      try {
        report = inspect(readFileSync(name), { name, resources: besideOf(name) });
      } catch (error) {
        if (missing.test(error.message)) return;
        assert.equal(file.ok, false, `${name}: ${error.message}`);
        assert.equal(error.code, file.error.code);
        return;
      }
      assert.deepEqual(plain(report), plain(file), name);
      compared += 1;
    });
    assert.ok(compared > 40, String(compared));
  });

  it("generates the same bytes with further options", () => {
    const folder = mkdtempSync(join(tmpdir(), "tspace-js-"));
    try {
      let compared = 0;
      for (const [i, name] of paths.entries()) {
        const options = [{ overwrite: true }, { overwrite: true, all: true, method: "best" }, { repair: true }, {}][i % 4];
        const words = Object.entries(options).flatMap(([key, value]) => (value === true ? [`--${key}`] : [`--${key}`, value]));
        const out = join(folder, `${basename(name).replace(/\.[^.]*$/, "")}.glb`);
        const report = ofTool("generate", name, "-o", out, ...words).files?.[0] ?? ofTool("generate", name, "-o", out, ...words);
        let made;
        try {
          made = generate(readFileSync(name), { name, resources: besideOf(name), ...options });
        } catch (error) {
          if (missing.test(error.message)) continue;
          assert.equal(report.ok, false, `${name}: ${error.message}`);
          continue;
        }
        assert.ok(Buffer.compare(made.bytes, readFileSync(out)) === 0, name);
        assert.deepEqual(made.report.primitives, report.primitives, name);
        compared += 1;
      }
      assert.ok(compared > 60, String(compared));
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
});

describe("corrupt files", { skip: !(shared && existsSync(join(shared, "bad"))) && "no ../shared here" }, () => {
  it("give a report or a one-sentence error, and the module works afterwards", () => {
    let refused = 0, read = 0;
    for (const path of filesIn(join(shared, "bad"), /./)) {
      for (const call of [check, generate]) {
        try {
          call(readFileSync(path), { resources: besideOf(path) });
          read += 1;
        } catch (error) {
          assert.ok(error instanceof TspaceError && error.code !== "internal", `${path}: ${error.stack}`);
          assert.match(error.message, /^[^\n]+$/, path);
          refused += 1;
        }
      }
    }
    assert.ok(refused > 500 && read > 100, `${refused} ${read}`);
    assert.deepEqual(generate(model).bytes, good.bytes);
  });
});
