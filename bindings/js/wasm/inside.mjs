// SPDX-License-Identifier: MIT
// Puts each WebAssembly module of a folder into a module of JavaScript too: node inside.mjs FOLDER
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const folder = process.argv[2];
for (const name of readdirSync(folder).filter((file) => file.endsWith(".wasm"))) {
  const text = gzipSync(readFileSync(join(folder, name)), { level: 9 }).toString("base64");
  writeFileSync(join(folder, name.replace(".wasm", "-inside.js")),
    `// SPDX-License-Identifier: MIT\nimport { unpacked } from "./inside.js";\n\nexport const source = () => unpacked("${text}");\n`);
}
