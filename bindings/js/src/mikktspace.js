// SPDX-License-Identifier: MIT
// The entry "tspace/mikktspace": one method, with sanitizing and vertex splitting, half the size of the complete core.
import { source } from "#mikktspace";
import { makeCalls, mikktspaceOptions } from "./calls.js";
import { fail } from "./check.js";
import { Wasm } from "./wasm.js";

export { conventions } from "./convention.js";
export { TspaceError } from "./error.js";

const wasm = new Wasm();
export const ready = wasm.start(source);
export const release = () => wasm.release();

const calls = makeCalls(wasm, { methods: ["mikktspace"], ngons: ["skip"], options: mikktspaceOptions });
export const { splitVertices } = calls;

function withoutLists(mesh) {
  for (const name of ["normalIndices", "uvIndices"])
    if (mesh?.[name]) fail("invalidOption", `${name}: this entry supports only one index list; use the entry "tspace" for one list per attribute`);
  return mesh;
}

export const generateTangents = (mesh, options) => calls.generateTangents(withoutLists(mesh), options);
export const sanitizeTangents = (mesh, tangents, options) =>
  calls.sanitizeTangents(withoutLists(mesh), tangents, options);
