// SPDX-License-Identifier: MIT
// What check finds of damage that was done to sound models, and that it finds nothing on these: as a table.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { test } from "node:test";
import { checkFile, codes, codesOf, damages, models, writeModel } from "./recall/corpus.mjs";
import { isLong, noTool, shared, tool } from "./support.mjs";

test("check finds 95 % of each damage, and nothing on sound models", { skip: noTool || (!isLong && "only with --long"), timeout: 1_800_000 }, (t) => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-recall-"));
  const counts = Object.fromEntries(Object.keys(damages).map((damage) => [damage, { made: 0, found: 0, named: 0, missed: [] }]));
  const alarms = [];
  try {
    for (const [i, model] of models.entries()) {
      const name = `${i}-${basename(model).replace(/\.\w+$/, "")}`;
      const made = writeModel(tool, join(shared, "models", model), folder, name);
      const seen = (kind) => codesOf(checkFile(tool, join(folder, `${name}-${kind}.glb`)));
      const alarm = seen("sound").filter((code) => codes.includes(code));
      if (alarm.length > 0) alarms.push(`${model}: ${alarm.join(", ")}`);
      for (const damage of made) {
        const own = seen(damage), { named, found } = damages[damage], count = counts[damage];
        count.made += 1;
        const isNamed = named.some((code) => own.includes(code));
        count.named += isNamed;
        if (isNamed || found.some((code) => own.includes(code))) count.found += 1;
        else count.missed.push(name);
      }
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
  for (const [damage, { made, found, named, missed }] of Object.entries(counts)) t.diagnostic(`${damage}: ${found} of ${made} found, ${named} by name${missed.length > 0 ? `; missed in ${missed.join(", ")}` : ""}`);
  t.diagnostic(`false alarms: ${alarms.length} of ${models.length} sound models`);
  assert.deepEqual(alarms, []);
  assert.equal(models.length, 20);
  for (const [damage, { made, found }] of Object.entries(counts)) assert.ok(made >= 10 && found >= 0.95 * made, `${damage}: ${found} of ${made}`);
});
