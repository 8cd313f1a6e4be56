// SPDX-License-Identifier: MIT
// Tests Rollup, Bun and Next with the installed package: scripts/js --all installs them into build/js/bundlers.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { copyFileSync, cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { describe, it } from "node:test";

const installed = process.env.TSPACE_BUNDLERS;
const has = (name) => Boolean(installed) && existsSync(join(installed, "node_modules", name));
const absent = (name) => !has(name) && `${name} is not installed: scripts/js --all`;
const load = (name) => import(pathToFileURL(createRequire(join(installed, "package.json")).resolve(name)));

const frames = `makeIndexedFrames({
  positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]), uvs: new Float32Array([0, 0, 1, 0, 0, 1]), indices: new Uint32Array([0, 1, 2]),
}, { convention: "opengl" })`;
const wanted = "tangents 1 0 0 1 1 0 0 1 1 0 0 1";
const program = (entry) => `import { makeIndexedFrames, ready } from ${JSON.stringify(entry)};
ready.then(() => console.log("tangents", ${frames}.tangents.join(" ")));
`;

/** Calls body(folder) with a separate folder in which the packages can be resolved. */
async function inProject(body) {
  const folder = mkdtempSync(join(installed, "try-"));
  try {
    return await body(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}
/** Returns the output of a bundle's only file, run alone in a folder. */
function printed(bundle, command = process.execPath) {
  const folder = mkdtempSync(join(tmpdir(), "tspace-bundle-"));
  try {
    copyFileSync(bundle, join(folder, "out.mjs"));
    return execFileSync(command, [join(folder, "out.mjs")], { encoding: "utf8", stdio: "pipe", cwd: folder }).trim();
  } finally {
    rmSync(folder, { recursive: true });
  }
}

describe("Rollup", { skip: absent("rollup") }, () => {
  for (const [entry, exportConditions] of [["tspace", ["node"]], ["tspace/inline", ["node"]], ["tspace/inline", []]])
    it(`makes one file of ${entry} under the conditions [${exportConditions}]`, () => inProject(async (folder) => {
      const [{ rollup }, { default: resolve }] = [await load("rollup"), await load("@rollup/plugin-node-resolve")];
      writeFileSync(join(folder, "server.mjs"), program(entry));
      const bundle = await rollup({ input: join(folder, "server.mjs"), plugins: [resolve({ exportConditions })], onwarn: ({ message }) => assert.fail(message) });
      await bundle.write({ dir: join(folder, "out"), entryFileNames: "out.mjs" });
      await bundle.close();
      assert.deepEqual(readdirSync(join(folder, "out")), ["out.mjs"]);
      assert.equal(printed(join(folder, "out", "out.mjs")), wanted);
    }));
});

const bunPackage = "@oven/bun-linux-x64";
describe("Bun", { skip: absent(bunPackage) }, () => {
  const bun = join(installed ?? "", "node_modules", bunPackage, "bin/bun");
  for (const entry of ["tspace", "tspace/inline"]) {
    it(`runs ${entry}`, () => inProject((folder) => {
      writeFileSync(join(folder, "server.mjs"), program(entry));
      assert.equal(execFileSync(bun, [join(folder, "server.mjs")], { encoding: "utf8" }).trim(), wanted);
    }));
    for (const [target, command] of [["bun", bun], ["node", process.execPath]])
      it(`makes one file of ${entry} for ${target}`, () => inProject((folder) => {
        writeFileSync(join(folder, "server.mjs"), program(entry));
        execFileSync(bun, ["build", "--target", target, join(folder, "server.mjs"), "--outfile", join(folder, "out.mjs")], { stdio: "pipe" });
        assert.equal(printed(join(folder, "out.mjs"), command), wanted);
      }));
  }
  it("makes one file of tspace/inline for browsers", () => inProject((folder) => {
    writeFileSync(join(folder, "page.mjs"), program("tspace/inline"));
    execFileSync(bun, ["build", "--target", "browser", join(folder, "page.mjs"), "--outfile", join(folder, "out.mjs")], { stdio: "pipe" });
    assert.equal(printed(join(folder, "out.mjs")), wanted);
  }));
});

/** Returns a port on which no server listens at the moment. */
const freePort = () => new Promise((resolve) => {
  const server = createServer().listen(0, "127.0.0.1", () => {
    const { port } = server.address();
    server.close(() => resolve(port));
  });
});

describe("Next", { skip: absent("next") }, () => {
  const page = (entry) => `import { makeIndexedFrames, ready } from "${entry}";
export const dynamic = "force-dynamic";
export default async function Page() {
  await ready;
  return <p>{"tangents " + ${frames}.tangents.join(" ")}</p>;
}
`;
  for (const bundler of ["turbopack", "webpack"])
    it(`serves results of server components, built by ${bundler}, from its standalone folder`, { timeout: 400_000 }, () => inProject(async (folder) => {
      // A separate project, because Next uses the folder with the packages as its root.
      cpSync(join(installed, "package.json"), join(folder, "package.json"));
      writeFileSync(join(folder, "next.config.mjs"), `const root = ${JSON.stringify(installed)};
export default { output: "standalone", outputFileTracingRoot: root, turbopack: { root }, typescript: { ignoreBuildErrors: true } };
`);
      mkdirSync(join(folder, "app/inline"), { recursive: true });
      writeFileSync(join(folder, "app/layout.js"), "export default ({ children }) => <html><body>{children}</body></html>;\n");
      writeFileSync(join(folder, "app/page.js"), page("tspace"));
      writeFileSync(join(folder, "app/inline/page.js"), page("tspace/inline"));
      const env = { ...process.env, NEXT_TELEMETRY_DISABLED: "1", NODE_ENV: "production" };
      const next = join(installed, "node_modules/next/dist/bin/next");
      execFileSync(process.execPath, [next, "build", ...(bundler === "webpack" ? ["--webpack"] : [])], { cwd: folder, env, stdio: "pipe" });
      const alone = mkdtempSync(join(tmpdir(), "tspace-next-"));
      let server;
      try {
        cpSync(join(folder, ".next/standalone"), alone, { recursive: true, verbatimSymlinks: true });
        const port = await freePort();
        const name = folder.split("/").at(-1);
        server = spawn(process.execPath, [join(alone, name, "server.js")], { env: { ...env, PORT: String(port), HOSTNAME: "127.0.0.1" }, stdio: "ignore" });
        for (const path of ["/", "/inline"]) {
          let answer;
          for (let i = 0; i < 100 && !answer; ++i) {
            answer = await fetch(`http://127.0.0.1:${port}${path}`).catch(() => undefined);
            if (!answer) await new Promise((resolve) => setTimeout(resolve, 100));
          }
          assert.equal(answer?.status, 200, path);
          assert.ok((await answer.text()).includes(wanted), path);
        }
      } finally {
        server?.kill();
        rmSync(alone, { recursive: true });
      }
    }));
});
