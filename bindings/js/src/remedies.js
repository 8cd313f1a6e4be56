// SPDX-License-Identifier: MIT
// Remedies of findings as calls of tspace/gltf.
import { camelCase } from "./error.js";

/** Returns the options of a call as text: `{ overwriteNormals: true, crease: "60" }`. */
const optionsText = (options) =>
  `{ ${options.map(({ name, value }) => `${camelCase(name)}: ${value === "" ? "true" : JSON.stringify(value)}`).join(", ")} }`;

export function remedyText({ remedy, commands }) {
  let text = "", rest = remedy;
  for (const { verb, line, options } of commands) {
    const at = rest.indexOf(line);
    // Among the commands in remedies, only generate is available as a function.
    text += rest.slice(0, at) + (verb !== "generate" ? line : options.length === 0 ? "generate(model)" : `generate(model, ${optionsText(options)})`);
    rest = rest.slice(at + line.length);
  }
  return text + rest;
}
