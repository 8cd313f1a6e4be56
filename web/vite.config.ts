// SPDX-License-Identifier: MIT
// The page becomes one file: scripts, styles, the worker, WebAssembly and samples are all in index.html.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { gzipSync } from "node:zlib";
import { defineConfig, type Plugin } from "vite";

/** What the page may do: run its own scripts and worker, and read what it holds itself. The first script, where there is one, says which server it may ask. */
function policy(scripts: string[]): string {
  const hashes = scripts.map((script) => `'sha256-${createHash("sha256").update(script).digest("base64")}'`);
  return [
    "default-src 'none'",
    `script-src ${hashes.join(" ")} 'wasm-unsafe-eval' blob:`,
    "worker-src blob:",
    "style-src 'unsafe-inline'",
    "img-src data: blob:",
    `connect-src data: blob:${scripts.length > 1 ? " https: http:" : ""}`,
    "base-uri 'none'",
    "form-action 'none'",
  ].join("; ");
}

/** WebAssembly as gzip makes it, which src/worker/load_packed.ts reads: as text it then takes half the place, and less of a gzipped page too. */
function packedWasm(): Plugin {
  const packed = (path: string) => JSON.stringify(`data:application/gzip;base64,${gzipSync(readFileSync(path), { level: 9 }).toString("base64")}`);
  return {
    name: "packed-wasm",
    enforce: "pre",
    load: (id) => (id.endsWith(".wasm?packed") ? `export default ${packed(id.replace("?packed", ""))}` : null),
  };
}

/** The package's modules that lie in JavaScript, packed in the same way. */
const insideOf = (name: string) => resolve(import.meta.dirname, `node_modules/tspace/src/${name}-inside.js`);

/** Draco's module asks node for these where it runs there. */
const nodeModules: Plugin = {
  name: "node-modules",
  enforce: "pre",
  resolveId: (id) => (id === "fs" || id === "path" ? "\0nothing" : null),
  load: (id) => (id === "\0nothing" ? "export {}" : null),
};

/** Puts the script and the style sheet into the HTML, and a policy that allows this very script. */
function oneFile(): Plugin {
  return {
    name: "one-file",
    enforce: "post",
    generateBundle(_, bundle) {
      const files = Object.values(bundle);
      const page = files.find((file) => file.fileName === "index.html");
      const script = files.find((file) => file.type === "chunk");
      const style = files.find((file) => file.fileName.endsWith(".css"));
      if (page?.type !== "asset" || script?.type !== "chunk") throw new Error("no page, or no script");
      // "</script" inside of a string would end the script.
      const code = script.code.replaceAll("</script", "<\\/script");
      const css = style?.type === "asset" ? String(style.source) : "";
      // In the page, not in the lesson: narrows the policy to no server, or to the one that its address names.
      const guard = String(page.source).includes("<!-- guard -->") ? readFileSync(resolve(import.meta.dirname, "src/guard.js"), "utf8") : null;
      const head = `<meta http-equiv="Content-Security-Policy" content="${policy(guard ? [guard, code] : [code])}" />${guard ? `\n    <script>${guard}</script>` : ""}\n    <style>${css}</style>`;
      const html = String(page.source)
        .replace(/<script type="module"[^>]*><\/script>/, "")
        .replace(/<link rel="stylesheet"[^>]*>|<!-- guard -->\s*/g, "")
        .replace('<meta charset="utf-8" />', () => `<meta charset="utf-8" />\n    ${head}`)
        .replace("</body>", () => `<!-- model -->\n    <script type="module">${code}</script>\n  </body>`);
      page.source = html;
      for (const file of files) if (file !== page) delete bundle[file.fileName];
    },
  };
}

export default defineConfig({
  base: "./",
  assetsInclude: ["**/*.glb"],
  build: { target: "es2022", assetsInlineLimit: 1 << 30, cssCodeSplit: false, modulePreload: false, chunkSizeWarningLimit: 8000 },
  resolve: { alias: { "#core": insideOf("core"), "#gltf": insideOf("gltf"), "#textures": insideOf("textures") } },
  worker: { format: "iife", plugins: () => [packedWasm(), nodeModules] },
  define: { __VERSION__: JSON.stringify(JSON.parse(readFileSync(resolve(import.meta.dirname, "node_modules/tspace/package.json"), "utf8")).version) },
  plugins: [packedWasm(), oneFile()],
});
