// SPDX-License-Identifier: MIT
// Builds the page as a single file: index.html contains scripts, styles, the worker, WebAssembly and samples.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { gzipSync } from "node:zlib";
import { defineConfig, type Plugin } from "vite";

/**
 * Returns the content security policy: the page may run its own scripts and worker, and read embedded data. With two
 * scripts, the first one (guard.js) restricts the servers that the page may access.
 */
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

/** Embeds WebAssembly compressed with gzip (see src/worker/load_packed.ts), which halves its size as text, and also reduces the size of a gzipped page. */
function packedWasm(): Plugin {
  const packed = (path: string) => JSON.stringify(`data:application/gzip;base64,${gzipSync(readFileSync(path), { level: 9 }).toString("base64")}`);
  return {
    name: "packed-wasm",
    enforce: "pre",
    load: (id) => (id.endsWith(".wasm?packed") ? `export default ${packed(id.replace("?packed", ""))}` : null),
  };
}

/** Modules that the package embeds in JavaScript are compressed in the same way. */
const insideOf = (name: string) => resolve(import.meta.dirname, `node_modules/tspace/src/${name}-inside.js`);

/** Node modules that Draco's module imports only if it runs in node. */
const nodeModules: Plugin = {
  name: "node-modules",
  enforce: "pre",
  resolveId: (id) => (id === "fs" || id === "path" ? "\0nothing" : null),
  load: (id) => (id === "\0nothing" ? "export {}" : null),
};

/** Embeds the script and the style sheet in the HTML, with a policy that allows only this script. */
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
      // "</script" inside a string would end the script element.
      const code = script.code.replaceAll("</script", "<\\/script");
      const css = style?.type === "asset" ? String(style.source) : "";
      // For the page, not the lesson: restricts the policy to no server, or to the one in the page's address.
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
