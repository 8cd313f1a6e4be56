// SPDX-License-Identifier: MIT
// Computation of normals, for the entries that support it.
import { givenMesh, keepReport, meshOf, setMesh } from "./calls.js";
import { boolean, choice, count, fail, failType, integers, isMissing, optionsOf, valueOr } from "./check.js";
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

/**
 * Returns a number for the module, in which -1 means "auto". Callers cannot pass -1: it becomes another negative number,
 * so that the module's error states the valid range.
 */
export function numberOrAuto(value, name) {
  if (value === "auto") return -1;
  if (typeof value !== "number" || value !== value) failType(value, name, 'a number or "auto"');
  return value < 0 ? -2 : value;
}

/**
 * Checks the options of normals. Returns a function that passes them to the module of a call. `isWhole`: the module is
 * that of "tspace/normals", which supports all options.
 */
export function normalSetter(options, isWhole) {
  for (const [name, given] of [["creaseAngle", options.creaseAngle === "auto"], ["denoise", options.denoise === "auto" || options.denoise > 0]])
    if (given && !isWhole) fail("invalidOption", `${name}: ${options[name]} is only supported by generateNormals of "tspace/normals"`);
  const groups = integers(options.smoothingGroups, "smoothingGroups");
  const before = [choice(valueOr(options.weighting, "angle"), "weighting", normalWeightingNames), numberOrAuto(valueOr(options.creaseAngle, 180), "creaseAngle")];
  const after = [
    boolean(valueOr(options.smoothingGroupsAreMasks, false), "smoothingGroupsAreMasks"),
    boolean(valueOr(options.weldPositions, true), "weldPositions"),
    conventionBits(valueOr(options.convention, "gltf")), // only handedness and winding are used
    count(valueOr(options.refine, 2), "refine"),
    numberOrAuto(valueOr(options.denoise, 0), "denoise"),
    numberOrAuto(valueOr(options.weldDistance, 0), "weldDistance"),
  ];
  return (call) => call.wasm.setNormalOptions(...before, call.put(groups, Uint32Array), groups?.length ?? 0, ...after);
}

/** Creates generateNormals for an entry. */
export const normalsOf = (wasm, isWhole) => function generateNormals(mesh, options = {}) {
  optionsOf(options, [...normalOptions, "convention", "report"]);
  const setOptions = normalSetter(options, isWhole);
  const { positions, indices, faceSizes } = givenMesh(mesh);
  const checked = meshOf({ positions, indices, faceSizes });
  return wasm.run((call) => {
    setMesh(call, checked);
    const out = call.allocate(checked.cornerCount * 12 + 16);
    setOptions(call);
    call.check(call.wasm.generateNormals(out));
    keepReport(call, options, normalReportNames, ignoredNormalOptions(options));
    return call.get(Float32Array, out, checked.cornerCount * 3);
  });
};
