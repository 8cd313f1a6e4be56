// SPDX-License-Identifier: MIT
// run.mjs CHROMIUM SHADERS DATA DOCS: runs the shaders in headless Chromium on the cases in DATA (N.case), and writes
// the results to DATA/LANGUAGE.N.results. WGSL code in the file DOCS must compile. Prints which languages ran and, if
// WebGPU did not run, why.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { openPage } from "../../client/browser/open_page.mjs";

const [chromium, shaders, data, docs] = process.argv.slice(2);
const snippets = [...readFileSync(docs, "utf8").matchAll(/^```wgsl\n(.*?)^```$/gms)].map(([, code]) => code);
if (snippets.length === 0) throw new Error(`there is no WGSL in ${docs}`);
const here = path.dirname(fileURLToPath(import.meta.url));
const folders = { page: here, tests: path.dirname(here), shaders };
const cases = readdirSync(data).filter((name) => name.endsWith(".case")).map((name) => parseInt(name));

const by = await openPage({
    chromium,
    flags: ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan"],
    page: "/page/page.html",
    answer: ([area, ...rest]) => {
        if (area === "list") return { json: cases };
        if (area === "snippets") return { json: snippets };
        if (area === "cases") return { file: path.join(data, `${rest[0]}.case`) };
        return folders[area] && { file: path.join(folders[area], ...rest) };
    },
    received: ([what, language, number], bytes) => {
        if (what === "without") console.log(`WebGPU does not start, so WGSL is not tested: ${bytes}`);
        else writeFileSync(path.join(data, `${language}.${number}.results`), bytes);
    },
    timeout_ms: 200_000,
}).catch((error) => {
    console.log(`FAILED: ${error.message}`);
    process.exit(1);
});
console.log(by);
