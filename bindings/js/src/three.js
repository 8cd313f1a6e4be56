// SPDX-License-Identifier: MIT
// The entry "tspace/three": tangents for a BufferGeometry, which comes back indexed.
import { BufferAttribute, BufferGeometry } from "three";
import { typeError } from "./error.js";
import { gather } from "./gather.js";
import { makeIndexedFrames, ready, TspaceError } from "./index.js";

export { ready };

/** Numbers of an attribute without gaps, as floats: interleaved and normalised ones are read one by one. */
function readFloats(attribute, size) {
  if (attribute.array instanceof Float32Array && !attribute.isInterleavedBufferAttribute && attribute.itemSize === size)
    return attribute.array.subarray(0, size * attribute.count);
  const numbers = new Float32Array(size * attribute.count);
  for (let i = 0; i < attribute.count; ++i)
    for (let k = 0; k < size; ++k) numbers[size * i + k] = attribute.getComponent(i, k);
  return numbers;
}

function gathered(attribute, sources) {
  const { itemSize, normalized } = attribute;
  if (!attribute.isInterleavedBufferAttribute)
    return new BufferAttribute(gather(attribute.array, itemSize, sources), itemSize, normalized);
  // Numbers as they are stored, out of the array that several attributes share.
  const { array, stride } = attribute.data;
  const own = new array.constructor(sources.length * itemSize);
  sources.forEach((v, i) => {
    for (let k = 0; k < itemSize; ++k) own[itemSize * i + k] = array[stride * v + attribute.offset + k];
  });
  return new BufferAttribute(own, itemSize, normalized);
}

/** The geometry, or that of a mesh. */
function geometryOf(given) {
  const geometry = given?.isMesh ? given.geometry : given;
  if (geometry?.isBufferGeometry) return geometry;
  throw typeError("wrongType", `geometry must be a BufferGeometry or a Mesh, not ${given?.type ?? typeof given}`);
}

export function computeTangents(given, options = {}) {
  const geometry = geometryOf(given);
  const { position, normal, uv } = geometry.attributes;
  if (!position) throw new TspaceError("missingAttribute", "the geometry has no attribute position");
  if (!uv && options.method !== "basis")
    throw new TspaceError("missingAttribute", 'the geometry has no attribute uv: only the method "basis" needs none');
  const made = makeIndexedFrames(
    {
      positions: readFloats(position, 3),
      normals: normal && readFloats(normal, 3),
      uvs: uv && readFloats(uv, 2),
      indices: geometry.index && Uint32Array.from(geometry.index.array),
    },
    options,
  );
  const result = new BufferGeometry();
  result.name = geometry.name;
  result.userData = { ...geometry.userData };
  for (const [name, attribute] of Object.entries(geometry.attributes)) result.setAttribute(name, gathered(attribute, made.sourceVertices));
  for (const [name, list] of Object.entries(geometry.morphAttributes))
    result.morphAttributes[name] = list.map((attribute) => gathered(attribute, made.sourceVertices));
  result.morphTargetsRelative = geometry.morphTargetsRelative;
  result.setIndex(new BufferAttribute(made.indices, 1));
  if (!normal || options.makeNormals) result.setAttribute("normal", new BufferAttribute(made.normals, 3));
  result.setAttribute("tangent", new BufferAttribute(made.tangents, 4));
  for (const { start, count, materialIndex } of geometry.groups) result.addGroup(start, count, materialIndex);
  result.setDrawRange(geometry.drawRange.start, geometry.drawRange.count);
  return result;
}
