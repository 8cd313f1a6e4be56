// SPDX-License-Identifier: MIT
// Bundles for servers, copied to a folder without any other file of the package.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { describe, it } from "node:test";
import { gridModel } from "./models.mjs";

const project = fileURLToPath(new URL("..", import.meta.url));
const [esbuild, vite] = await Promise.all(["esbuild", "vite"].map((name) => import(name).catch(() => null)));

const program = (entry) => `
import { makeIndexedFrames, ready } from ${JSON.stringify(entry)};
import * as small from "tspace/mikktspace";
import * as files from "tspace/gltf";
import { packFrames, ready as packReady } from "tspace/pack";
Promise.all([ready, small.ready, files.ready, packReady]).then(() => {
  const mesh = { positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]), uvs: new Float32Array([0, 0, 1, 0, 0, 1]), indices: new Uint32Array([0, 1, 2]) };
  const { tangents, normals } = makeIndexedFrames(mesh, { convention: "gltf" });
  small.generateTangents({ ...mesh, normals }, { convention: "gltf" });
  const { exitCode } = files.check(new TextEncoder().encode(${JSON.stringify(gridModel().model.toString())}));
  console.log(tangents.length, packFrames(normals, tangents, "frame32").length, exitCode);
});
`;

/** Calls body(folder) with the program in the project and an empty folder for the bundle. */
async function withProgram(entry, body) {
  const folder = mkdtempSync(join(tmpdir(), "tspace-js-"));
  const path = join(project, `server-${entry.replace(/\W/g, "-")}.mjs`);
  try {
    writeFileSync(path, program(entry));
    return await body(path, folder);
  } finally {
    rmSync(path);
    rmSync(folder, { recursive: true });
  }
}
/** Returns the output of a bundle's only file, run alone in a folder. */
function printed(bundle) {
  const folder = mkdtempSync(join(tmpdir(), "tspace-js-"));
  try {
    const alone = join(folder, bundle.endsWith(".cjs") ? "server.cjs" : "server.mjs");
    copyFileSync(bundle, alone);
    return execFileSync("node", [alone], { encoding: "utf8", stdio: "pipe" }).trim();
  } finally {
    rmSync(folder, { recursive: true });
  }
}
const wanted = /^12 12 \d$/;

describe("bundles for servers", () => {
  for (const entry of ["tspace", "tspace/inline"]) {
    for (const format of ["esm", "cjs"])
      it(`of esbuild run as one file: ${entry}, ${format}`, { skip: !esbuild && "esbuild is not installed" }, () =>
        withProgram(entry, async (path, folder) => {
          const outfile = join(folder, format === "esm" ? "out.mjs" : "out.cjs");
          await esbuild.build({ entryPoints: [path], outfile, bundle: true, platform: "node", format, logLevel: "error" });
          assert.deepEqual(readdirSync(folder).length, 1);
          assert.match(printed(outfile), wanted);
        }));

    it(`of Vite run as one file: ${entry}`, { skip: !vite && "Vite is not installed" }, () =>
      withProgram(entry, async (path, folder) => {
        await vite.build({
          root: project, configFile: false, logLevel: "error", ssr: { noExternal: true },
          build: { ssr: path, outDir: folder, emptyOutDir: false, rollupOptions: { output: { entryFileNames: "out.mjs", inlineDynamicImports: true } } },
        });
        assert.deepEqual(readdirSync(folder), ["out.mjs"]);
        assert.match(printed(join(folder, "out.mjs")), wanted);
      }));
  }

  it("of esbuild for browsers have the module inside by tspace/inline", { skip: !esbuild && "esbuild is not installed" }, async () => {
    const code = 'import { generateTangents, ready } from "tspace/inline";\nready.then(() => console.log(typeof generateTangents));\n';
    const { outputFiles } = await esbuild.build({
      stdin: { contents: code, resolveDir: project }, bundle: true, platform: "browser", format: "esm", write: false, logLevel: "error",
    });
    assert.equal(outputFiles.length, 1);
    assert.doesNotMatch(outputFiles[0].text, /\.wasm"/);
    assert.match(execFileSync("node", ["--input-type=module"], { input: outputFiles[0].text, encoding: "utf8" }), /function/);
  });

  it("share one module where both entries are imported", async () => {
    const [one, other] = await Promise.all([import("tspace"), import("tspace/inline")]);
    assert.equal(one.ready, other.ready);
    assert.deepEqual(Object.keys(one).sort(), Object.keys(other).sort());
    await one.ready;
    assert.ok(existsSync(join(project, "node_modules/tspace/src/inline.js")));
    assert.ok(readFileSync(join(project, "node_modules/tspace/package.json"), "utf8").includes('"./inline"'));
  });
});
