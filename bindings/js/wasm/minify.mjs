// SPDX-License-Identifier: MIT
// Makes the modules of a folder smaller, where the minifier of Vite's rolldown is installed: node minify.mjs PROJECT FOLDER.
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [project, folder] = process.argv.slice(2);
let minify;
try {
  const path = createRequire(resolve(project, "package.json")).resolve("rolldown/experimental");
  ({ minify } = await import(pathToFileURL(path)));
} catch (error) {
  console.log(`the modules stay as they are, for rolldown cannot be loaded: ${error.message.split("\n")[0]}`);
}
for (const name of minify ? readdirSync(folder).filter((file) => file.endsWith(".js")) : []) {
  const path = join(folder, name);
  const { code, errors } = await minify(name, readFileSync(path, "utf8"), { module: true, compress: true, mangle: { toplevel: true } });
  if (errors.length !== 0) throw new Error(`${name}: ${errors[0].message}`);
  // Some bundlers know only URLs in quotes.
  const known = code.replace(/new URL\(`([^`$]+)`/g, 'new URL("$1"');
  writeFileSync(path, `// SPDX-License-Identifier: MIT\n${known}`);
}
