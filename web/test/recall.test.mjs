// SPDX-License-Identifier: MIT
// Tests that check finds most of the damage in damaged models, and none in intact ones. Prints a table for the tool and
// the page.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { test } from "node:test";
import { checkFile, codes, codesOf, damages, models, writeModel } from "./recall/corpus.mjs";
import { isLong, noTool, shared, tool, withPage } from "./support.mjs";

/** Returns the report of the page's worker, without drawing. */
const checkInPage = (tab, path) => tab.evaluate(async ([name, text]) => {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return window.tspaceView.work.run("report", { verb: "check", model: { name, bytes, others: new Map() } });
}, [basename(path), readFileSync(path).toString("base64")]);

const codesAndPlaces = ({ findings }) => findings.map(({ code, severity, place }) => `${severity} ${code} ${place}`).join(", ");

/** Counts the damage that one program finds in all models, and its findings in undamaged ones. */
class Tally {
  counts = Object.fromEntries(Object.keys(damages).map((damage) => [damage, { made: 0, found: 0, named: 0, missed: [] }]));
  alarms = [];

  sound(name, seen) {
    const alarm = seen.filter((code) => codes.includes(code));
    if (alarm.length > 0) this.alarms.push(`${name}: ${alarm.join(", ")}`);
  }

  damaged(name, damage, seen) {
    const { named, found } = damages[damage], count = this.counts[damage], isNamed = named.some((code) => seen.includes(code));
    count.made += 1;
    count.named += isNamed;
    if (isNamed || found.some((code) => seen.includes(code))) count.found += 1;
    else count.missed.push(name);
  }

  tell(t, who) {
    for (const [damage, { made, found, named, missed }] of Object.entries(this.counts)) t.diagnostic(`${who}, ${damage}: ${found} of ${made} found, ${named} by name${missed.length > 0 ? `; missed in ${missed.join(", ")}` : ""}`);
    t.diagnostic(`${who}, false alarms: ${this.alarms.length} of ${models.length} sound models`);
  }
}

test("tool and page find the same 95 % of each damage, and nothing on correct models", { skip: noTool || (!isLong && "only with --long"), timeout: 3_600_000 }, async (t) => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-recall-")), ofTool = new Tally(), ofPage = new Tally(), unlike = [], reworded = [];
  try {
    await withPage(async (tab) => {
      for (const [i, model] of models.entries()) {
        const name = `${i}-${basename(model).replace(/\.\w+$/, "")}`;
        const made = writeModel(tool, join(shared, "models", model), folder, name);
        for (const kind of ["sound", ...made]) {
          const path = join(folder, `${name}-${kind}.glb`), [own, seen] = [checkFile(tool, path), await checkInPage(tab, path)];
          for (const [tally, report] of [[ofTool, own], [ofPage, seen]]) {
            if (kind === "sound") tally.sound(name, codesOf(report));
            else tally.damaged(name, kind, codesOf(report));
          }
          if (codesAndPlaces(seen) !== codesAndPlaces(own)) unlike.push(`${name}-${kind}: ${codesAndPlaces(seen)} in the page, ${codesAndPlaces(own)} by the tool`);
          else if (JSON.stringify(seen.findings) !== JSON.stringify(own.findings)) reworded.push(`${name}-${kind}`);
        }
      }
    });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
  ofTool.tell(t, "tool");
  ofPage.tell(t, "page");
  t.diagnostic(`the same findings with other numbers: ${reworded.join(", ") || "none"}`);
  assert.deepEqual(unlike, []);
  for (const { alarms, counts } of [ofTool, ofPage]) {
    assert.deepEqual(alarms, []);
    for (const [damage, { made, found }] of Object.entries(counts)) assert.ok(made >= 10 && found >= 0.95 * made, `${damage}: ${found} of ${made}`);
  }
  assert.equal(models.length, 20);
});
