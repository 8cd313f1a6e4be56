// SPDX-License-Identifier: MIT
// Calls shared by the entries, parameterized by the loaded module.
import { boolean, choice, count, fail, failType, floats, integers, isMissing, number, numberWithin, object, optionsOf, output, valueOr } from "./check.js";
import { conventionBits } from "./convention.js";
import { frameShapeNames, pairingNames, sanitizeReportNames, tangentReportNames } from "./names.js";

const meshMembers = ["positions", "normals", "uvs", "indices", "faceSizes", "normalIndices", "uvIndices"];
/** Checks a caller's mesh (or pose): an object whose members are all valid mesh members. */
export const givenMesh = (mesh, name = "mesh") => object(mesh, name, meshMembers);

/** Returns the checked mesh of a call. */
export function meshOf(mesh, needsNormals = false) {
  givenMesh(mesh);
  const positions = floats(mesh.positions, "positions", 3, true);
  const indices = integers(mesh.indices, "indices");
  return {
    positions,
    normals: floats(mesh.normals, "normals", 3, needsNormals),
    uvs: floats(mesh.uvs, "uvs", 2),
    indices,
    faceSizes: integers(mesh.faceSizes, "faceSizes"),
    normalIndices: integers(mesh.normalIndices, "normalIndices"),
    uvIndices: integers(mesh.uvIndices, "uvIndices"),
    vertexCount: positions.length / 3,
    cornerCount: indices ? indices.length : positions.length / 3,
  };
}

export function setMesh(call, { positions, normals, uvs, ...lists }) {
  const { indices, faceSizes, normalIndices, uvIndices } = lists;
  const arrays = [
    call.put(positions), positions.length / 3,
    call.put(normals), (normals?.length ?? 0) / 3,
    call.put(uvs), (uvs?.length ?? 0) / 2,
    call.put(indices, Uint32Array), indices?.length ?? 0,
    call.put(faceSizes, Uint32Array), faceSizes?.length ?? 0,
    call.put(normalIndices, Uint32Array), normalIndices?.length ?? 0,
    call.put(uvIndices, Uint32Array), uvIndices?.length ?? 0,
  ];
  call.wasm.setMesh(...arrays);
}

/** Names of tangent options. */
export const mikktspaceOptions = ["method", "threshold", "pairing", "ngons", "convention", "normalizeNormals"];

/** Returns the arguments of the module's setTangentOptions. */
export function tangentArguments(options, { methods, ngons }) {
  return [
    choice(valueOr(options.method, "mikktspace"), "method", methods),
    numberWithin(valueOr(options.threshold, 180), "threshold", 0, 360, " degrees"),
    choice(valueOr(options.pairing, "reference"), "pairing", pairingNames),
    choice(valueOr(options.ngons, ngons[0]), "ngons", ngons),
    conventionBits(options.convention),
    choice(valueOr(options.frame, "gramSchmidt"), "frame", frameShapeNames),
    count(valueOr(options.refine, 1), "refine"),
    boolean(valueOr(options.normalizeNormals, false), "normalizeNormals"),
  ];
}

/** For each option that only one method uses: the name of that method. */
const readers = { threshold: "mikktspace", pairing: "mikktspace", refine: "best" };

/** Returns the names of given options that the method does not use. */
export const ignoredOptions = ({ method = "mikktspace", ...options }) =>
  Object.keys(readers).filter((name) => !isMissing(options[name]) && readers[name] !== method);

/** Adds the names of ignored options to the report, if there are any. */
export function withIgnored(report, names) {
  if (names.length !== 0) report.ignoredOptions = names;
  else delete report.ignoredOptions;
  return report;
}

/** Fills in options.report, if given. */
export function keepReport(call, { report }, names, ignored) {
  if (report) withIgnored(call.report(names, report), ignored);
}

/**
 * Runs compute(exports, tangents, mask), which writes four floats per output and, unless the mask address is 0, a byte
 * per output.
 */
export function writeTangents(wasm, mesh, outputCount, options, compute) {
  const hasTangent = output(options.hasTangent, "hasTangent", outputCount);
  return wasm.run((call) => {
    setMesh(call, mesh);
    const out = call.allocate(outputCount * 16);
    const mask = hasTangent ? call.allocate(outputCount) : 0;
    call.check(compute(call.wasm, out, mask));
    keepReport(call, options, tangentReportNames, ignoredOptions(options));
    hasTangent?.set(new Uint8Array(call.wasm.memory.buffer, mask, outputCount));
    return call.get(Float32Array, out, outputCount * 4);
  });
}

function attributeOf(attribute, i, cornerCount) {
  const name = `attribute ${i}`;
  const { size, tolerance = 0 } = object(attribute, name, ["data", "size", "tolerance"]);
  count(size, `size of ${name}`);
  const data = floats(attribute.data, name, Math.max(size, 1), true);
  if (size * cornerCount !== data.length) {
    const needed = `${size} for each of the ${cornerCount} corners`;
    fail("countMismatch", `${name} has ${data.length} numbers, but needs ${size * cornerCount}: ${needed}`, i);
  }
  return { data, size, tolerance: number(tolerance, `tolerance of ${name}`) };
}

/** Writes the table of attributes that the module reads, followed by space for the six words of the result. */
function putAttributes(call, list) {
  const places = list.map(({ data }) => call.put(data));
  const table = call.allocate(12 * list.length + 24);
  const view = new DataView(call.wasm.memory.buffer, table);
  list.forEach(({ size, tolerance }, i) => {
    view.setUint32(12 * i, places[i], true);
    view.setUint32(12 * i + 4, size, true);
    view.setFloat32(12 * i + 8, tolerance, true);
  });
  return table;
}

export function makeCalls(wasm, choices) {
  return {
    generateTangents(mesh, options = {}) {
      optionsOf(options, [...choices.options, "hasTangent", "report"]);
      const given = tangentArguments(options, choices);
      const checked = meshOf(mesh);
      return writeTangents(wasm, checked, checked.cornerCount, options, (module, ...places) => {
        module.setTangentOptions(...given);
        return module.generateTangents(...places);
      });
    },

    sanitizeTangents(mesh, tangents, options = {}) {
      optionsOf(options, ["orthogonalizeAll", "report"]);
      const all = boolean(valueOr(options.orthogonalizeAll, false), "orthogonalizeAll");
      const checked = meshOf(mesh, true);
      const given = floats(tangents, "tangents", 4, true);
      return wasm.run((call) => {
        setMesh(call, checked);
        const place = call.put(given);
        call.check(call.wasm.sanitizeTangents(place, given.length / 4, all));
        keepReport(call, options, sanitizeReportNames, []);
        return call.get(Float32Array, place, given.length);
      });
    },

    splitVertices(vertices, attributes) {
      const { vertexCount } = object(vertices, "vertices", ["indices", "vertexCount"]);
      const indices = integers(vertices.indices, "indices");
      count(vertexCount, "vertexCount");
      if (!Array.isArray(attributes)) failType(attributes, "attributes", "an array of { data, size, tolerance }");
      const cornerCount = indices ? indices.length : vertexCount;
      const list = Array.from(attributes, (attribute, i) => attributeOf(attribute, i, cornerCount));
      return wasm.run((call) => {
        const at = call.put(indices, Uint32Array);
        const table = putAttributes(call, list);
        const result = table + 12 * list.length;
        call.check(call.wasm.splitVertices(at, vertexCount, cornerCount, table, list.length, result));
        const words = call.get(Uint32Array, result, 6);
        const [newIndices, sourceVertices, sourceCorners] = [0, 2, 4].map((i) =>
          call.take(Uint32Array, words[i], words[i + 1]));
        return { indices: newIndices, sourceVertices, sourceCorners };
      });
    },
  };
}
