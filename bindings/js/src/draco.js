// SPDX-License-Identifier: MIT
// Decodes and encodes Draco with the modules of npm's draco3d. Objects of these modules use the modules' own memory,
// and must be destroyed individually.

const headBytes = 11;
const hasMetadata = 0x8000;
const tooMuch = "the Draco data declares more points, triangles or attributes than the accessors";

/** Component types of glTF. */
const components = new Map([
  [5120, { Type: Int8Array, data: "DT_INT8", add: "AddInt8Attribute" }],
  [5121, { Type: Uint8Array, data: "DT_UINT8", add: "AddUInt8Attribute" }],
  [5122, { Type: Int16Array, data: "DT_INT16", add: "AddInt16Attribute" }],
  [5123, { Type: Uint16Array, data: "DT_UINT16", add: "AddUInt16Attribute" }],
  [5125, { Type: Uint32Array, data: "DT_UINT32", add: "AddUInt32Attribute" }],
  [5126, { Type: Float32Array, data: "DT_FLOAT32", add: "AddFloatAttribute" }],
]);
/** Kinds of attributes, in the order of tspace's enumeration. */
const kinds = ["POSITION", "NORMAL", "COLOR", "TEX_COORD", "GENERIC"];

/** Runs body(own), and destroys all objects that were passed to own(). */
function owning(module, body) {
  const owned = [];
  const own = (object) => {
    owned.push(object);
    return object;
  };
  try {
    return body(own);
  } finally {
    for (const object of owned.reverse()) module.destroy(object);
  }
}

/** Returns the counts that the data declares, before decoding; undefined if metadata precedes them. */
function claimsOf(data, isEdgebreaker) {
  if ((data[headBytes - 2] | (data[headBytes - 1] << 8)) & hasMetadata) return undefined;
  let at = headBytes + (isEdgebreaker ? 1 : 0);
  const number = () => {
    let value = 0, shift = 1;
    do {
      value += (data[at] & 127) * shift;
      shift *= 128;
    } while (data[at++] & 128);
    return value;
  };
  const [first, second] = [number(), number()];
  return isEdgebreaker ? { points: first, faces: second } : { points: second, faces: first };
}

/** Calls read(place) with `bytes` bytes of the module's memory. */
function withMemory(module, bytes, read) {
  const place = module._malloc(bytes);
  try {
    return read(place);
  } finally {
    module._free(place);
  }
}

const copyOf = (module, Type, place, count) => new Type(module.HEAPF32.buffer, place, count).slice();

/** Returns the quantization of an attribute, or undefined if it is not quantized. */
function roundingOf(module, attribute) {
  return owning(module, (own) => {
    const box = own(new module.AttributeQuantizationTransform());
    if (box.InitFromAttribute(attribute)) {
      const origin = Array.from({ length: attribute.num_components() }, (_, i) => box.min_value(i));
      return { bits: box.quantization_bits(), isOctahedral: false, origin, range: box.range() };
    }
    const octahedron = own(new module.AttributeOctahedronTransform());
    if (octahedron.InitFromAttribute(attribute))
      return { bits: octahedron.quantization_bits(), isOctahedral: true, origin: [], range: 0 };
    return undefined;
  });
}

/** Calls read(decoder, mesh) on the data. `skips`: keeps quantized values as integers. */
function withMesh(module, data, skips, read) {
  return owning(module, (own) => {
    const buffer = own(new module.DecoderBuffer());
    buffer.Init(new Int8Array(data.buffer, data.byteOffset, data.length), data.length);
    const decoder = own(new module.Decoder());
    if (skips) for (const kind of kinds) decoder.SkipAttributeTransform(module[kind]);
    const mesh = own(new module.Mesh());
    const status = own(decoder.DecodeBufferToMesh(buffer, mesh));
    return status.ok() ? read(decoder, mesh) : { fault: "the Draco data is damaged" };
  });
}

function readAttribute(module, decoder, mesh, { id, component, componentCount }) {
  const name = `the Draco attribute ${id}`;
  const attribute = decoder.GetAttributeByUniqueId(mesh, id);
  if (attribute.ptr === 0) return { fault: `${name} does not exist` };
  if (attribute.num_components() !== componentCount)
    return { fault: `${name} has a different number of components than its accessor` };
  const { Type, data } = components.get(component);
  const count = mesh.num_points() * componentCount, bytes = count * Type.BYTES_PER_ELEMENT;
  return withMemory(module, bytes, (place) =>
    decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, module[data], bytes, place)
      ? { values: copyOf(module, Type, place, count) }
      : { fault: `the values of ${name} are damaged or cannot be converted to the component type of its accessor` });
}

function readMesh(module, decoder, mesh, limits, wanted) {
  const pointCount = mesh.num_points(), cornerCount = mesh.num_faces() * 3;
  if (pointCount > limits.points || cornerCount > limits.corners) return { fault: tooMuch };
  const corners = withMemory(module, 4 * cornerCount, (place) => {
    decoder.GetTrianglesUInt32Array(mesh, 4 * cornerCount, place);
    return copyOf(module, Uint32Array, place, cornerCount);
  });
  if (corners.some((point) => point >= pointCount))
    return { fault: "a triangle of the Draco data refers to a point that does not exist" };
  const attributes = [];
  for (const attribute of wanted) {
    const read = readAttribute(module, decoder, mesh, attribute);
    if (read.fault) return read;
    attributes.push(read);
  }
  return { pointCount, corners, attributes };
}

/**
 * Decodes corners and the requested attributes; returns { fault } for invalid data. `keepsLattices`: also returns the
 * quantization of the attributes, which requires a second decoding.
 */
export function decodeDraco(module, data, isEdgebreaker, limits, wanted, keepsLattices) {
  const claims = claimsOf(data, isEdgebreaker);
  if (claims && (claims.points > limits.points || 3 * claims.faces > limits.corners)) return { fault: tooMuch };
  try {
    const mesh = withMesh(module, data, false, (decoder, decoded) => readMesh(module, decoder, decoded, limits, wanted));
    if (mesh.fault || !keepsLattices) return mesh;
    return withMesh(module, data, true, (decoder, decoded) => {
      wanted.forEach(({ id }, i) => {
        mesh.attributes[i].rounding = roundingOf(module, decoder.GetAttributeByUniqueId(decoded, id));
      });
      return mesh;
    });
  } catch (error) {
    // The module aborted because it ran out of memory or found unexpected data.
    return { fault: `the Draco data is damaged: ${error.message ?? error}`.replace(/\s+/g, " ") };
  }
}

/** Returns { data, ids }, or undefined if the module cannot encode the mesh. Points and triangles keep their order. */
export function encodeDraco(module, { pointCount, corners, attributes }) {
  return owning(module, (own) => {
    const builder = own(new module.MeshBuilder()), mesh = own(new module.Mesh());
    builder.AddFacesToMesh(mesh, corners.length / 3, corners);
    const ids = attributes.map(({ kind, component, componentCount, normalized, values }) => {
      const { Type, add } = components.get(component);
      const id = builder[add](mesh, module[kinds[kind]], pointCount, componentCount, new Type(values.buffer));
      if (normalized) builder.SetNormalizedFlagForAttribute(mesh, id, true);
      return id;
    });
    if (ids.some((id) => id < 0)) return undefined;
    const encoder = own(new module.ExpertEncoder(mesh));
    encoder.SetEncodingMethod(module.MESH_SEQUENTIAL_ENCODING);
    attributes.forEach(({ component, componentCount, rounding: { bits, isOctahedral, origin, range } }, i) => {
      if (bits === 0 || !(components.get(component).Type === Float32Array)) return;
      if (isOctahedral || origin.length === 0) encoder.SetAttributeQuantization(ids[i], bits);
      else encoder.SetAttributeExplicitQuantization(ids[i], bits, componentCount, Float32Array.from(origin), range);
    });
    const out = own(new module.DracoInt8Array());
    const size = encoder.EncodeToDracoBuffer(false, out);
    if (!(size > 0)) return undefined;
    return { data: Uint8Array.from({ length: size }, (_, i) => out.GetValue(i)), ids };
  });
}
