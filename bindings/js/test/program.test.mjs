// SPDX-License-Identifier: MIT
// Compares the package's program with the native tool: equal files, reports, messages and exit codes for the models of
// ../shared.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { chmodSync, copyFileSync, existsSync, linkSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { after, describe, it } from "node:test";
import { gridModel } from "./models.mjs";
import { expectDocument } from "./schema.mjs";
import { filesIn, shared, skip as noModels, tool } from "./tool.mjs";

const program = fileURLToPath(new URL("../node_modules/tspace/bin/tspace.js", import.meta.url));
const missing = !existsSync(join(program, "../tspace.wasm")) && "the package has no program";
const skip = missing || noModels;
const home = mkdtempSync(join(tmpdir(), "tspace-program-"));
after(() => rmSync(home, { recursive: true, force: true }));
let folders = 0;
function newFolder() {
  const folder = join(home, String(++folders));
  mkdirSync(folder);
  return folder;
}

// The native tool is copied to a separate folder, so that it has no importer, like the package's program.
const native = join(home, "tspace");
if (!skip) copyFileSync(tool, native);

const run = (command, words, options) => spawnSync(command, words, { maxBuffer: 1 << 30, ...options });
const ofProgram = (words, options) => run(process.execPath, [program, ...words], options);
const ofNative = (words, options) => run(native, words, options);

/** Removes run times, which differ. */
const plain = (text) => text.toString().replace(/"seconds": ?[\d.e-]+/g, '"seconds":0').replace(/^( +time +).*$/gm, "$1").replace(/, [\d.]+ s$/gm, "");
/** Returns the files below a folder by name. */
const contentOf = (folder) => Object.fromEntries(filesIn(folder, /./).map((file) => [relative(folder, file), readFileSync(file)]));

/** Runs both programs in separate folders, and compares their output and files. Returns the run of the package's program. */
function compare(words, { prepare = () => {}, input } = {}) {
  const [mine, other] = [ofProgram, ofNative].map((its) => {
    const cwd = newFolder();
    prepare(cwd);
    return { ...its(words, { cwd, input }), files: contentOf(cwd), cwd };
  });
  const what = words.length > 12 ? words.slice(0, 2).join(" ") : words.join(" ");
  assert.equal(mine.status, other.status, `${what}: ${mine.stderr}`);
  const binary = mine.stdout.subarray(0, 4).toString() === "glTF";
  if (binary) assert.ok(mine.stdout.equals(other.stdout), what);
  else assert.equal(plain(mine.stdout), plain(other.stdout), what);
  assert.equal(plain(mine.stderr), plain(other.stderr), what);
  assert.deepEqual(Object.keys(mine.files), Object.keys(other.files), what);
  for (const [name, bytes] of Object.entries(mine.files)) {
    const same = bytes.equals(other.files[name]) || (/\.(jsonl?|sarif|html)$/.test(name) && plain(bytes) === plain(other.files[name]));
    assert.ok(same, `${what}: ${name}`);
  }
  for (const { cwd } of [mine, other]) rmSync(cwd, { recursive: true, force: true });
  return mine;
}

const models = (folder, wanted = /\.(glb|gltf|obj|vrm)$/i) => filesIn(join(shared, folder), wanted);
const helmet = () => join(shared, "models/khronos/FlightHelmet/FlightHelmet.gltf");
const grid = (folder, name = "grid.gltf") => writeFileSync(join(folder, name), gridModel({ image: "data:," }).model);

describe("the program compared with the native tool", { skip }, () => {
  for (const folder of ["models", "bad", "reports"]) {
    const gone = !skip && !existsSync(join(shared, folder)) && `no ../shared/${folder} here`;
    for (const verb of ["check", "identify", "inspect"]) {
      it(`${verb} gives the same report on ${folder}`, { skip: gone }, () => {
        expectDocument(JSON.parse(compare([verb, ...models(folder), "--json"]).stdout));
      });
    }
    it(`generate gives the same output for ${folder}`, { skip: gone }, () => {
      compare(["generate", join(shared, folder), "-o", "out", "--all", "--overwrite", "--json"]);
    });
  }

  it("texts, SARIF, pages and pictures are equal", () => {
    const model = helmet();
    for (const words of [["check", model], ["check", model, "--sarif", "report.sarif"], ["check", model, "--html", "page.html"], ["inspect", model],
      ["identify", model], ["generate", model, "-o", "out.glb", "--all", "--overwrite"], ["diff", model, model], ["render", model, "-o", "picture.png"],
      ["check", "--help"], ["help", "generate"]]) compare(words);
  });

  it("maps are equal: flipped, converted, compressed, from heights", () => {
    const map = models("models", /Normal\.png$/)[0];
    for (const words of [["flip-green", map, "-o", "map.png"], ["compress-map", map, "-o", "map.ktx2"], ["height-to-normal", map, "-o", "map.png"]]) compare(words);
  });

  it("geometry is compressed and decompressed to equal bytes with meshopt and Draco", () => {
    for (const how of ["meshopt", "draco"]) {
      const made = compare(["generate", helmet(), "-o", "out.glb", "--overwrite", "--compress", how]);
      assert.equal(made.status, 0, how);
    }
  });

  it("patterns, jobs, manifests and shards give equal results", () => {
    const prepare = (folder) => {
      for (const name of ["a1.gltf", "a2.gltf", "b.gltf"]) grid(folder, name);
    };
    for (const words of [["check", "a*.gltf", "--json"], ["generate", "*.gltf", "-o", "out", "--jobs", "3"], ["generate", ".", "-o", "out", "--shard", "1/2"],
      ["inspect", "[ab]?.gltf"]]) compare(words, { prepare });
  });

  it("models are read from and written to pipes", () => {
    const { model } = gridModel({ image: "data:," });
    for (const words of [["generate", "-", "-o", "-", "--container", "glb"], ["check", "-"], ["check", "-", "--json"], ["identify", "-"]]) compare(words, { input: model });
    compare(["check", "-"], { input: "no model" });
    compare(["check", "-"], { input: "" });
  });

  it("wrong command lines and corrupt files have equal messages and exit codes", () => {
    for (const words of [[], ["generat"], ["check"], ["check", "--no"], ["check", "nowhere.glb"], ["generate", "a.glb"], ["generate", "grid.gltf", "-o", "grid.gltf"],
      ["generate", "grid.gltf", "-o", "no\0"], ["check", "."]].filter((words) => !words.some((word) => word.includes("\0")))) compare(words, { prepare: grid });
    for (const file of ["empty.glb", "folder.glb"]) {
      compare(["check", file], { prepare: (folder) => (file === "empty.glb" ? writeFileSync(join(folder, file), "") : mkdirSync(join(folder, file))) });
    }
  });

  it("no output replaces an input under any name, and links are kept", () => {
    const linked = (link) => (folder) => {
      grid(folder);
      link(join(folder, "grid.gltf"), join(folder, "other.gltf"));
    };
    compare(["generate", "grid.gltf", "-o", "other.gltf"], { prepare: linked(linkSync) });
    compare(["generate", "grid.gltf", "-o", "other.gltf"], { prepare: linked((_, to) => symlinkSync("grid.gltf", to)) });
    for (const its of [ofProgram, ofNative]) {
      const cwd = newFolder();
      grid(cwd);
      mkdirSync(join(cwd, "real"));
      writeFileSync(join(cwd, "real/out.gltf"), "old");
      chmodSync(join(cwd, "real/out.gltf"), 0o640);
      symlinkSync("real/out.gltf", join(cwd, "link.gltf"));
      assert.equal(its(["generate", "grid.gltf", "-o", "link.gltf"], { cwd }).status, 0);
      assert.equal(statSync(join(cwd, "real/out.gltf")).mode & 0o777, 0o640);
      assert.notEqual(readFileSync(join(cwd, "real/out.gltf"), "utf8"), "old");
      assert.deepEqual(readdirSync(join(cwd, "real")).filter((name) => /tmp|old/.test(name)), []);
    }
  });
});

describe("the program", { skip: missing }, () => {
  it("reports unsupported features in one line", () => {
    const cwd = newFolder();
    grid(cwd);
    for (const [words, what] of [[["check", "a.fbx"], /tspace-import/], [["bake", "grid.gltf", "--high", "grid.gltf", "-o", "map.png"], /Embree/]]) {
      writeFileSync(join(cwd, "a.fbx"), "Kaydara FBX Binary  ");
      const { stderr, status } = ofProgram(words, { cwd, encoding: "utf8" });
      assert.match(stderr, what);
      assert.equal(stderr.trim().split("\n").length, 1);
      assert.ok(status > 0);
    }
    assert.match(ofProgram(["--version"], { encoding: "utf8" }).stdout, /^tspace \d+\.\d+\.\d+\nBuilt without: .*baking/);
  });

  const unix = process.platform === "win32" && "Windows has no such signals";
  it("ends with the signal that it receives, and leaves no temporary file", { skip: unix || skip }, async () => {
    const market = join(shared, "models/perf/Market_495k.glb");
    for (const signal of ["SIGTERM", "SIGINT"]) {
      const cwd = newFolder();
      const child = spawn(process.execPath, [program, "generate", market, "-o", "out/a.glb", "--all", "--method", "best"], { cwd, stdio: "ignore" });
      setTimeout(() => child.kill(signal), 400);
      const ended = await new Promise((resolve) => child.on("exit", (code, by) => resolve(by ?? code)));
      const left = existsSync(join(cwd, "out")) ? readdirSync(join(cwd, "out")) : [];
      // A fast machine may finish before the signal.
      if (ended !== 0) assert.equal(ended, signal);
      assert.deepEqual(left.filter((name) => name !== "a.glb"), []);
    }
  });

  it("ends silently if its output is closed", { skip: unix || skip }, () => {
    const { status, stdout } = spawnSync("sh", ["-c", `"$0" "$1" inspect "$2" --json | head -c 10; echo`, process.execPath, program, helmet()], { encoding: "utf8" });
    assert.equal(status, 0);
    assert.equal(stdout.trim().length > 0, true);
  });
});
