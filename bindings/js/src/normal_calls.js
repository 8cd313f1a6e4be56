// SPDX-License-Identifier: MIT
// Computation of normals, for the entries that support it.
import { givenMesh, keepReport, meshOf, setMesh } from "./calls.js";
import { boolean, choice, count, fail, integers, isMissing, number, optionsOf } from "./check.js";
import { conventionBits } from "./convention.js";
import { normalReportNames, normalWeightingNames } from "./names.js";

export const normalOptions = ["weighting", "creaseAngle", "smoothingGroups", "smoothingGroupsAreMasks", "weldPositions", "weldDistance", "refine", "denoise"];

/** Returns the names of given options that the weighting does not use. */
export function ignoredNormalOptions({ weighting = "angle", ...options }) {
  const ignored = weighting === "flat" ? ["creaseAngle", "smoothingGroups", "smoothingGroupsAreMasks", "weldPositions", "weldDistance"] : [];
  if (weighting !== "best") ignored.push("refine", "denoise");
  if (options.weldPositions === false) ignored.push("weldDistance");
  if (isMissing(options.smoothingGroups)) ignored.push("smoothingGroupsAreMasks");
  return normalOptions.filter((name) => !isMissing(options[name]) && ignored.includes(name));
}

export const numberOrAuto = (value, name) => (value === "auto" ? -1 : number(value, name));

/**
 * Checks the options of normals. Returns a function of a call that copies the smoothing groups to the module's memory
 * and returns the arguments. `isWhole`: the module is that of "tspace/normals", which supports all options.
 */
export function normalArguments(options, isWhole) {
  for (const [name, given] of [["creaseAngle", options.creaseAngle === "auto"], ["denoise", (options.denoise ?? 0) !== 0]])
    if (given && !isWhole) fail("invalidOption", `${name}: ${options[name]} is only supported by generateNormals of "tspace/normals"`);
  const groups = integers(options.smoothingGroups, "smoothingGroups");
  const before = [choice(options.weighting ?? "angle", "weighting", normalWeightingNames), numberOrAuto(options.creaseAngle ?? 180, "creaseAngle")];
  const after = [
    boolean(options.smoothingGroupsAreMasks ?? false, "smoothingGroupsAreMasks"),
    boolean(options.weldPositions ?? true, "weldPositions"),
    conventionBits(options.convention ?? "gltf"), // only handedness and winding are used
    count(options.refine ?? 2, "refine"),
    numberOrAuto(options.denoise ?? 0, "denoise"),
    numberOrAuto(options.weldDistance ?? 0, "weldDistance"),
  ];
  return (call) => [...before, call.put(groups, Uint32Array), groups?.length ?? 0, ...after];
}

/** Creates generateNormals for an entry. */
export const normalsOf = (wasm, isWhole) => function generateNormals(mesh, options = {}) {
  optionsOf(options, [...normalOptions, "convention", "report"]);
  const given = normalArguments(options, isWhole);
  const { positions, indices, faceSizes } = givenMesh(mesh);
  const checked = meshOf({ positions, indices, faceSizes });
  return wasm.run((call) => {
    setMesh(call, checked);
    const out = call.allocate(checked.cornerCount * 12 + 16);
    call.check(call.wasm.generateNormals(...given(call), out));
    keepReport(call, options, normalReportNames, ignoredNormalOptions(options));
    return call.get(Float32Array, out, checked.cornerCount * 3);
  });
};
