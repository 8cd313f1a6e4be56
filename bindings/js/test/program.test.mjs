// SPDX-License-Identifier: MIT
// The package's program beside the native tool: the same files, reports, words and exit codes over the models of ../shared.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, linkSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { after, describe, it } from "node:test";
import { expectDocument } from "./schema.mjs";
import { filesIn, shared, skip as noModels, tool } from "./tool.mjs";

const program = fileURLToPath(new URL("../node_modules/tspace/bin/tspace.js", import.meta.url));
const has = existsSync(join(program, "../tspace.wasm"));
const missing = !has && "the package has no program";
const skip = missing || noModels;
const home = mkdtempSync(join(tmpdir(), "tspace-program-"));
after(() => rmSync(home, { recursive: true }));
let folders = 0;
const newFolder = () => {
  const folder = join(home, String(++folders));
  mkdirSync(folder);
  return folder;
};

const run = (command, words, options) => {
  const { status, signal, stdout, stderr } = spawnSync(command, words, { maxBuffer: 1 << 30, ...options });
  return { status, signal, stdout, stderr };
};
const ofProgram = (words, options) => run(process.execPath, [program, ...words], options);
const ofNative = (words, options) => run(tool, words, options);

/** Without times, which differ. */
const plainText = (text) => text.toString().replace(/"seconds": ?[\d.e-]+/g, '"seconds":0').replace(/^( +time +).*$/gm, "$1");
/** Formats and parts that the native tool has and the program has not. */
const isOther = /\.(off|ply|dae|fbx|stl|3ds|exr)$/i;

/** Files below a folder by their names. */
const contentOf = (folder) => Object.fromEntries(filesIn(folder, /./).map((file) => [relative(folder, file), readFileSync(file)]));

/** Both run in folders of their own; what they print and write is the same. Returns the program's run. */
function compare(words, { prepare = () => {}, input, plain = plainText } = {}) {
  const [mine, other] = [ofProgram, ofNative].map((its) => {
    const cwd = newFolder();
    prepare(cwd);
    return { ...its(words, { cwd, input }), files: contentOf(cwd) };
  });
  const what = words.join(" ");
  assert.equal(mine.status, other.status, `${what}: ${mine.stderr}`);
  assert.equal(plain(mine.stdout), plain(other.stdout), what);
  assert.equal(plain(mine.stderr), plain(other.stderr), what);
  assert.deepEqual(Object.keys(mine.files), Object.keys(other.files), what);
  for (const [name, bytes] of Object.entries(mine.files)) {
    const isText = /\.(json|sarif|jsonl|html)$/.test(name);
    if (isText) assert.equal(plain(bytes), plain(other.files[name]), `${what}: ${name}`);
    else assert.ok(bytes.equals(other.files[name]), `${what}: ${name}`);
  }
  return mine;
}

const modelsOf = (folder) => filesIn(join(shared, folder), /\.(glb|gltf|obj|vrm)$/i);
const helmet = () => join(shared, "models/khronos/FlightHelmet/FlightHelmet.gltf");

describe("the program beside the native tool", { skip }, () => {
  for (const folder of ["models", "bad", "reports"]) {
    const gone = !existsSync(join(shared ?? "", folder)) && `no ../shared/${folder} here`;
    const all = () => filesIn(join(shared, folder), /\.(glb|gltf|obj|vrm)$/i);
    for (const verb of ["check", "identify", "inspect"]) {
      it(`${verb} says the same of ${folder}`, { skip: gone }, () => {
        const mine = compare([verb, ...all(), "--json"]);
        expectDocument(JSON.parse(mine.stdout));
      });
    }
    it(`generate makes the same of ${folder}`, { skip: gone }, () => {
      for (const options of [["--all", "--overwrite"], ["--repair", "--mend-maps"]]) compare(["generate", join(shared, folder), "-o", "out", ...options, "--json"], { plain: withoutOthers });
    });
  }
  /** Models of formats that only the native tool lists are left out of its report. */
  const withoutOthers = (text) => plainText(text);

  it("texts, SARIF and pages are the same", () => {
    const model = helmet();
    for (const words of [["check", model], ["check", model, "--sarif", "report.sarif"], ["check", model, "--html", "page.html"], ["inspect", model],
      ["identify", model], ["generate", model, "-o", "out.glb", "--all", "--overwrite"], ["diff", model, model]]) compare(words);
  });
});
