// SPDX-License-Identifier: MIT
// Tests the published archive: installed in an empty project, where the README's code runs; its size and its types.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { describe, it } from "node:test";
import { gzipSync } from "node:zlib";
import { gridModel } from "./models.mjs";

const archive = process.env.TSPACE_TGZ;
const installed = fileURLToPath(new URL("../node_modules/tspace/src/", import.meta.url));
const project = fileURLToPath(new URL("..", import.meta.url));

function inEmptyProject(body) {
  const folder = mkdtempSync(join(tmpdir(), "tspace-js-"));
  try {
    writeFileSync(join(folder, "package.json"), '{ "private": true, "type": "module" }\n');
    execFileSync("npm", ["install", "--offline", "--no-audit", "--no-fund", "--omit=peer", "--loglevel=error", archive], { cwd: folder });
    body(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

describe("the archive", { skip: !archive && "run scripts/js" }, () => {
  it("installs into an empty project, and the README's code runs", () => {
    inEmptyProject((folder) => {
      const readme = readFileSync(join(folder, "node_modules/tspace/README.md"), "utf8");
      const blocks = [...readme.matchAll(/```js\n([\s\S]*?)```/g)].map((match) => match[1]);
      assert.ok(blocks.length > 0);
      const { model, buffer } = gridModel({ uri: "chair.bin" });
      writeFileSync(join(folder, "chair.gltf"), model);
      writeFileSync(join(folder, "chair.bin"), buffer);
      blocks.forEach((code, i) => {
        // Examples that import three or @gltf-transform run in adapters.test.mjs, where these packages are installed.
        if (/from "(three|@gltf)/.test(code)) return;
        writeFileSync(join(folder, `readme${i}.mjs`), code);
        assert.match(execFileSync("node", [`readme${i}.mjs`], { cwd: folder, encoding: "utf8" }), /Uint32Array|Float32Array|Uint8Array/);
      });
      assert.ok(existsSync(join(folder, "node_modules/tspace/LICENSE")));
      if (!existsSync(join(folder, "node_modules/tspace/bin/tspace.wasm"))) return; // scripts/js --no-tool
      const made = execFileSync("npx", ["--offline", "tspace", "generate", "chair.gltf", "-o", "out.glb", "--all", "--json"], { cwd: folder, encoding: "utf8" });
      assert.equal(JSON.parse(made).files[0].ok, true);
      assert.equal(readFileSync(join(folder, "out.glb")).subarray(0, 4).toString(), "glTF");
    });
  });

  /** Returns the compressed size of an entry: its module and all modules that it imports. */
  function sizeOf(entry) {
    const seen = new Set(), queue = [entry];
    for (let file; (file = queue.pop()); ) {
      if (seen.has(file)) continue;
      seen.add(file);
      if (file.endsWith(".wasm")) continue;
      const text = readFileSync(join(installed, file), "utf8");
      for (const [, name] of text.matchAll(/from ?"\.\/(.+?)"|new URL\("\.\/(.+?)"/g)) if (name) queue.push(name);
      for (const [, name] of text.matchAll(/new URL\("\.\/(.+?)"/g)) queue.push(name);
      for (const [, name] of text.matchAll(/from ?"#(\w+)"/g)) queue.push(`${name}-beside.js`);
    }
    return [...seen].reduce((bytes, file) => bytes + gzipSync(readFileSync(join(installed, file)), { level: 9 }).length, 0);
  }

  it("is as small as the documentation says", () => {
    const [whole, small, files, textures, webgpu] = ["index.js", "mikktspace.js", "gltf.js", "textures.js", "webgpu.js"].map(sizeOf);
    console.log(`tspace ${whole} bytes gzipped, tspace/mikktspace ${small}, tspace/gltf ${files}, tspace/textures ${textures}, tspace/webgpu ${webgpu}`);
    assert.ok(whole < 112_500 && small < 45_500 && files < 465_500 && textures < 68_500 && webgpu < 13_000);
  });

  it("contains readable sources", () => {
    const modules = readdirSync(installed).filter((file) => file.endsWith(".js") && !file.endsWith("-inside.js"));
    assert.ok(modules.length > 20);
    for (const file of modules) {
      const lines = readFileSync(join(installed, file), "utf8").split("\n");
      assert.ok(lines[0].startsWith("// SPDX") && lines.every((line) => line.length < 200), file);
    }
  });

  it("has types that match its modules", async () => {
    for (const entry of ["index", "mikktspace", "normals", "pack", "textures", "gltf", "compat", "webgpu"]) {
      const declared = readFileSync(join(installed, `${entry}.d.ts`), "utf8") + readFileSync(join(installed, "types.d.ts"), "utf8");
      for (const name of Object.keys(await import(join(installed, `${entry}.js`))))
        assert.match(declared, new RegExp(`(function|const|class) ${name}\\b`), `${entry}: ${name}`);
    }
  });

  const tsc = join(project, "node_modules/typescript/bin/tsc");
  it("has types that accept a valid program and reject an invalid one", { skip: !existsSync(tsc) && "typescript is not installed" }, () => {
    const check = (name, code, lib = "dom") => {
      writeFileSync(join(project, name), code);
      execFileSync("node", [tsc, "--noEmit", "--strict", "--module", "nodenext", "--target", "es2022", "--lib", `es2022,${lib}`, "--skipLibCheck", "false", "--types", "", name], { cwd: project, stdio: "pipe" });
    };
    const head = 'import { generateTangents, makeIndexedFrames, Plan, ready, TspaceError } from "tspace";\nimport * as small from "tspace/mikktspace";\nimport { check, decodeByCanvas, decodeImages, diff, generate, inspect } from "tspace/gltf";\nimport { compressMap, readTexture } from "tspace/textures";\nimport { GpuFrames } from "tspace/webgpu";\nimport { MeshoptDecoder, MeshoptEncoder } from "meshoptimizer";\nawait ready;\nconst mesh = { positions: new Float32Array(9), indices: new Uint16Array(3) };\n';
    check("right.ts", `${head}const t: Float32Array = generateTangents(mesh, { convention: "gltf", method: "best" });
const frames = makeIndexedFrames(mesh, { convention: { vAxis: "up" }, normals: { weighting: "area" } });
const plan = new Plan(mesh, { convention: "unreal" });
try { plan.evaluate({ positions: t, normals: frames.normals }); } catch (e) { if (e instanceof TspaceError) e.code.length; }
const onGpu = await GpuFrames.create({}, plan, { mesh, sourceCorners: frames.sourceCorners, normals: { weighting: "max" } });
const gpuBuffer = { size: 48, usage: 128, destroy() {} };
onGpu.encode({}, { positions: { buffer: gpuBuffer, format: "snorm16x3", scale: [1, 1, 2] }, normals: gpuBuffer, tangents: { buffer: gpuBuffer, format: "snorm8_pair" } });
small.generateTangents(mesh, { convention: "gltf", pairing: "corrected" });
const made = generate(new Uint8Array(9), { method: "best", name: "a.obj", signal: new AbortController().signal, onProgress: ({ what, done }) => what.length + done, resources: { "a.bin": t.buffer as ArrayBuffer } });
generate(made.bytes, { meshopt: { decoder: MeshoptDecoder, encoder: MeshoptEncoder }, compress: "meshopt", flipGreen: true, encodeImage: ({ data }) => Uint8Array.from(data) });
check(made.bytes, { decodeImage: await decodeImages(made.bytes, decodeByCanvas) });
for (const finding of check(made.bytes, { resources: () => undefined }).findings) finding.code.length;
const actions: number = made.report.totals.actions.generated;
const green: "up" | null = inspect(made.bytes).primitives[0].tangentUses[0].neededBy === "anisotropy" ? null : "up";
diff(made.bytes, made.bytes).primitives[0].b?.place.length;
const texture = compressMap({ width: 1, height: 1, rgba: new Float32Array(4) }, { format: "eac-rg11", quality: "best" });
const z: "red" | "green" | "blue" | "alpha" | null | undefined = readTexture(texture.bytes, { level: 0, numbers: "float", unzstd: (data, size) => data.subarray(size) }).layout?.z;
texture.report.meanErrorDeg.toFixed(z?.length);
generateTangents(mesh, { convention: "gltf", hasTangent: new Uint8Array(3) });\n`);
    // Results can be transferred without a copy, and written to files.
    check("transfer.ts", `${head}const { normals, tangents, indices } = makeIndexedFrames(mesh, { convention: "gltf" });
postMessage(tangents, [normals.buffer, tangents.buffer, indices.buffer, generateTangents(mesh, { convention: "gltf" }).buffer]);
new Blob([generate(new Uint8Array()).bytes, compressMap(new Uint8Array()).bytes]);
await fetch("/upload", { method: "POST", body: generate(new Uint8Array()).bytes });\n`, "webworker");
    for (const wrong of ["generateTangents(mesh, {});", 'generateTangents(mesh, { convention: "maya" });', 'small.generateTangents(mesh, { convention: "gltf", method: "best" });', "generateTangents({ positions: [0] }, { convention: 'gltf' });", 'check("model.glb");', 'inspect(new Uint8Array(9)).color;', 'diff(new Uint8Array(9), new Uint8Array(9)).primitives[0].a.place;', 'check(new Uint8Array(9), { decodeImage: () => 5 });', 'check(new Uint8Array(9), { meshopt: { encoder: MeshoptEncoder } });', 'readTexture("a.ktx2");', 'compressMap(new Uint8Array(9), { format: "bc7" });', "(await GpuFrames.create({}, new Plan(mesh, { convention: 'gltf' }))).encode({}, {});"])
      assert.throws(() => check("wrong.ts", head + wrong), /./, wrong);
  });
});
