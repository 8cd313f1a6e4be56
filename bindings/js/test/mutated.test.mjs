// SPDX-License-Identifier: MIT
// Compares the package with the tool on small models of ../shared/models and ../shared/bad with random changes:
// verdicts, error codes, findings and outputs must be equal; no trap occurs, and no call breaks the next one. The files
// are the same in each run, unless TSPACE_SEED is set; TSPACE_CHANGED is their number.
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, extname, join } from "node:path";
import { after, before, describe, it } from "node:test";
import { check, generate, identify, ready, TspaceError } from "tspace/gltf";
import { besideOf, filesIn, hasModels, ofTool, plain, shared, skip } from "./tool.mjs";

await ready;

let state = Number(process.env.TSPACE_SEED ?? 1);
/** Returns a random integer below `limit` (xorshift32). */
function below(limit) {
  state ^= state << 13;
  state ^= state >>> 17;
  state ^= state << 5;
  return (state >>> 0) % Math.max(limit, 1);
}

const telling = [0, 1, 2, 0x7f, 0x80, 0xff, ..."09-\"[{,\n.e"].map((one) => (typeof one === "string" ? one.charCodeAt(0) : one));
/** Returns the bytes with one or two changes. */
function changed(bytes) {
  let result = Uint8Array.from(bytes);
  for (let n = 1 + below(2); n > 0 && result.length > 0; --n) {
    const at = below(result.length);
    const kind = below(5);
    if (kind === 0) result[at] ^= 1 << below(8);
    if (kind === 1) result[at] = telling[below(telling.length)];
    if (kind === 2) result = Uint8Array.from([...result.subarray(0, at), ...result.subarray(at + 1 + below(16))]);
    if (kind === 3) result = Uint8Array.from([...result.subarray(0, at), ...result.subarray(at, at + below(32)), ...result.subarray(at)]);
    if (kind === 4 && below(4) === 0) result = result.subarray(0, at);
  }
  return result;
}

/** Returns whether a file is small and needs no other file and no codec. */
const isAlone = (name) =>
  statSync(name).size < 12e3 && !/"uri" *: *"(?!data:)[^"]*\.bin"|meshopt|draco/.test(readFileSync(name, "latin1"));

/** Returns the tool's report on a file, or its error code. */
const ofFile = (file) => (file.ok ? plain(file) : { ok: false, code: file.error.code });
function ofPackage(call, path) {
  try {
    return plain(call(readFileSync(path), { name: basename(path), resources: besideOf(path) }));
  } catch (error) {
    assert.ok(error instanceof TspaceError, `${path}: ${error.stack}`);
    return { ok: false, code: error.code };
  }
}

describe("files with random changes", { skip: skip || (!hasModels && "no ../shared/models here") }, () => {
  const count = Number(process.env.TSPACE_CHANGED ?? 400);
  let folder, failed = false;

  before(() => {
    folder = mkdtempSync(join(tmpdir(), "tspace-changed-"));
    const seeds = ["models", "bad"].flatMap((part) => filesIn(join(shared, part), /\.(glb|gltf|obj)$/)).filter(isAlone);
    assert.ok(seeds.length > 50, `${seeds.length} seeds`);
    for (let i = 0; i < count; ++i) {
      const seed = seeds[below(seeds.length)];
      writeFileSync(join(folder, `${String(i).padStart(5, "0")}${extname(seed)}`), changed(readFileSync(seed)));
    }
  });
  after(() => {
    // Keeps files that failed.
    if (failed) cpSync(folder, "changed", { recursive: true });
    rmSync(folder, { recursive: true });
  });

  /** Calls compare(path, the tool's entry) for each file. */
  function compareAll(verb, options, compare) {
    const { files } = ofTool(verb, folder, ...options);
    assert.equal(files.length, count);
    let sound = 0;
    failed = true;
    for (const file of files) {
      sound += file.ok ? 1 : 0;
      compare(file.input, file);
    }
    failed = false;
    assert.ok(sound > count / 10 && sound < count, `${sound} of ${count} are sound, so one side is not tried`);
  }

  it("have the findings of the tool", () => {
    compareAll("check", ["--no-images"], (path, file) =>
      assert.deepEqual(ofPackage((model, options) => check(model, { ...options, noImages: true }), path), ofFile(file), path));
  });

  it("have the tool's methods", () => {
    compareAll("identify", [], (path, file) => assert.deepEqual(ofPackage(identify, path), ofFile(file), path));
  });

  it("give the outputs of the tool", () => {
    const out = join(folder, "out");
    compareAll("generate", ["-o", out, "--container", "glb", "--all", "--overwrite"], (path, file) => {
      let made;
      const report = ofPackage((model, options) => {
        made = generate(model, { ...options, all: true, overwrite: true });
        return made.report;
      }, path);
      assert.equal(report.ok, file.ok, `${path}: ${JSON.stringify(file.error ?? report)}`);
      if (!file.ok) return assert.equal(report.code, file.error.code, path);
      assert.deepEqual(report.primitives, file.primitives, path);
      // Only the tool copies referenced files to the output folder. If warnings or maps differ for that reason, bytes
      // are not compared.
      if (report.warnings?.length === file.warnings?.length && report.normalMaps?.length === file.normalMaps?.length)
        assert.ok(Buffer.compare(made.bytes, readFileSync(file.output)) === 0, path);
    });
  });
});
