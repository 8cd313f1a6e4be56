// SPDX-License-Identifier: MIT
// `tspace mcp FOLDER`: a server of the Model Context Protocol on stdin and stdout. Each tool call runs this package's
// program in a separate process that can access only this folder (inside.js), even if a folder of models contains
// links. References of models to files outside their folder, including links, are rejected by the tool itself, and also
// by the native tool, which bakes.
import { spawn } from "node:child_process";
import { existsSync, readFileSync, readdirSync, realpathSync, statSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { methodNames } from "../src/names.js";
import { isIn, onlyInside, realPlace } from "./inside.js";

const help = `tspace mcp - serve inspect, check, identify, generate and bake to agents

Usage: tspace mcp FOLDER [--tool PROGRAM]

A server for the Model Context Protocol, on stdin and stdout. It reads and writes
files only in FOLDER and its subfolders: all other paths are rejected, including
those that links lead to or that a model references. It needs the npm package
@modelcontextprotocol/sdk:
npx -y -p tspace -p @modelcontextprotocol/sdk tspace mcp FOLDER

  --tool PROGRAM
        Path of the native tspace program, which is needed for bake: this program
        does not include ray tracing. It also rejects paths outside the folder of
        a model.
`;

const program = fileURLToPath(new URL("tspace.js", import.meta.url));
/** Limits of one call: time, characters of its output and of a report without pictures, pictures. */
const limits = { milliseconds: 600_000, output: 1 << 28, characters: 100_000, pictures: 8 };

const text = (description) => ({ type: "string", description });
const flag = (description) => ({ type: "boolean", description });
const model = text("A model (.glb, .vrm, .gltf, .obj) in the folder, or a folder of models");
const replace = flag("Overwrite existing files. Default: false.");

/**
 * Descriptions of each tool for clients, and words(arguments, place): its command line. `place` checks paths of inputs
 * and outputs.
 */
const tools = {
  inspect: {
    description: "Lists the contents of a model file: primitives, attributes, materials, and which parts need tangents. No file is changed.",
    properties: { file: model },
    required: ["file"],
    words: ({ file }, place) => [place.input(file)],
  },
  check: {
    description: "Reports errors in the normals, tangents, UVs and normal maps of a model, how to fix each one, and pictures before and after the fix. No file is changed.",
    properties: { file: model, pictures: flag("Return up to 8 pictures of the findings. Default: true.") },
    required: ["file"],
    words: ({ file, pictures = true }, place) => [place.input(file), ...(pictures ? ["--pictures"] : [])],
  },
  identify: {
    description: "Reports which method and which convention made the tangents of a model. No file is changed.",
    properties: { file: model },
    required: ["file"],
    words: ({ file }, place) => [place.input(file)],
  },
  generate: {
    description: "Writes a .glb with the tangents and normals that its materials need; with repair, also fixes the errors that check reports.",
    properties: {
      file: text("A model (.glb, .vrm, .gltf, .obj) in the folder"),
      output: text("Output file: a .glb in the folder"),
      method: { type: "string", enum: methodNames, description: "Tangent method. Default: mikktspace." },
      overwrite: flag("Recompute existing tangents"),
      all: flag("Also process primitives whose material needs no tangents"),
      repair: flag("Repair the tangents that check reports"),
      replace,
    },
    required: ["file", "output"],
    words: ({ file, output, method, overwrite, all, repair, replace: may }, place) => [
      place.input(file), "-o", place.output(output, ".glb", may), ...(method ? ["--method", method] : []),
      ...(overwrite ? ["--overwrite"] : []), ...(all ? ["--all"] : []), ...(repair ? ["--repair"] : []),
    ],
  },
  bake: {
    description: "Bakes the normal map of a low poly from a high poly, and measures its error in degrees. Needs the native tool: tspace mcp FOLDER --tool PROGRAM.",
    properties: {
      low: text("Low-poly model in the folder, which receives the map"),
      high: text("High-poly model in the folder, with the detail"),
      output: text("Output file: a .png in the folder"),
      size: { type: "integer", minimum: 1, maximum: 16384, description: "Width and height of the map in texels. Default: 1024." },
      replace,
    },
    required: ["low", "high", "output"],
    isNative: true,
    words: ({ low, high, output, size, replace: may }, place) => [
      place.input(low), "--high", place.input(high), "-o", place.output(output, ".png", may), ...(size ? ["--size", String(size)] : []),
    ],
  },
};

/** Error for a rejected call; its message is sent to the client. */
class Refusal extends Error {}

/** Returns functions that convert paths of calls, relative to the folder `root` or absolute, to real paths in it. */
export function placesIn(root) {
  const real = (path) => {
    let place;
    try {
      place = realPlace(resolve(root, path));
    } catch {
      throw new Refusal(`${path}: cannot be resolved`);
    }
    if (!isIn(root, place)) throw new Refusal(`${path} is outside the folder that this server may use`);
    return place;
  };
  return {
    input(path) {
      const place = real(path);
      if (!existsSync(place)) throw new Refusal(`${path} does not exist`);
      return place;
    },
    output(path, ending, mayReplace) {
      if (!path.toLowerCase().endsWith(ending)) throw new Refusal(`${path}: the output must end in ${ending}`);
      const place = real(path);
      // A map of several materials is written to several files with a common prefix.
      const begin = basename(place).slice(0, -ending.length);
      const taken = existsSync(dirname(place)) && readdirSync(dirname(place)).find((name) => name === basename(place) || (ending === ".png" && name.startsWith(begin) && name.toLowerCase().endsWith(ending)));
      if (taken && !mayReplace) throw new Refusal(`${join(dirname(path), taken)} already exists; use replace: true to overwrite it`);
      return place;
    },
  };
}

/** Checks the arguments against the tool's schema. */
function checked(given, { properties, required }) {
  for (const [name, value] of Object.entries(given)) {
    const rule = Object.hasOwn(properties, name) && properties[name];
    if (!rule) throw new Refusal(`unknown argument ${name}; known arguments are ${Object.keys(properties).join(", ")}`);
    const fits = rule.type === "integer" ? Number.isInteger(value) && value >= rule.minimum && value <= rule.maximum : typeof value === rule.type;
    if (!fits || (rule.enum && !rule.enum.includes(value))) throw new Refusal(`${name} must be ${rule.enum ? `one of ${rule.enum.join(", ")}` : `of type ${rule.type}`}`);
    if (value === "") throw new Refusal(`${name} is empty`);
  }
  const missing = required.find((name) => given[name] === undefined);
  if (missing) throw new Refusal(`${missing} is missing`);
  return given;
}

/** Functions that end the programs of unfinished calls. */
const unfinished = new Set();

/** Runs a program; returns its output, up to a limit, and its exit code. */
function ended(command, words, cwd, folders, signal) {
  return new Promise((done, failed) => {
    const env = { ...process.env, [onlyInside]: JSON.stringify(folders) };
    const child = spawn(command, words, { cwd, env, signal, timeout: limits.milliseconds, stdio: ["ignore", "pipe", "pipe"] });
    const stop = () => child.kill();
    unfinished.add(stop);
    const printed = { stdout: "", stderr: "" };
    for (const name of Object.keys(printed)) child[name].setEncoding("utf8").on("data", (part) => printed[name].length < limits.output && (printed[name] += part));
    child.on("error", failed);
    child.on("close", (code, ending) => {
      unfinished.delete(stop);
      done({ code, ending, ...printed });
    });
  });
}

const cut = (text) => (text.length > limits.characters ? `${text.slice(0, limits.characters)}\n(truncated: the full text has ${text.length} characters)` : text);

/** Returns a report as the content of an answer: the text, then the pictures of its findings with their captions. */
function contentOf(output, hasPictures) {
  if (!hasPictures) return [{ type: "text", text: cut(output) }];
  const { pictures, ...report } = JSON.parse(output), content = [{ type: "text", text: cut(JSON.stringify(report, null, 2)) }];
  for (const { file, finding, caption, png } of pictures.slice(0, limits.pictures)) {
    const { severity, code } = report.files[file].findings[finding];
    content.push({ type: "text", text: `${severity} ${code}, ${caption}:` }, { type: "image", data: png, mimeType: "image/png" });
  }
  if (pictures.length > limits.pictures) content.push({ type: "text", text: `${pictures.length - limits.pictures} more pictures were omitted.` });
  return content;
}

async function call(name, given, { root, native, signal }) {
  if (!Object.hasOwn(tools, name)) throw new Refusal(`unknown tool ${name}; the tools are ${Object.keys(tools).join(", ")}`);
  const tool = tools[name];
  if (tool.isNative && !native) throw new Refusal("bake needs the native tspace program; start this server with tspace mcp FOLDER --tool PROGRAM");
  const words = [name, ...tool.words(checked(given, tool), placesIn(root)), "--json"];
  const run = tool.isNative ? ended(native, words, root, [], signal) : ended(process.execPath, [program, ...words], root, [root], signal);
  const { code, ending, stdout, stderr } = await run;
  if (ending) throw new Refusal(`${name} was stopped (${ending}); its time limit is ${limits.milliseconds / 60_000} minutes`);
  const content = [...(stdout.trim() ? contentOf(stdout, words.includes("--pictures")) : []), ...(stderr.trim() ? [{ type: "text", text: cut(stderr) }] : [])];
  return { content, isError: code > 1 };
}

function readWords(words) {
  if (words.includes("--help") || words.includes("-h")) {
    process.stdout.write(help);
    process.exit(0);
  }
  const fail = (message, code = 2) => {
    process.stderr.write(`tspace: ${message}\n`);
    process.exit(code);
  };
  const at = words.indexOf("--tool");
  const [, native] = at < 0 ? [] : words.splice(at, 2);
  if (at >= 0 && !native) fail("--tool must be followed by the path of a program");
  if (words.length !== 1 || words[0].startsWith("-")) fail("mcp needs exactly one folder (see tspace mcp --help)");
  try {
    const root = realpathSync(words[0]);
    if (!statSync(root).isDirectory()) throw new Error();
    return { root, native, fail };
  } catch {
    return fail(`${words[0]} is not a folder`, 4);
  }
}

/** Serves requests until the client closes stdin. */
export async function serve(words) {
  const { root, native, fail } = readWords(words);
  const sdk = "@modelcontextprotocol/sdk";
  const parts = await Promise.all(["server/index.js", "server/stdio.js", "types.js"].map((part) => import(`${sdk}/${part}`)))
    .catch((error) => fail(`mcp needs the package ${sdk}, which cannot be loaded; run npm install ${sdk} (${error.code ?? error.message})`));
  const [{ Server }, { StdioServerTransport }, { CallToolRequestSchema, ListToolsRequestSchema }] = parts;
  const { version } = JSON.parse(readFileSync(new URL("../package.json", import.meta.url), "utf8"));
  const server = new Server({ name: "tspace", version }, {
    capabilities: { tools: {} },
    instructions: `Normals, tangents and normal maps of 3D models. Paths are relative to ${root}, and nothing outside it can be read or written. Reports are JSON.`,
  });
  server.setRequestHandler(ListToolsRequestSchema, () => ({
    tools: Object.entries(tools).map(([name, { description, properties, required }]) => ({
      name, description, inputSchema: { type: "object", properties, required, additionalProperties: false },
      annotations: { readOnlyHint: !properties.output, openWorldHint: false },
    })),
  }));
  let last = Promise.resolve(); // one call at a time, because each may use all cores
  server.setRequestHandler(CallToolRequestSchema, ({ params }, { signal }) => {
    const answer = last.then(() => call(params.name, params.arguments ?? {}, { root, native, signal }))
      .catch((error) => ({ content: [{ type: "text", text: error instanceof Refusal ? error.message : `${params.name} could not be run: ${error.message}` }], isError: true }));
    last = answer;
    return answer;
  });
  process.on("exit", () => unfinished.forEach((end) => end()));
  for (const name of ["SIGINT", "SIGTERM", "SIGHUP"]) process.on(name, () => process.exit(1));
  const closed = new Promise((resolve) => {
    server.onclose = resolve;
    process.stdin.on("end", resolve);
  });
  await server.connect(new StdioServerTransport());
  await closed;
  process.exit(0);
}
