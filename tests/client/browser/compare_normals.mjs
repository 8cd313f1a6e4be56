// SPDX-License-Identifier: MIT
// compare_normals.mjs CHROMIUM THREE SIZE NAME=MODEL=NORMALS...: three.js renders each model, and its shading normals
// are compared with those in the file NORMALS (shading_normals.cpp). The program fails if the mean difference, away
// from edges, exceeds 0.1 degrees.
import { readFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { openPage } from "./open_page.mjs";

const MOST_MEAN_DEGREES = 0.1;
const EDGE_DEGREES = 20; // a neighbor that differs by more is an edge: there the visible surface depends on rounding
const LEAST_SHARE = 0.25; // minimum share of the surface that is compared

const page_folder = path.dirname(fileURLToPath(import.meta.url));
const [chromium, three_folder, size_text, ...tasks] = process.argv.slice(2);
const size = Number(size_text);
const files = new Map(tasks.map((task) => task.split("=")).map(([name, model, normals]) => [name, { model, normals }]));

const rendered = new Map();
const by = await openPage({
    chromium,
    page: "/page/normals.html",
    timeout_ms: 200_000,
    answer: ([area, ...rest]) => {
        if (area === "list") return { json: { models: [...files.keys()], size } };
        if (area === "models") return files.has(rest[0]) ? { file: files.get(rest[0]).model } : undefined;
        const folder = { page: page_folder, three: three_folder }[area];
        return folder && { file: path.join(folder, ...rest) };
    },
    received: ([, name], bytes) => rendered.set(name, new Float32Array(new Uint8Array(bytes).buffer)),
}).catch((error) => {
    console.log(`FAILED: ${error.message}`);
    process.exit(1);
});
console.log(by);

const degrees = (a, b) => {
    const cross = Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    return Math.atan2(cross, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * (180 / Math.PI);
};

/// Returns the normal of a pixel of three.js, whose rows start at the bottom and whose colors are 0.5 n + 0.5.
function normalOfThree(pixels, x, y) {
    const at = 4 * ((size - 1 - y) * size + x);
    return pixels[at + 3] === 0 ? undefined : [0, 1, 2].map((k) => 2 * pixels[at + k] - 1);
}
function normalOfOurs(pixels, x, y) {
    const at = 4 * (y * size + x);
    return pixels[at + 3] === 0 ? undefined : [pixels[at], pixels[at + 1], pixels[at + 2]];
}

/// Returns whether a neighbor of a pixel differs strongly from it, or is missing.
function isEdge(normalOf, pixels, x, y) {
    const center = normalOf(pixels, x, y);
    for (let dy = -1; dy <= 1; ++dy) {
        for (let dx = -1; dx <= 1; ++dx) {
            const inside = x + dx >= 0 && y + dy >= 0 && x + dx < size && y + dy < size;
            const beside = inside ? normalOf(pixels, x + dx, y + dy) : undefined;
            if (beside === undefined || degrees(center, beside) > EDGE_DEGREES) return true;
        }
    }
    return false;
}

let failures = 0;
for (const [name, { normals }] of files) {
    const ours = new Float32Array(new Uint8Array(readFileSync(normals)).buffer), theirs = rendered.get(name);
    let sum = 0, most = 0, compared = 0, surface = 0;
    for (let y = 0; y < size; ++y) {
        for (let x = 0; x < size; ++x) {
            const a = normalOfOurs(ours, x, y), b = normalOfThree(theirs, x, y);
            surface += a !== undefined || b !== undefined;
            if (a === undefined || b === undefined) continue;
            if (isEdge(normalOfOurs, ours, x, y) || isEdge(normalOfThree, theirs, x, y)) continue;
            const angle = degrees(a, b);
            sum += angle;
            most = Math.max(most, angle);
            ++compared;
        }
    }
    const mean = sum / compared, share = compared / surface;
    console.log(`${name}: mean ${mean.toFixed(4)}, at most ${most.toFixed(2)} degrees at ${compared} pixels (${(100 * share).toFixed(0)} % of the surface)`);
    if (!(mean <= MOST_MEAN_DEGREES) || !(share >= LEAST_SHARE)) {
        ++failures;
        console.log(`FAILED ${name}`);
    }
}
process.exitCode = failures === 0 ? 0 : 1;
