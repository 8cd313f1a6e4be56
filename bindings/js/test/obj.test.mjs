// SPDX-License-Identifier: MIT
// OBJ in "tspace/gltf": materials provided by the caller; bytes and reports equal to the tool's.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { describe, it } from "node:test";
import { check, generate, identify, inspect, ready, TspaceError } from "tspace/gltf";
import { besideOf, filesIn, hasModels, ofTool, plain, shared, skip } from "./tool.mjs";

await ready;

const text = (lines) => new TextEncoder().encode(lines.join("\n"));
const obj = text([
  "mtllib materials/one.mtl", "v 0 0 0", "v 1 0 0", "v 1 1 0", "v 0 1 0.25", "vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1", "s 1",
  "usemtl bumpy", "f 1/1 2/2 3/3 4/4", "",
]);
const mtl = text(["newmtl bumpy", "norm -bm 1 normal.png", "Kd 0.5 0.5 0.5", ""]);
const options = { name: "quad.obj", resources: { "materials/one.mtl": mtl } };

const jsonOf = (glb) => JSON.parse(Buffer.from(glb.buffer, glb.byteOffset + 20, new DataView(glb.buffer, glb.byteOffset).getUint32(12, true)).toString());

describe("OBJ in memory", () => {
  it("becomes glTF with its materials", () => {
    const { bytes, report } = generate(obj, options);
    assert.equal(report.primitives[0].action, "generated");
    assert.match(report.primitives[0].reason, /normal\.png/);
    assert.ok("TANGENT" in jsonOf(bytes).meshes[0].primitives[0].attributes);
    assert.equal(jsonOf(bytes).materials[0].name, "bumpy");
    assert.equal(inspect(obj, options).format, "obj");
    assert.equal(check(obj, options).ok, true);
    assert.equal(identify(obj, options).ok, true);
    assert.equal(generate(obj, { ...options, resources: {} }).report.primitives[0].action, "notNeeded");
  });

  it("is recognized by its name, and rejected with a location if it is malformed", () => {
    assert.throws(() => check(obj), { code: "invalidFile" });
    const broken = (line) => () => check(text(["v 0 0 0", "vt 0 0", line, ""]), { name: "a.OBJ" });
    assert.throws(broken("f 1 2 3"), (error) => error instanceof TspaceError && /vertex 2, but the number of vertices is 1/.test(error.message) && /line 3/.test(error.message));
    assert.throws(broken("f -2 1 1"), /a relative index/);
    assert.throws(broken("# nothing"), /no faces/);
    assert.equal(generate(obj, options).report.ok, true);
  });

  it("of the shared data gets the tool's bytes and reports", { skip }, () => {
    const paths = hasModels ? filesIn(shared, /\.obj$/).filter((path) => /models|bad/.test(path) && statSync(path).size < 400e3) : [];
    const folder = mkdtempSync(join(tmpdir(), "tspace-js-"));
    try {
      for (const [verb, call] of [["check", check], ["inspect", inspect]]) {
        ofTool(verb, ...(verb === "check" ? ["--no-images"] : []), ...paths).files.forEach((file, i) => {
          const ask = () => call(readFileSync(paths[i]), { name: paths[i], resources: besideOf(paths[i]), ...(verb === "check" && { noImages: true }) });
          if (file.ok) assert.deepEqual(plain(ask()), plain(file), paths[i]);
          else assert.throws(ask, { code: file.error.code }, paths[i]);
        });
      }
      paths.forEach((path, i) => {
        const out = join(folder, `${i}-${basename(path, ".obj")}.glb`);
        ofTool("generate", path, "-o", out, "--all");
        const make = () => generate(readFileSync(path), { name: path, resources: besideOf(path), all: true });
        if (existsSync(out)) assert.ok(Buffer.compare(make().bytes, readFileSync(out)) === 0, path);
        else assert.throws(make, TspaceError, path);
      });
      assert.ok(paths.length > 15, String(paths.length));
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
});
