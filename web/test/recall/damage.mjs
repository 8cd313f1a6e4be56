// SPDX-License-Identifier: MIT
// Damages intact models in the ways in which frames are damaged between programs.
import { png } from "../../samples/png.mjs";

const kMapSize = 256;

/** Returns tiling heights: hills and dents of several sizes, with slopes in all directions. */
function height(u, v) {
  const wave = (x, y, phase) => Math.sin(2 * Math.PI * (x * u + y * v) + phase);
  return 0.02 * (wave(3, 1, 0) + wave(-2, 3, 1) + 0.6 * wave(5, -4, 2) + 0.5 * wave(4, 7, 3) + 0.4 * wave(-9, 6, 4) + 0.3 * wave(11, 8, 5));
}

/** Returns a normal map of these heights, with green up. */
function bumps() {
  const e = 1 / kMapSize;
  return png(kMapSize, (x, y) => {
    const u = (x + 0.5) * e, v = (y + 0.5) * e;
    const slope = (du, dv) => (height(u + du, v + dv) - height(u - du, v - dv)) / (2 * e);
    // v points down, green points up.
    const n = [-slope(e, 0), slope(0, e), 1], length = Math.hypot(...n);
    return n.map((k) => Math.round((k / length) * 127.5 + 127.5));
  });
}

/** Maximum size in bytes of a placeholder image of a few texels. */
const kLeastImage = 1000;

/** Gives every primitive with UVs a material with a normal map: its own map, or the one of bumps(). */
export function giveNormalMaps(glb) {
  const { json } = glb;
  json.materials ??= [];
  json.textures ??= [];
  json.images ??= [];
  let made;
  const bumpTexture = () => (made ??= json.textures.push({ source: json.images.push({ mimeType: "image/png", bufferView: glb.addView(bumps()) }) - 1 }) - 1);
  for (const primitive of glb.primitives("POSITION", "TEXCOORD_0")) {
    primitive.material ??= json.materials.push({}) - 1;
    const material = json.materials[primitive.material];
    delete material.extensions?.KHR_materials_unlit;
    const own = json.images[json.textures[material.normalTexture?.index]?.source]?.bufferView;
    if (own === undefined || json.bufferViews[own].byteLength < kLeastImage) material.normalTexture = { ...material.normalTexture, index: bumpTexture() };
  }
}

const kinds = (glb) => new Set(glb.primitives("TANGENT").map((one) => one.attributes.TANGENT));

/** Modifies each array of tangents once: four numbers per vertex. */
function changeTangents(glb, change) {
  const changed = new Map([...kinds(glb)].map((accessor) => {
    const tangents = glb.numbers(accessor);
    change(tangents);
    return [accessor, glb.addFloats(tangents, "VEC4")];
  }));
  for (const { attributes } of glb.primitives("TANGENT")) attributes.TANGENT = changed.get(attributes.TANGENT);
}

/** Inverts every sign, as if v had not been flipped for MikkTSpace. */
export function invertSigns(glb) {
  changeTangents(glb, (tangents) => {
    for (let i = 3; i < tangents.length; i += 4) tangents[i] = -tangents[i];
  });
  return kinds(glb).size > 0;
}

const cornersOf = (numbers, size, vertex) => numbers.subarray(size * vertex, size * vertex + size);

/** Returns groups of a primitive's vertices that are equal in these attributes. */
function equalVertices(arrays, count) {
  const found = new Map();
  for (let vertex = 0; vertex < count; ++vertex) {
    const key = arrays.map(([numbers, size]) => cornersOf(numbers, size, vertex).join()).join();
    if (!found.has(key)) found.set(key, []);
    found.get(key).push(vertex);
  }
  return [...found.values()].filter((vertices) => vertices.length > 1);
}

const degrees = (a, b) => (Math.acos(Math.min(1, Math.max(-1, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]))) * 180) / Math.PI;

/**
 * Assigns one tangent to all vertices at a position: the mean over a UV seam, or a single vertex if the UVs are equal too (a
 * mirror line). Returns the share of triangles whose tangents change by more than 30 degrees.
 */
export function averageSeams(glb) {
  let touched = 0, triangles = 0;
  for (const primitive of glb.primitives("POSITION", "NORMAL", "TEXCOORD_0", "TANGENT")) {
    const { attributes } = primitive;
    const positions = glb.numbers(attributes.POSITION), normals = glb.numbers(attributes.NORMAL), uvs = glb.numbers(attributes.TEXCOORD_0);
    const tangents = glb.numbers(attributes.TANGENT), before = tangents.slice(), indices = glb.indices(primitive);
    const places = [[positions, 3], [normals, 3]], changed = new Set();
    for (const vertices of equalVertices(places, positions.length / 3)) {
      const mean = [0, 1, 2].map((k) => vertices.reduce((sum, vertex) => sum + before[4 * vertex + k], 0)), length = Math.hypot(...mean);
      if (length < 0.01) continue;
      for (const vertex of vertices) {
        mean.forEach((x, k) => (tangents[4 * vertex + k] = x / length));
        if (degrees(cornersOf(before, 4, vertex), cornersOf(tangents, 4, vertex)) > 30) changed.add(vertex);
      }
    }
    const first = new Map();
    for (const [one, ...others] of equalVertices([...places, [uvs, 2]], positions.length / 3)) for (const other of others) {
      if (before[4 * one + 3] !== before[4 * other + 3]) changed.add(one).add(other);
      first.set(other, one);
    }
    for (let corner = 0; corner + 2 < indices.length; corner += 3) {
      triangles += 1;
      if (indices.subarray(corner, corner + 3).some((vertex) => changed.has(vertex))) touched += 1;
    }
    attributes.TANGENT = glb.addFloats(tangents, "VEC4");
    primitive.indices = glb.addIndices(indices.map((vertex) => first.get(vertex) ?? vertex));
  }
  return touched / Math.max(1, triangles);
}

/** Adds a second UV set, like a light map: a box projection. Normal maps use it until `readFirstSet` is called. */
export function addSecondSet(glb) {
  const own = glb.primitives("POSITION", "NORMAL", "TEXCOORD_0");
  const sets = ({ attributes }) => Object.keys(attributes).filter((name) => name.startsWith("TEXCOORD_")).length;
  const last = Math.max(...own.map(sets));
  for (const primitive of own) {
    const positions = glb.numbers(primitive.attributes.POSITION), normals = glb.numbers(primitive.attributes.NORMAL);
    const uvs = new Float64Array((positions.length / 3) * 2);
    for (let vertex = 0; vertex < positions.length / 3; ++vertex) {
      const size = cornersOf(normals, 3, vertex).map(Math.abs), axis = size.indexOf(Math.max(...size));
      const [a, b] = [[2, 1], [0, 2], [1, 0]][axis];
      uvs[2 * vertex] = positions[3 * vertex + a] * Math.sign(normals[3 * vertex + axis]);
      uvs[2 * vertex + 1] = -positions[3 * vertex + b];
    }
    const accessor = glb.addFloats(uvs, "VEC2");
    for (let set = sets(primitive); set <= last; ++set) primitive.attributes[`TEXCOORD_${set}`] = accessor;
    const texture = glb.json.materials[primitive.material].normalTexture;
    delete texture.extensions?.KHR_texture_transform;
    texture.texCoord = last;
  }
}

export function readFirstSet(glb) {
  for (const { normalTexture } of glb.json.materials) if (normalTexture) delete normalTexture.texCoord;
}
