// SPDX-License-Identifier: MIT
// show_textures.mjs CHROMIUM THREE NUMBERS KTX2...: three.js shows these textures. If the GPU supports their format, x
// and y must equal those of the map in the file NUMBERS (texture_maps.py).
import { readFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { openPage } from "./open_page.mjs";

const WIDTH = 64, HEIGHT = 48, MOST = 4; // the same values as in texture_maps.py
const page_folder = path.dirname(fileURLToPath(import.meta.url));
const [chromium, three_folder, numbers, ...paths] = process.argv.slice(2);
const files = new Map(paths.map((file) => [path.basename(file), file]));
const shown = new Map();
const by = await openPage({
    chromium,
    page: "/page/textures.html",
    timeout_ms: 100_000,
    answer: ([area, ...rest]) => {
        if (area === "list") {
            const names = [...files.keys()].map((name) => ({ name, is_signed: name.startsWith("bc5s") }));
            return { json: { names, width: WIDTH, height: HEIGHT } };
        }
        if (area === "textures") return files.has(rest[0]) ? { file: files.get(rest[0]) } : undefined;
        const folder = { page: page_folder, three: three_folder }[area];
        return folder && { file: path.join(folder, ...rest) };
    },
    received: ([, name], bytes) => shown.set(name, bytes),
}).catch((error) => {
    console.log(`FAILED: ${error.message}`);
    process.exit(1);
});
console.log(by);

const wanted = readFileSync(numbers);
let failures = 0;
for (const name of files.keys()) {
    const pixels = shown.get(name), y = name.startsWith("astc") ? 3 : 1; // ASTC stores y in alpha
    let worst = 0;
    for (let i = 0; i < WIDTH * HEIGHT; ++i) {
        worst = Math.max(worst, Math.abs(pixels[4 * i] - wanted[2 * i]), Math.abs(pixels[4 * i + y] - wanted[2 * i + 1]));
    }
    console.log(`${name}: within ${worst} of 255`);
    if (worst <= MOST) continue;
    ++failures;
    console.log(`FAILED ${name}: it shows another map`);
}
process.exitCode = failures === 0 ? 0 : 1;
