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

const source = readFileSync(new URL("../../../shaders/tspace_evaluate.wgsl", import.meta.url), "utf8");
const text = source.replace(/^ *\/\/.*\n| *\/\/.*/gm, "").replace(/[`\\$]/g, "\\$&");
writeFileSync(join(folder, "evaluate_shader.js"), `// SPDX-License-Identifier: MIT\n// shaders/tspace_evaluate.wgsl, without comments.\nexport const shader = \`${text}\`;\n`);
