// SPDX-License-Identifier: MIT
// Puts WebAssembly into modules of JavaScript too, and makes the modules of a folder smaller, where the rolldown of Vite is
// installed: node bundle.mjs PROJECT FOLDER. An entry becomes one module, and what entries share a few: together they compress
// better than one by one.
import { readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";

const [project, folder] = process.argv.slice(2);
const { exports, imports } = JSON.parse(readFileSync(join(folder, "../package.json"), "utf8"));
const chosen = Object.values(imports).flatMap((choice) => Object.values(choice));
const entries = [...Object.values(exports).map((entry) => entry.default), ...chosen].map((path) => path.match(/(\w[\w-]*)\.js$/)[1]);

for (const name of readdirSync(folder).filter((file) => file.endsWith(".wasm"))) {
  const text = gzipSync(readFileSync(join(folder, name)), { level: 9 }).toString("base64");
  writeFileSync(join(folder, name.replace(".wasm", "-inside.js")),
    `// SPDX-License-Identifier: MIT\nimport { unpacked } from "./inside.js";\n\nexport const source = () => unpacked("${text}");\n`);
}

async function bundled({ rolldown }) {
  const input = Object.fromEntries(entries.map((name) => [name, resolve(folder, `${name}.js`)]));
  const bundle = await rolldown({ input, external: (id) => id.startsWith("#") || /^[\w@]/.test(id) });
  const names = { entryFileNames: "[name].js", chunkFileNames: "[name].js" };
  return (await bundle.generate({ ...names, format: "es", minify: true })).output;
}

let rolldown;
try {
  rolldown = await import(pathToFileURL(createRequire(resolve(project, "package.json")).resolve("rolldown")));
} catch (error) {
  console.log(`the modules stay as they are, for rolldown cannot be loaded: ${error.message.split("\n")[0]}`);
}
if (rolldown) {
  const modules = await bundled(rolldown);
  for (const name of readdirSync(folder).filter((file) => file.endsWith(".js"))) rmSync(join(folder, name));
  for (const { fileName, code } of modules) {
    // Some bundlers know only URLs in quotes.
    const known = code.replace(/new URL\(`([^`$]+)`/g, 'new URL("$1"');
    writeFileSync(join(folder, fileName), known); // LICENSE is beside them: a line in each would be 150 bytes for browsers to load
  }
}
