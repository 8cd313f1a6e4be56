// SPDX-License-Identifier: MIT
// validate.mjs VALIDATOR PAIRS: for each "input TAB output" in the file PAIRS, the output may have no error or warning
// of the Khronos validator that the input does not have. With "-" as input it may have none at all.
//
// A finding is its code and, if it concerns an accessor, the uses of that accessor: "NORMAL ACCESSOR_VECTOR3_NON_UNIT".
// The number of occurrences does not matter: splitting a vertex repeats its errors.
//
// validate.mjs VALIDATOR PAIRS --tangents: the outputs may have no error about tangents, whatever the inputs have.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const WARNING = 1; // the validator's severities: 0 error, 1 warning, 2 information, 3 hint

const [validatorFolder, pairsFile, only] = process.argv.slice(2);
const validator = createRequire(import.meta.url)(path.resolve(validatorFolder));

function readJson(bytes) {
    const isGlb = bytes.toString("latin1", 0, 4) === "glTF";
    return JSON.parse(String(isGlb ? bytes.subarray(20, 20 + bytes.readUInt32LE(12)) : bytes).replace(/^\uFEFF/, ""));
}

/// Returns the uses of each accessor: index -> set of "POSITION", "target NORMAL", "indices", ...
function accessorUses(gltf) {
    const uses = new Map();
    const add = (accessor, use) => uses.set(accessor, (uses.get(accessor) ?? new Set()).add(use));
    for (const primitive of (gltf.meshes ?? []).flatMap((mesh) => mesh.primitives ?? [])) {
        if (primitive.indices !== undefined) add(primitive.indices, "indices");
        for (const [name, accessor] of Object.entries(primitive.attributes ?? {})) add(accessor, name);
        for (const target of primitive.targets ?? [])
            for (const [name, accessor] of Object.entries(target)) add(accessor, `target ${name}`);
    }
    return uses;
}

async function findings(file) {
    const bytes = readFileSync(file);
    const report = await validator.validateBytes(new Uint8Array(bytes), {
        uri: path.basename(file),
        maxIssues: 0, // no limit
        externalResourceFunction: async (uri) =>
            new Uint8Array(readFileSync(path.join(path.dirname(file), decodeURIComponent(uri)))),
    });
    const serious = report.issues.messages.filter((message) => message.severity <= WARNING);
    if (serious.length === 0) return new Map();
    const uses = accessorUses(readJson(bytes));
    const found = new Map();
    for (const { code, message, pointer = "" } of serious) {
        const accessor = /^\/accessors\/(\d+)/.exec(pointer);
        for (const use of (accessor && uses.get(Number(accessor[1]))) ?? [""])
            found.set(`${use} ${code}`.trim(), `${pointer}: ${message}`);
    }
    return found;
}

/// Returns the errors of tangents: at a TANGENT of a primitive or morph target, or at an accessor used as one.
async function tangentErrors(file) {
    const bytes = readFileSync(file);
    let report;
    try {
        report = await validator.validateBytes(new Uint8Array(bytes), {
            uri: path.basename(file),
            maxIssues: 0,
            externalResourceFunction: async (uri) =>
                new Uint8Array(readFileSync(path.join(path.dirname(file), decodeURIComponent(uri)))),
        });
    } catch (error) {
        return []; // not JSON, or not glTF 2.0
    }
    // Wrong declared bounds do not count as errors of the tangents: tangents that are kept also keep their bounds.
    const isOfBounds = /^ACCESSOR_(M(IN|AX)_MISMATCH|ELEMENT_OUT_OF_M(IN|AX)_BOUND)$/;
    const errors = report.issues.messages.filter(({ severity, code }) => severity === 0 && !isOfBounds.test(code));
    if (errors.length === 0) return [];
    const uses = accessorUses(readJson(bytes));
    return errors.filter(({ pointer = "" }) => {
        const accessor = /^\/accessors\/(\d+)/.exec(pointer);
        const names = accessor ? [...(uses.get(Number(accessor[1])) ?? [])] : [];
        return /\/TANGENT(\/|$)/.test(pointer) || names.some((name) => name.endsWith("TANGENT"));
    });
}

const pairs = readFileSync(pairsFile, "utf8").split("\n").filter(Boolean).map((line) => line.split("\t"));
let failures = 0;
for (const [input, output] of pairs) {
    if (only === "--tangents") {
        for (const { code, message, pointer } of (await tangentErrors(output)).slice(0, 3)) {
            ++failures;
            console.log(`FAILED ${output} (from ${input}): ${code} at ${pointer}: ${message}`);
        }
        continue;
    }
    const found = await findings(output);
    if (found.size === 0) continue;
    const before = input === "-" ? new Map() : await findings(input);
    for (const [key, example] of found) {
        if (before.has(key)) continue;
        ++failures;
        console.log(`FAILED ${output}: ${key}, which the input does not have: ${example}`);
    }
}
const what = only === "--tangents" ? "errors about tangents" : "new kinds of errors and warnings";
console.log(`${pairs.length} outputs validated, ${failures} ${what}`);
if (pairs.length === 0) process.exit(77);
process.exit(failures === 0 ? 0 : 1);
