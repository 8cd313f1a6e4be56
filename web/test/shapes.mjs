// SPDX-License-Identifier: MIT
// Models that tests generate: curved surfaces with tangents, textures and materials.
import { png } from "../samples/png.mjs";
import { GlbBuilder } from "../src/model/glb.js";

const sub = (a, b) => a.map((x, k) => x - b[k]);
const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const unit = (v) => v.map((x) => x / Math.hypot(...v));

/**
 * Returns the arrays of a grid of vertices over the UV square. at(u, v) returns a position, outward(u, v) a vector on
 * the outer side of the surface.
 */
export function surfaceOf(columns, rows, at, outward) {
  const count = (columns + 1) * (rows + 1), step = 1e-4, sides = [];
  const mesh = { positions: new Float32Array(3 * count), normals: new Float32Array(3 * count), tangents: new Float32Array(4 * count), uvs: new Float32Array(2 * count), indices: new Uint32Array(6 * columns * rows) };
  for (let i = 0; i < count; ++i) {
    const u = (i % (columns + 1)) / columns, v = Math.floor(i / (columns + 1)) / rows;
    // Derivatives are taken inside the square, so that poles have directions.
    const inner = Math.min(1 - 2 * step, Math.max(2 * step, v)), du = sub(at(u + step, inner), at(u - step, inner)), dv = sub(at(u, inner + step), at(u, inner - step));
    const away = cross(du, dv), side = Math.sign(dot(away, outward(u, v))), normal = unit(away.map((x) => side * x)), tangent = unit(sub(du, normal.map((x) => x * dot(du, normal))));
    sides.push(side);
    mesh.positions.set(at(u, v), 3 * i);
    mesh.normals.set(normal, 3 * i);
    // Images have v downward, and the bitangent points up.
    mesh.tangents.set([...tangent, -Math.sign(dot(cross(normal, tangent), dv))], 4 * i);
    mesh.uvs.set([u, v], 2 * i);
  }
  for (let i = 0; i < columns * rows; ++i) {
    const a = Math.floor(i / columns) * (columns + 1) + (i % columns), b = a + 1, c = a + columns + 1, d = c + 1;
    mesh.indices.set(sides[a] > 0 ? [a, b, c, c, b, d] : [a, c, b, b, c, d], 6 * i);
  }
  return mesh;
}

const circle = (t) => [Math.cos(2 * Math.PI * t), Math.sin(2 * Math.PI * t)];

export const torus = (columns = 96, rows = 48, width = 0.4) => {
  const at = (u, v) => {
    const [x, z] = circle(u), [out, up] = circle(v);
    return [(1 + width * out) * x, width * up, (1 + width * out) * z];
  };
  return surfaceOf(columns, rows, at, (u, v) => sub(at(u, v), [circle(u)[0], 0, circle(u)[1]]));
};

export const ball = (columns = 96, rows = 48) => {
  const at = (u, v) => {
    const [x, z] = circle(u), [y, out] = circle(v / 2);
    return [out * x, y, out * z];
  };
  return surfaceOf(columns, rows, at, at);
};

/** Returns a normal map of `knobs` x `knobs` round knobs. */
export const knobMap = (size = 128, knobs = 8) => png(size, (x, y) => {
  const [dx, dy] = [x, y].map((at) => 2 * ((((at + 0.5) * knobs) / size) % 1) - 1), r = Math.hypot(dx, dy);
  const slope = r < 0.8 ? 1.5 * Math.sin((Math.PI * r) / 0.8) : 0, [nx, ny, nz] = unit([r > 0 ? (slope * dx) / r : 0, r > 0 ? (-slope * dy) / r : 0, 1]);
  return [nx, ny, nz].map((c) => Math.round(127.5 + 127.5 * c));
});

/** Returns a color map of `fields` x `fields` fields in two colors, with a gradient. */
export const fieldMap = (size = 64, fields = 4) => png(size, (x, y) => {
  const isEven = (Math.floor((x * fields) / size) + Math.floor((y * fields) / size)) % 2 === 0;
  return isEven ? [220, 160 - x, 60] : [50, 120, 90 + y];
});

/** Returns a GLB with one mesh. `json`: members that are added to the model; `images`: PNGs, one texture each. */
export function glbOfMesh({ positions, normals, tangents, uvs, indices }, { material = {}, images = [], attributes = {}, node = {}, json = {} } = {}) {
  const builder = new GlbBuilder();
  const all = { POSITION: builder.addAccessor(positions, "VEC3"), NORMAL: builder.addAccessor(normals, "VEC3"), ...(tangents && { TANGENT: builder.addAccessor(tangents, "VEC4") }), TEXCOORD_0: builder.addAccessor(uvs, "VEC2") };
  for (const [name, [data, type]] of Object.entries(attributes)) all[name] = builder.addAccessor(data, type);
  const index = builder.addAccessor(indices, "SCALAR");
  const pictures = images.map((bytes) => ({ bufferView: builder.addView(bytes), mimeType: "image/png" }));
  return Buffer.from(builder.finish({
    scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, ...node }], materials: [material],
    meshes: [{ primitives: [{ attributes: all, indices: index, material: 0 }] }],
    ...(images.length > 0 && { images: pictures, textures: pictures.map((_, source) => ({ source, sampler: 0 })), samplers: [{ wrapS: 10497, wrapT: 10497 }] }),
    ...json,
  }, "tests"));
}
