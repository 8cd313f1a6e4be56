// SPDX-License-Identifier: MIT
// Tests `tspace mcp` with the protocol's official client, over stdin and stdout.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, realpathSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, describe, it } from "node:test";
import { gridModel } from "./models.mjs";
import { tool } from "./tool.mjs";

const program = fileURLToPath(new URL("../node_modules/tspace/bin/tspace.js", import.meta.url));
const [sdk, transports] = await Promise.all(["index.js", "stdio.js"].map((part) => import(`@modelcontextprotocol/sdk/client/${part}`).catch(() => null)));
const missing = (!existsSync(join(program, "../tspace.wasm")) && "the package has no program") || (!(sdk && transports) && "@modelcontextprotocol/sdk is not installed");

/** A folder with models, next to a folder that must not be readable. */
const home = realpathSync(mkdtempSync(join(tmpdir(), "tspace-mcp-test-")));
const [root, outside] = ["models", "outside"].map((name) => join(home, name));
after(() => rmSync(home, { recursive: true, force: true }));
mkdirSync(join(root, "deep"), { recursive: true });
mkdirSync(outside);
const { model, buffer } = gridModel({ uri: "grid.bin" });
for (const folder of [root, join(root, "deep"), outside]) {
  writeFileSync(join(folder, "grid.gltf"), model);
  writeFileSync(join(folder, "grid.bin"), buffer);
}
symlinkSync(outside, join(root, "way"));
symlinkSync(join(outside, "grid.gltf"), join(root, "link.gltf"));
symlinkSync(join(outside, "new.glb"), join(root, "nowhere.glb"));
symlinkSync(join(root, "deep"), join(root, "within"));
symlinkSync(root, join(home, "alias"));
// Models whose buffer is a link to the outside, or is named outside the folder.
mkdirSync(join(root, "linked"));
writeFileSync(join(root, "linked/grid.gltf"), model);
symlinkSync(join(outside, "grid.bin"), join(root, "linked/grid.bin"));
writeFileSync(join(root, "named.gltf"), model.toString().replace("grid.bin", "../outside/grid.bin"));
// An OBJ whose material library is a link to the outside.
writeFileSync(join(root, "cut.obj"), "mtllib cut.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl secret\nf 1/1 2/2 3/3\n");
writeFileSync(join(outside, "cut.mtl"), "newmtl secret\nmap_Bump secret.png\n");
symlinkSync(join(outside, "cut.mtl"), join(root, "cut.mtl"));

async function connected(words) {
  const client = new sdk.Client({ name: "test", version: "1" });
  await client.connect(new transports.StdioClientTransport({ command: process.execPath, args: [program, "mcp", ...words], stderr: "ignore" }));
  return client;
}
const textOf = (answer) => answer.content.filter(({ type }) => type === "text").map(({ text }) => text).join("\n");

describe("tspace mcp", { skip: missing }, () => {
  let client;
  before(async () => (client = await connected([root])));
  after(() => client?.close());
  const call = (name, given) => client.callTool({ name, arguments: given });
  const good = async (name, given) => {
    const answer = await call(name, given);
    assert.ok(!answer.isError, textOf(answer));
    return answer;
  };
  const refused = async (name, given, reason) => {
    const answer = await call(name, given);
    assert.ok(answer.isError, `${name} ${JSON.stringify(given)}`);
    assert.match(textOf(answer), reason);
    assert.ok(!textOf(answer).includes("secret"));
  };

  it("lists five tools, two of which write files", async () => {
    const { tools } = await client.listTools();
    assert.deepEqual(tools.map(({ name }) => name), ["inspect", "check", "identify", "generate", "bake"]);
    assert.deepEqual(tools.map(({ annotations }) => annotations.readOnlyHint), [true, true, true, false, false]);
    for (const { inputSchema } of tools) assert.equal(inputSchema.additionalProperties, false);
  });

  it("returns the program's reports, and writes the requested files", async () => {
    const { files: [inspected] } = JSON.parse(textOf(await good("inspect", { file: "grid.gltf" })));
    assert.equal(inspected.primitives.length, 1);
    const made = JSON.parse(textOf(await good("generate", { file: "deep/grid.gltf", output: "deep/out.glb", all: true, method: "best" })));
    assert.equal(made.files[0].totals.actions.generated, 1);
    assert.equal(readFileSync(join(root, "deep/out.glb")).subarray(0, 4).toString(), "glTF");
    const { files: [identified] } = JSON.parse(textOf(await good("identify", { file: join(root, "deep/out.glb") })));
    assert.match(JSON.stringify(identified), /best/);
    await good("inspect", { file: "within/grid.gltf" }); // a link inside the folder
    await good("inspect", { file: join(home, "alias/grid.gltf") }); // the folder under another name
    await refused("generate", { file: "grid.gltf", output: "deep/out.glb", all: true }, /already exists/);
    await good("generate", { file: "grid.gltf", output: "deep/out.glb", all: true, replace: true });
    rmSync(join(root, "deep/out.glb"));
  });

  it("returns pictures of findings", async () => {
    await good("generate", { file: "grid.gltf", output: "wrong.glb", all: true });
    const bytes = readFileSync(join(root, "wrong.glb"));
    const json = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)));
    const accessor = json.accessors[json.meshes[0].primitives[0].attributes.TANGENT];
    const view = json.bufferViews[accessor.bufferView];
    const from = 28 + bytes.readUInt32LE(12) + (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
    for (let v = 0; v < accessor.count; ++v) {
      const at = from + v * (view.byteStride ?? 16) + 12;
      bytes.writeFloatLE(-bytes.readFloatLE(at), at);
    }
    writeFileSync(join(root, "wrong.glb"), bytes);
    const answer = await good("check", { file: "wrong.glb" });
    assert.match(textOf(answer), /"signsInverted"|"signsWrong"/);
    const pictures = answer.content.filter(({ type }) => type === "image");
    assert.ok(pictures.length >= 2);
    for (const { data, mimeType } of pictures) {
      assert.equal(mimeType, "image/png");
      assert.equal(Buffer.from(data, "base64").subarray(1, 4).toString(), "PNG");
    }
    assert.ok((await good("check", { file: "wrong.glb", pictures: false })).content.every(({ type }) => type === "text"));
    assert.deepEqual(readdirSync(root).filter((name) => name.endsWith(".html")), []);
  });

  it("reads nothing outside of its folder", async () => {
    for (const file of ["../outside/grid.gltf", "deep/../../outside/grid.gltf", join(outside, "grid.gltf"), "way/grid.gltf", "link.gltf", "/etc/passwd", `${root}x/grid.gltf`, ".."])
      await refused("inspect", { file }, /outside the folder|cannot be resolved/);
    await refused("inspect", { file: "nothing.gltf" }, /does not exist/);
    // .. is resolved before links are followed
    await refused("inspect", { file: "way/../outside/grid.gltf" }, /does not exist/);
    await refused("inspect", { file: "nowhere.glb" }, /cannot be resolved|outside/);
    await refused("inspect", { file: "grid.gltf\0.png" }, /cannot be resolved/);
    await refused("inspect", { file: "linked/grid.gltf" }, /leads outside the folder of the model/); // the buffer is a link
    await refused("inspect", { file: "named.gltf" }, /outside|\.\./);
    // links in a folder of models
    const { files } = JSON.parse((await call("check", { file: root, pictures: false })).content[0].text);
    assert.deepEqual(files.filter(({ input, ok }) => ok === /link|named|nowhere/.test(input)).map(({ input }) => input), []);
    assert.ok(!textOf(await call("check", { file: "cut.obj", pictures: false })).includes("secret.png"));
  });

  it("writes nothing outside of its folder", async () => {
    for (const output of ["../new.glb", join(outside, "new.glb"), "way/new.glb", "nowhere.glb", "deep/../../new.glb", "way/../../new.glb"])
      await refused("generate", { file: "grid.gltf", output, all: true, replace: true }, /outside the folder|cannot be resolved/);
    await refused("generate", { file: "grid.gltf", output: "grid.gltf", replace: true }, /must end in \.glb/);
    assert.deepEqual(readdirSync(outside).sort(), ["cut.mtl", "grid.bin", "grid.gltf"]);
    assert.ok(!existsSync(join(home, "new.glb")));
  });

  it("reports invalid calls", async () => {
    await refused("inspect", {}, /file is missing/);
    await refused("inspect", { file: 5 }, /file must be of type string/);
    await refused("inspect", { file: "" }, /file is empty/);
    await refused("inspect", { file: "grid.gltf", allowExternal: true }, /unknown argument allowExternal/);
    await refused("inspect", { file: "grid.gltf", constructor: "a" }, /unknown argument constructor/);
    await refused("generate", { file: "grid.gltf", output: "a.glb", method: "finest" }, /method must be one of mikktspace/);
    await refused("inspect", { file: "--version" }, /does not exist/);
    await refused("paint", {}, /unknown tool paint/);
    await refused("bake", { low: "grid.gltf", high: "grid.gltf", output: "a.png" }, /--tool PROGRAM/);
    writeFileSync(join(root, "broken.gltf"), "{");
    await refused("check", { file: "broken.gltf" }, /broken\.gltf/);
  });

  it("bakes with the native tool, which follows no links outside either", { skip: !tool && "no tool here: build the preset release" }, async () => {
    const other = await connected([root, "--tool", tool]);
    try {
      const bake = (given) => other.callTool({ name: "bake", arguments: { size: 32, ...given } });
      for (const low of ["linked/grid.gltf", "../outside/grid.gltf", "link.gltf"])
        assert.match(textOf(await bake({ low, high: "grid.gltf", output: "map.png" })), /outside the folder/);
      const made = await bake({ low: "deep/grid.gltf", high: "deep/grid.gltf", output: "deep/map.png" });
      assert.ok(!made.isError, textOf(made));
      assert.equal(readFileSync(join(root, "deep/map.png")).subarray(1, 4).toString(), "PNG");
      assert.match(textOf(await bake({ low: "deep/grid.gltf", high: "deep/grid.gltf", output: "deep/map.png" })), /already exists/);
    } finally {
      await other.close();
    }
  });

  it("ends running programs when it is terminated, and leaves no files", { skip: !existsSync("/proc/self/task") && "no /proc here" }, async () => {
    const other = await connected([root]);
    // A slow model: a grid of 250,000 faces.
    const size = 500, lines = [];
    for (let y = 0; y <= size; ++y) for (let x = 0; x <= size; ++x) lines.push(`v ${x} ${y} ${Math.sin(x * y)}`, `vt ${x} ${y}`);
    for (let y = 0; y < size; ++y) for (let x = 0; x < size; ++x) {
      const [a, b] = [y * (size + 1) + x + 1, (y + 1) * (size + 1) + x + 1];
      lines.push(`f ${a}/${a} ${a + 1}/${a + 1} ${b + 1}/${b + 1} ${b}/${b}`);
    }
    writeFileSync(join(root, "large.obj"), lines.join("\n"));
    const answer = other.callTool({ name: "generate", arguments: { file: "large.obj", output: "large.glb", all: true } }).catch(() => undefined);
    const { pid } = other.transport, children = () => readFileSync(`/proc/${pid}/task/${pid}/children`, "utf8").trim();
    while (!children()) await new Promise((resolve) => setTimeout(resolve, 10));
    const child = children();
    await new Promise((resolve) => setTimeout(resolve, 300));
    await other.close();
    await answer;
    for (let i = 0; i < 100 && existsSync(`/proc/${child}`); ++i) await new Promise((resolve) => setTimeout(resolve, 50));
    assert.ok(!existsSync(`/proc/${child}`), "the program has ended");
    assert.deepEqual(readdirSync(root).filter((name) => /large\.(?!obj)|tmp/.test(name)), []);
    rmSync(join(root, "large.obj"));
  });

  it("prints help, and rejects a path that is not a folder", () => {
    const run = (...words) => spawnSync(process.execPath, [program, "mcp", ...words], { encoding: "utf8" });
    assert.match(run("--help").stdout, /Usage: tspace mcp FOLDER/);
    assert.deepEqual([run().status, run("a", "b").status, run(join(home, "none")).status, run(program).status], [2, 2, 4, 4]);
  });
});
