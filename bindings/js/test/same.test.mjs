// SPDX-License-Identifier: MIT
// Compares the package with the tool for every file of ../shared/bad, ../shared/reports and small files of
// ../shared/models: equal verdicts, error codes, findings with counts, and outputs.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { describe, it } from "node:test";
import { check, generate, identify, ready, TspaceError } from "tspace/gltf";
import { besideOf, filesIn, npmCodecs, ofTool, plain, shared, skip } from "./tool.mjs";

await ready;
const codecs = await npmCodecs();

// Intended differences:
/** The tool reads other formats with tspace-import; the package rejects them. */
const isOther = /\.(off|ply|dae)$/;
/** Compressed models: npm's encoders have other versions than the tool's, so output bytes differ. Without npm's codecs,
 * these models are not compared. */
const isCompressed = /draco|meshopt|DenseSphere/i;
/** The package returns bytes, while the tool also copies the files of a model and adapts their URIs. */
const leavesFilesBeside = ({ warnings }) => warnings?.some((warning) => warning.endsWith("that the model references was not copied to the output"));

/** The tool searches for a file, while the package requests it from the caller. */
const isLeftOut = (warning) => warning.startsWith("a texture was ignored");
function withoutPlaces(report) {
  const shorten = (text) => text.replace(/ \(at [^()]*\)$/, "");
  for (const finding of report.findings ?? [])
    if (finding.code === "fileRemark") for (const text of ["message", "cause"]) finding[text] = shorten(finding[text]);
  if (report.warnings) report.warnings = report.warnings.map(shorten);
  return report;
}

const isCompared = (name) => statSync(name).size < 300e3 && !isOther.test(name) && (codecs || !isCompressed.test(name));

/** Returns the tool's report or error code. */
const ofFile = (file) => (file.ok ? plain(file) : { ok: false, code: file.error.code });
/** Returns the package's report or error code, without the locations at the end of notes and warnings about images. */
function ofPackage(call, name) {
  try {
    return withoutPlaces(plain(call(readFileSync(name), { name, resources: besideOf(name), ...codecs })));
  } catch (error) {
    assert.ok(error instanceof TspaceError, `${name}: ${error.stack}`);
    return { ok: false, code: error.code };
  }
}

describe("compared with the tool", { skip }, () => {
  for (const [folder, least] of [["bad", 400], ["reports", 35], ["models", 100]]) {
    const path = shared && join(shared, folder);
    const missing = !(path && existsSync(path)) && `no ../shared/${folder} here`;

    /** Calls compare(name, the tool's entry) for each compared file. */
    function compareAll(verb, options, compare) {
      const files = ofTool(verb, path, ...options).files.filter(({ input }) => isCompared(input));
      for (const file of files) compare(file.input, file);
      assert.ok(files.length >= least, `${files.length} files are compared`);
    }

    it(`check gives the same report on ${folder}`, { skip: missing }, () => {
      const call = (model, options) => check(model, { ...options, noImages: true });
      compareAll("check", ["--no-images"], (name, file) => assert.deepEqual(ofPackage(call, name), ofFile(file), name));
    });

    it(`identify gives the same report on ${folder}`, { skip: missing }, () => {
      compareAll("identify", [], (name, file) => assert.deepEqual(ofPackage(identify, name), ofFile(file), name));
    });

    it(`generate gives the same output for ${folder}`, { skip: missing }, () => {
      const out = mkdtempSync(join(tmpdir(), "tspace-js-"));
      try {
        compareAll("generate", ["-o", out, "--container", "glb", "--overwrite"], (name, file) => {
          let bytes;
          const report = ofPackage((model, options) => {
            const made = generate(model, { ...options, overwrite: true });
            bytes = made.bytes;
            return made.report;
          }, name);
          const wanted = ofFile(file);
          // No images are decoded here: green is not checked, and OBJ height maps are not converted to normal maps.
          if (report.ok) report.warnings = report.warnings.filter((text) => !text.includes("it is unknown whether green"));
          for (const side of [report, wanted]) if (side.ok) side.warnings = side.warnings.filter((text) => !isLeftOut(text));
          const makesMaps = wanted.ok && wanted.normalMaps.length !== report.normalMaps?.length;
          if (isCompressed.test(name) || leavesFilesBeside(report) || makesMaps) {
            assert.equal(report.ok, wanted.ok, name);
            assert.deepEqual(report.primitives, wanted.primitives, name);
            return;
          }
          assert.deepEqual(report, wanted, name);
          if (file.ok) assert.ok(Buffer.compare(bytes, readFileSync(file.output)) === 0, name);
        });
      } finally {
        rmSync(out, { recursive: true });
      }
    });

    it(`other formats of ${folder} are rejected with a message`, { skip: missing }, () => {
      for (const name of filesIn(path, isOther)) assert.deepEqual(ofPackage(check, name), { ok: false, code: "invalidFile" }, name);
    });
  }
});
