// SPDX-License-Identifier: MIT
// judge.mjs CHROMIUM THREE OUT ROLE=NAME=MODEL...: renders NormalTangentTest in several versions and reports the cells that
// are lit on the wrong side. Pictures are written to OUT/NAME.SIDE.png. ROLE is the expected result:
//   shown     any; the numbers are printed
//   right     no wrong cell
//   inverted  every mapped cell is wrong: proof that the comparison detects it
import { mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { cellsOf, comparePairs, MAPPED_CELLS, missingDomes, wrongOf } from "./cells.mjs";
import { renderModels } from "./render.mjs";

const [chromium, three_folder, out, ...tasks] = process.argv.slice(2);
const roles = new Map(), models = {};
for (const task of tasks) {
    const [role, name, model] = task.split("=");
    roles.set(name, role);
    models[name] = model;
}

const { by, pixels, pictures } = await renderModels({ chromium, three_folder, models, timeout_ms: 100_000 }).catch((error) => {
    console.log(`FAILED: ${error.message}`);
    process.exit(1);
});
console.log(by);
mkdirSync(out, { recursive: true });
let failures = 0;
for (const [name, role] of roles) {
    for (const [side, png] of Object.entries(pictures[name])) writeFileSync(path.join(out, `${name}.${side}.png`), png);
    const compared = comparePairs(pixels[name]);
    const wrong = cellsOf(wrongOf(compared));
    const most = Math.max(...compared.map(({ degrees }) => degrees));
    const least = Math.min(...compared.map(({ contrast }) => contrast));
    console.log(`${name}: ${wrong.size} of ${MAPPED_CELLS} cells wrong; lit sides differ by at most ${most.toFixed(1)} degrees, ` +
        `contrast is at least ${least.toFixed(2)} of the dome's`);
    const fail = (what) => { ++failures; console.log(`FAILED ${name}: ${what}`); };
    if (missingDomes(compared).length > 0) fail("the picture does not show the domes of triangles where they are");
    if (role === "right" && wrong.size > 0) fail(`wrong cells: ${[...wrong].join("; ")}`);
    if (role === "inverted" && wrong.size !== MAPPED_CELLS) fail("all signs are inverted, and not every cell is found wrong");
}
process.exitCode = failures === 0 ? 0 : 1;
