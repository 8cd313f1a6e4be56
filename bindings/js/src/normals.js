// SPDX-License-Identifier: MIT
// The entry "tspace/normals": preparation of scans, AI-generated meshes and CAD data before tangents.
import { source } from "#normals";
import { givenMesh, meshOf, setMesh } from "./calls.js";
import { boolean, optionsOf, valueOr } from "./check.js";
import { conventionBits } from "./convention.js";
import { normalsOf, numberOrAuto } from "./normal_calls.js";
import { positionNoiseNames, windingReportNames } from "./report_names.js";
import { Wasm } from "./wasm.js";

export { conventions } from "./convention.js";
export { TspaceError } from "./error.js";

const wasm = new Wasm();
export const ready = wasm.start(source);
export const release = () => wasm.release();

export const generateNormals = normalsOf(wasm, true);

export function measurePositionNoise(mesh) {
  const { positions, indices, faceSizes } = givenMesh(mesh);
  const checked = meshOf({ positions, indices, faceSizes });
  return wasm.run((call) => {
    setMesh(call, checked);
    call.check(call.wasm.measurePositionNoise());
    const noise = {};
    call.report(positionNoiseNames, noise);
    return noise;
  });
}

/** Returns the indices with flipped faces: their corners are reversed, except for the first. */
function turnedIndices({ indices, faceSizes, cornerCount }, turned) {
  const made = indices ? indices.slice() : Uint32Array.from({ length: cornerCount }, (_, corner) => corner);
  for (let face = 0, first = 0; face < turned.length; ++face) {
    const size = faceSizes ? faceSizes[face] : 3;
    if (turned[face]) made.subarray(first + 1, first + size).reverse();
    first += size;
  }
  return made;
}

export function fixWinding(mesh, options = {}) {
  optionsOf(options, ["useNormals", "weldPositions", "weldDistance", "convention"]);
  const given = [
    boolean(valueOr(options.useNormals, true), "useNormals"),
    boolean(valueOr(options.weldPositions, true), "weldPositions"),
    conventionBits(valueOr(options.convention, "gltf")), // only handedness and winding are used
    numberOrAuto(valueOr(options.weldDistance, 0), "weldDistance"),
  ];
  const { positions, normals, indices, faceSizes, normalIndices } = givenMesh(mesh);
  const checked = meshOf({ positions, normals, indices, faceSizes, normalIndices });
  return wasm.run((call) => {
    setMesh(call, checked);
    const faceCount = checked.faceSizes ? checked.faceSizes.length : Math.floor(checked.cornerCount / 3);
    const out = call.allocate(faceCount + 16);
    call.check(call.wasm.mendWinding(...given, out));
    const report = {};
    call.report(windingReportNames, report);
    const turned = call.get(Uint8Array, out, faceCount);
    return { indices: turnedIndices(checked, turned), turned, report };
  });
}

export const mendWinding = fixWinding; // the former name of fixWinding
