// SPDX-License-Identifier: MIT
// The entry "tspace/three": tangents for a BufferGeometry; the result is indexed.
import { BufferAttribute, BufferGeometry, InstancedBufferGeometry } from "three";
import { typeError } from "./error.js";
import { gather } from "./gather.js";
import { makeIndexedFrames, ready, release, TspaceError } from "./index.js";

export { ready, release };

/**
 * Returns the values of an attribute as contiguous floats; converts half floats, normalized and interleaved attributes.
 */
function readFloats(attribute, size) {
  if (attribute.array instanceof Float32Array && !attribute.isInterleavedBufferAttribute && attribute.itemSize === size)
    return attribute.array.subarray(0, size * attribute.count);
  const numbers = new Float32Array(size * attribute.count);
  const getters = ["getX", "getY", "getZ"].slice(0, size); // getComponent does not convert half floats
  for (let i = 0; i < attribute.count; ++i) getters.forEach((get, k) => (numbers[size * i + k] = attribute[get](i)));
  return numbers;
}

/** Returns an attribute with another array, but the same class and settings. */
function withArray(attribute, array) {
  const { itemSize, normalized, name, usage, gpuType } = attribute;
  const Class = attribute.array.constructor === array.constructor ? attribute.constructor : BufferAttribute;
  return Object.assign(new Class(array, itemSize, normalized), { name, usage, gpuType });
}

/** Copies elements of an interleaved attribute, without conversion, to a separate array. */
function gatherInterleaved({ data, offset, itemSize }, sources) {
  const own = new data.array.constructor(sources.length * itemSize);
  sources.forEach((v, i) => {
    for (let k = 0; k < itemSize; ++k) own[itemSize * i + k] = data.array[data.stride * v + offset + k];
  });
  return own;
}

/**
 * Returns the attribute for the new vertices. Instanced attributes are cloned. `shared`: cache of interleaved buffers
 * that clones share.
 */
function gathered(attribute, sources, shared) {
  if (attribute.isInstancedBufferAttribute || attribute.data?.isInstancedInterleavedBuffer) return attribute.clone(shared);
  if (!attribute.isInterleavedBufferAttribute) return withArray(attribute, gather(attribute.array, attribute.itemSize, sources));
  const { itemSize, normalized, name, data } = attribute;
  const own = new BufferAttribute(gatherInterleaved(attribute, sources), itemSize, normalized);
  return Object.assign(own, { name, usage: data.usage });
}

/** Returns 2 to the power of the number of value bits of an integer type; 0 for other types. */
const rangeOf = (Type) => (/^(Ui|I)nt/.test(Type?.name) ? 2 ** (8 * Type.BYTES_PER_ELEMENT - (Type.name[0] === "I")) : 0);

/**
 * Returns an index of the previous type, or of a wider type if necessary. The maximum of a type is not used as an
 * index.
 */
function indexAttribute(given, indices, vertexCount) {
  const before = given?.array.constructor, narrow = rangeOf(before) > 0 && before.BYTES_PER_ELEMENT === 1 ? [Uint8Array] : [];
  const Type = [before, ...narrow, Uint16Array, Uint32Array].find((Type) => vertexCount < rangeOf(Type));
  const array = Type.from(indices);
  return given ? withArray(given, array) : new BufferAttribute(array, 1);
}

/** Returns whether the type of an attribute can store unit vectors. */
const storesUnitVectors = ({ array, normalized, isFloat16BufferAttribute }) =>
  /^Float/.test(array.constructor.name) || isFloat16BufferAttribute || (normalized && /^Int/.test(array.constructor.name));

/** Returns the normals as an attribute: the given one (of the new vertices) with new values, if its type permits this. */
function normalAttribute(given, normals) {
  if (!given || given.count !== normals.length / 3 || !storesUnitVectors(given)) return new BufferAttribute(normals, 3);
  for (let i = 0; i < given.count; ++i) given.setXYZ(i, normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
  return given;
}

/** Returns the geometry, or the geometry of a mesh. */
function geometryOf(given) {
  const geometry = given?.isMesh ? given.geometry : given;
  if (geometry?.isBufferGeometry) return geometry;
  throw typeError("wrongType", `geometry must be a BufferGeometry or a Mesh, not ${given?.type ?? typeof given}`);
}

/** Returns a geometry without attributes and with all other properties of the given one. */
function emptyLike(geometry) {
  const result = geometry.isInstancedBufferGeometry ? new InstancedBufferGeometry() : new BufferGeometry();
  if (geometry.isInstancedBufferGeometry) result.instanceCount = geometry.instanceCount;
  result.name = geometry.name;
  result.userData = { ...geometry.userData };
  result.morphTargetsRelative = geometry.morphTargetsRelative;
  result.boundingBox = geometry.boundingBox?.clone() ?? null;
  result.boundingSphere = geometry.boundingSphere?.clone() ?? null;
  for (const { start, count, materialIndex } of geometry.groups) result.addGroup(start, count, materialIndex);
  result.setDrawRange(geometry.drawRange.start, geometry.drawRange.count);
  return result;
}

export function computeTangents(given, options = {}) {
  const geometry = geometryOf(given);
  const { position, normal, uv } = geometry.attributes;
  if (!position) throw new TspaceError("missingAttribute", "the geometry has no attribute position");
  if (!uv && options.method !== "basis")
    throw new TspaceError("missingAttribute", 'the geometry has no attribute uv, which every method except "basis" needs');
  const isMikktspace = (options.method ?? "mikktspace") === "mikktspace";
  const made = makeIndexedFrames(
    {
      positions: readFloats(position, 3),
      normals: normal && readFloats(normal, 3),
      uvs: uv && readFloats(uv, 2),
      indices: geometry.index && Uint32Array.from(geometry.index.array),
    },
    isMikktspace ? { pairing: "corrected", ...options } : options, // same default as three.js's own module
  );
  const result = emptyLike(geometry), sources = made.sourceVertices, shared = {};
  for (const [name, attribute] of Object.entries(geometry.attributes)) result.setAttribute(name, gathered(attribute, sources, shared));
  for (const [name, list] of Object.entries(geometry.morphAttributes))
    result.morphAttributes[name] = list.map((attribute) => gathered(attribute, sources, shared));
  result.setIndex(indexAttribute(geometry.index, made.indices, sources.length));
  if (!normal || options.makeNormals) result.setAttribute("normal", normalAttribute(result.attributes.normal, made.normals));
  result.setAttribute("tangent", new BufferAttribute(made.tangents, 4));
  return result;
}
