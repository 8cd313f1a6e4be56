// SPDX-License-Identifier: MIT
// Embeds each WebAssembly module of a folder, and the compute shader of "tspace/webgpu", in a JavaScript module: node
// inside.mjs FOLDER
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const folder = process.argv[2];
for (const name of readdirSync(folder).filter((file) => file.endsWith(".wasm"))) {
  const text = gzipSync(readFileSync(join(folder, name)), { level: 9 }).toString("base64");
  writeFileSync(join(folder, name.replace(".wasm", "-inside.js")),
    `// SPDX-License-Identifier: MIT\nimport { unpacked } from "./inside.js";\n\nexport const source = () => unpacked("${text}");\n`);
}

/** Words of WGSL in the shader, and its entry point. They keep their names; single letters keep theirs too. */
const kept = new Set(`abs array binding bitcast bool builtin clamp compute const cross dot else f32 false floor fn for global_invocation_id group i32 if max
  min read read_write return sqrt storage struct true u32 var vec2f vec3f vec3u vec4f while workgroup_size tspace_evaluate`.split(/\s+/));

/** Returns WGSL without comments, spaces and named constants, with short names: the most frequent ones have one letter. */
function shortened(source) {
  const constants = new Map();
  const text = source.replace(/ *\/\/.*/g, "").replace(/^\s+/gm, "").replace(/ ?([-+*/=<>{}(),;:|&!^]+) ?/g, "$1")
    .replace(/^const (\w+):\w+=(.*);\n/gm, (_, name, value) => (constants.set(name, value), ""))
    .replace(/\w+/g, (word) => constants.get(word) ?? word);
  const counts = new Map();
  const names = /(?<![\w.]|\d\.)[a-z]\w+|(?<=\.)[a-z]\w+/gi;
  for (const [name] of text.matchAll(names)) if (!kept.has(name)) counts.set(name, (counts.get(name) ?? 0) + 1);
  const sorted = [...counts.keys()].sort((a, b) => counts.get(b) - counts.get(a) || (a < b ? -1 : 1));
  const short = new Map(sorted.map((name, i) => [name, (i < 26 ? "" : String.fromCharCode(64 + Math.floor(i / 26))) + String.fromCharCode(65 + (i % 26))]));
  return text.replace(names, (name) => short.get(name) ?? name);
}

const text = shortened(readFileSync(new URL("../../../shaders/tspace_evaluate.wgsl", import.meta.url), "utf8")).replace(/[`\\$]/g, "\\$&");
writeFileSync(join(folder, "evaluate_shader.js"),
  `// SPDX-License-Identifier: MIT\n// shaders/tspace_evaluate.wgsl with short names, without comments.\nexport const shader = \`${text}\`;\n`);
