// SPDX-License-Identifier: MIT
// `tspace mcp FOLDER`: a server of the Model Context Protocol on stdin and stdout. Each tool call runs this package's
// program in a separate process that can access only this folder (inside.js), even if a folder of models contains
// links. References of models to files outside their folder, including links, are rejected by the tool itself, and also
// by the native tool, which bakes.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, realpathSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { methodNames } from "../src/names.js";
import { isIn, onlyInside, realPlace } from "./inside.js";

const help = `tspace mcp - serve inspect, check, identify, generate and bake to agents

Usage: tspace mcp FOLDER [--tool PROGRAM]

A server of the Model Context Protocol, on stdin and stdout. It reads and writes
files in FOLDER and below alone: other paths are refused, also where links lead
to them and where a model names them. It needs npm's @modelcontextprotocol/sdk:
npx -y -p tspace -p @modelcontextprotocol/sdk tspace mcp FOLDER

  --tool PROGRAM
        The native tspace, which bake is done by: the rays are not in this
        program. It too refuses what leads out of a model's folder.
`;

const program = fileURLToPath(new URL("tspace.js", import.meta.url));
/** Limits of one call: time, characters of a report, pictures. */
const limits = { milliseconds: 600_000, characters: 100_000, pictures: 8 };

const text = (description) => ({ type: "string", description });
const flag = (description) => ({ type: "boolean", description });
const model = text("A model (.glb, .vrm, .gltf, .obj) in the folder, or a folder of models");
const replace = flag("Write over files that are there; false unless given");

/**
 * Descriptions of each tool for clients, and words(arguments, place): its command line. `place` checks paths of inputs
 * and outputs.
 */
const tools = {
  inspect: {
    description: "What is in a model file: primitives, attributes, materials, and which parts need tangents. Changes nothing.",
    properties: { file: model },
    required: ["file"],
    words: ({ file }, place) => [place.input(file)],
  },
  check: {
    description: "What is wrong with the normals, tangents, UVs and normal maps of a model, how to mend each, and pictures of the places, as they are and mended. Changes nothing.",
    properties: { file: model, pictures: flag("Pictures of the findings, up to 8; true unless given") },
    required: ["file"],
    words: ({ file, pictures = true }, place, folder) => [place.input(file), ...(pictures ? ["--html", join(folder, "page.html")] : [])],
  },
  identify: {
    description: "Which method and which convention made the tangents of a model. Changes nothing.",
    properties: { file: model },
    required: ["file"],
    words: ({ file }, place) => [place.input(file)],
  },
  generate: {
    description: "Writes a .glb with tangents (and normals) where its materials need them; or, with repair, with what check found mended.",
    properties: {
      file: text("A model (.glb, .vrm, .gltf, .obj) in the folder"),
      output: text("The file to write: a .glb in the folder"),
      method: { type: "string", enum: methodNames, description: "How tangents are computed; mikktspace unless given" },
      overwrite: flag("Replace tangents that are there"),
      all: flag("Also where no material needs them"),
      repair: flag("Mend what check finds"),
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
      low: text("The model in the folder that the map is for"),
      high: text("The model in the folder with the detail"),
      output: text("The file to write: a .png in the folder"),
      size: { type: "integer", minimum: 1, maximum: 16384, description: "Texels along each side; 1024 unless given" },
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

/** Returns functions that convert paths of calls (relative to the folder or absolute) to real paths inside it. */
export function placesIn(root) {
  const real = (path) => {
    let place;
    try {
      place = realPlace(resolve(root, path));
    } catch {
      throw new Refusal(`${path}: cannot be followed`);
    }
    if (!isIn(root, place)) throw new Refusal(`${path}: is outside of the folder that this server may use`);
    return place;
  };
  return {
    input(path) {
      const place = real(path);
      if (!existsSync(place)) throw new Refusal(`${path}: is not there`);
      return place;
    },
    output(path, ending, mayReplace) {
      if (!path.toLowerCase().endsWith(ending)) throw new Refusal(`${path}: the output must end in ${ending}`);
      const place = real(path);
      // A map of several materials is written to several files with a common prefix.
      const begin = basename(place).slice(0, -ending.length);
      const taken = existsSync(dirname(place)) && readdirSync(dirname(place)).find((name) => name === basename(place) || (ending === ".png" && name.startsWith(begin) && name.toLowerCase().endsWith(ending)));
      if (taken && !mayReplace) throw new Refusal(`${join(dirname(path), taken)}: is there already (replace: true writes over it)`);
      return place;
    },
  };
}

/** Checks the arguments against the tool's schema. */
function checked(given, { properties, required }) {
  for (const [name, value] of Object.entries(given)) {
    const rule = Object.hasOwn(properties, name) && properties[name];
    if (!rule) throw new Refusal(`${name} is unknown: known are ${Object.keys(properties).join(", ")}`);
    const fits = rule.type === "integer" ? Number.isInteger(value) && value >= rule.minimum && value <= rule.maximum : typeof value === rule.type;
    if (!fits || (rule.enum && !rule.enum.includes(value))) throw new Refusal(`${name} must be ${rule.enum ? `one of ${rule.enum.join(", ")}` : `of type ${rule.type}`}`);
    if (value === "") throw new Refusal(`${name} is empty`);
  }
  const missing = required.find((name) => given[name] === undefined);
  if (missing) throw new Refusal(`${missing} is missing`);
  return given;
}

/**
 * Cleanup functions for calls that are unfinished when this process ends: they end the program and remove its folder.
 */
const unfinished = new Set();

/** Runs a program; returns its output, up to a limit, and its exit code. */
function ended(command, words, cwd, folders, signal) {
  return new Promise((done, failed) => {
    const env = { ...process.env, [onlyInside]: JSON.stringify(folders) };
    const child = spawn(command, words, { cwd, env, signal, timeout: limits.milliseconds, stdio: ["ignore", "pipe", "pipe"] });
    const stop = () => child.kill();
    unfinished.add(stop);
    const printed = ["stdout", "stderr"].map((name) => {
      const text = { value: "", length: 0 };
      child[name].setEncoding("utf8").on("data", (part) => {
        text.value += part.slice(0, limits.characters - text.value.length);
        text.length += part.length;
      });
      return text;
    });
    child.on("error", failed);
    child.on("close", (code, ending) => {
      unfinished.delete(stop);
      const [stdout, stderr] = printed.map(({ value, length }) => (length > value.length ? `${value}\n(cut: there are ${length} characters)` : value));
      done({ code, ending, stdout, stderr });
    });
  });
}

/** Returns the pictures of a page of `check`, each preceded by a line that describes its finding. */
function picturesOf(page) {
  const content = [];
  let left = limits.pictures, dropped = 0;
  for (const [article] of page.matchAll(/<article[\s\S]*?<\/article>/g)) {
    const code = article.match(/<h3><b>(\w+)<\/b> (.+?)<\/h3>/);
    for (const [, caption, data] of article.matchAll(/<img alt="([^"]*)"[^>]*?src="data:image\/png;base64,([^"]*)"/g)) {
      if (left-- > 0) content.push({ type: "text", text: `${code?.[1]} ${code?.[2]}, ${caption}:` }, { type: "image", data, mimeType: "image/png" });
      else ++dropped;
    }
  }
  if (dropped) content.push({ type: "text", text: `${dropped} more pictures are left out.` });
  return content;
}

async function call(name, given, { root, native, signal }) {
  if (!Object.hasOwn(tools, name)) throw new Refusal(`${name} is unknown: tools are ${Object.keys(tools).join(", ")}`);
  const tool = tools[name];
  if (tool.isNative && !native) throw new Refusal("bake needs the native tspace: start this server as tspace mcp FOLDER --tool PROGRAM");
  const own = realpathSync(mkdtempSync(join(tmpdir(), "tspace-mcp-")));
  const remove = () => rmSync(own, { recursive: true, force: true });
  unfinished.add(remove);
  try {
    const words = [name, ...tool.words(checked(given, tool), placesIn(root), own), "--json"];
    const run = tool.isNative ? ended(native, words, root, [], signal) : ended(process.execPath, [program, ...words], root, [root, own], signal);
    const { code, ending, stdout, stderr } = await run;
    if (ending) throw new Refusal(`${name} was ended (${ending}): it may take ${limits.milliseconds / 60_000} minutes`);
    const page = join(own, "page.html");
    const content = [stdout, stderr].filter((part) => part.trim() !== "").map((part) => ({ type: "text", text: part }));
    if (existsSync(page)) content.push(...picturesOf(readFileSync(page, "utf8")));
    return { content, isError: code > 1 };
  } finally {
    unfinished.delete(remove);
    remove();
  }
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
  if (at >= 0 && !native) fail("--tool: a program is missing");
  if (words.length !== 1 || words[0].startsWith("-")) fail("mcp takes one folder (see tspace mcp --help)");
  try {
    const root = realpathSync(words[0]);
    if (!statSync(root).isDirectory()) throw new Error();
    return { root, native, fail };
  } catch {
    return fail(`${words[0]}: is no folder`, 4);
  }
}

/** Serves requests until the client closes stdin. */
export async function serve(words) {
  const { root, native, fail } = readWords(words);
  const sdk = "@modelcontextprotocol/sdk";
  const parts = await Promise.all(["server/index.js", "server/stdio.js", "types.js"].map((part) => import(`${sdk}/${part}`)))
    .catch((error) => fail(`mcp needs the package ${sdk}, which cannot be loaded: npm install ${sdk} (${error.code ?? error.message})`));
  const [{ Server }, { StdioServerTransport }, { CallToolRequestSchema, ListToolsRequestSchema }] = parts;
  const { version } = JSON.parse(readFileSync(new URL("../package.json", import.meta.url), "utf8"));
  const server = new Server({ name: "tspace", version }, {
    capabilities: { tools: {} },
    instructions: `Normals, tangents and normal maps of 3D models. Paths are relative to ${root}, and nothing outside of it can be read or written. Reports are JSON.`,
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
