// SPDX-License-Identifier: MIT
// Validates reports against docs/schema.
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import Ajv from "ajv/dist/2020.js";

const folder = process.env.TSPACE_SCHEMA;
export const hasSchemas = Boolean(folder) && existsSync(folder);
// Types are declared in "properties"; in strict mode ajv would require them again next to "if".
const ajv = new Ajv({ allErrors: true, strictTypes: false });
if (hasSchemas) for (const name of readdirSync(folder)) ajv.addSchema(JSON.parse(readFileSync(join(folder, name))));

function expectValid(value, schema) {
  const isValid = ajv.getSchema(schema);
  assert.ok(isValid, `there is no ${schema}`);
  assert.ok(isValid(value), JSON.stringify(isValid.errors, null, 1));
}

/** Validates a document against its schema. Does nothing without TSPACE_SCHEMA. */
export function expectDocument(document) {
  if (hasSchemas) expectValid(document, `${document.schema.replace("/", ".")}.json`);
}

/**
 * Validates the result of the function `verb` of tspace/gltf against the schema of a file's entry. The result of diff
 * is a whole document.
 */
export function expectReport(verb, report) {
  if (verb === "diff") return expectDocument(report);
  const { exitCode, ...entry } = report;
  assert.ok(exitCode === 0 || exitCode === 1);
  if (hasSchemas) expectValid(entry, `tspace.${verb}.1.json#/$defs/${verb[0].toUpperCase()}${verb.slice(1)}Report`);
}
