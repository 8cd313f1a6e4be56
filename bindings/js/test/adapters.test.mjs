// SPDX-License-Identifier: MIT
// Compares the adapters with the packages that they replace or support.
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { generateTangents, makeIndexedFrames, ready } from "tspace";
import * as compat from "tspace/compat";
import { differences, readGolden } from "./golden.mjs";
import { grid, randomMeshes } from "./meshes.mjs";

const optional = (name) => import(name).catch(() => null);
const [npm, three, threeMikktspace, core, functions] = await Promise.all([
  optional("mikktspace"), optional("three"), optional("three/examples/jsm/libs/mikktspace.module.js"),
  optional("@gltf-transform/core"), optional("@gltf-transform/functions"),
]);
const absent = (module, name) => module === null && `${name} is not installed`;
await Promise.all([ready, compat.ready]);

const mesh = grid(8);
const perCorner = (array, size) =>
  Float32Array.from([...mesh.indices].flatMap((v) => [...array.subarray(size * v, size * v + size)]));
const unindexed = [perCorner(mesh.positions, 3), perCorner(mesh.normals, 3), perCorner(mesh.uvs, 2)];

describe("the call of npm's mikktspace", () => {
  const ofNpm = npm?.generateTangents ?? npm?.default.generateTangents;

  it("gives the bits of the package on random meshes", { skip: absent(npm, "mikktspace") }, () => {
    let compared = 0;
    for (const { name, arrays } of randomMeshes()) {
      const tangents = compat.generateTangents(...arrays);
      let wanted;
      try {
        wanted = ofNpm(...arrays);
      } catch (error) {
        assert.ok(error instanceof WebAssembly.RuntimeError); // the package crashes if all triangles are degenerate
        continue;
      }
      assert.equal(differences(tangents, wanted), 0, name);
      compared += 1;
    }
    assert.ok(compared > 350);
  });

  it("accepts arrays of any number type, like the package", { skip: absent(npm, "mikktspace") }, () => {
    const wanted = ofNpm(...unindexed);
    assert.equal(differences(compat.generateTangents(...unindexed), wanted), 0);
    assert.equal(differences(compat.generateTangents(...unindexed.map((array) => [...array])), wanted), 0);
    assert.equal(differences(compat.generateTangents(...unindexed.map((array) => Float64Array.from(array))), wanted), 0);
    const listed = unindexed.map((array) => ({ length: array.length, ...array }));
    assert.equal(differences(ofNpm(...listed), wanted), 0);
    assert.equal(differences(compat.generateTangents(...listed), wanted), 0);
    assert.throws(() => compat.generateTangents([0, 0], [], []), { code: "countMismatch" });
    for (const wrong of [new DataView(new ArrayBuffer(36)), {}, { length: -1 }, { length: 1.5 }, () => 0, 9, null])
      assert.throws(() => compat.generateTangents(wrong, [], []), { code: wrong === null ? "missingAttribute" : "wrongType" });
    assert.throws(() => compat.generateTangents("positions", [], []), { name: "TypeError" });
  });

  it("gives an empty array for empty arrays, for which the package throws", { skip: absent(npm, "mikktspace") }, () => {
    for (const empty of [[], new Float32Array(0)]) {
      assert.throws(() => ofNpm(empty, empty, empty));
      assert.deepEqual(compat.generateTangents(empty, empty, empty), new Float32Array(0));
    }
  });

  it("works in three.js", { skip: absent(three, "three") }, async () => {
    const { computeMikkTSpaceTangents } = await import("three/examples/jsm/utils/BufferGeometryUtils.js");
    const geometry = new three.BufferGeometry();
    ["position", "normal", "uv"].forEach((name, i) => geometry.setAttribute(name, new three.BufferAttribute(unindexed[i], i < 2 ? 3 : 2)));
    computeMikkTSpaceTangents(geometry, compat, false);
    assert.deepEqual(geometry.attributes.tangent.array, compat.generateTangents(...unindexed));
  });

  it("works in glTF-Transform", { skip: absent(functions, "glTF-Transform") }, async () => {
    const { document, primitive } = gltf(core, { POSITION: unindexed[0], NORMAL: unindexed[1], TEXCOORD_0: unindexed[2] });
    await document.transform(functions.tangents({ generateTangents: compat.generateTangents }));
    const wanted = generateTangents({ positions: unindexed[0], normals: unindexed[1], uvs: unindexed[2] }, { convention: "gltf" });
    assert.deepEqual(primitive.getAttribute("TANGENT").getArray(), wanted);
  });

  // three.js fixes a defect of mikktspace.c (the last bucket of its edge list is not sorted). On meshes that the defect
  // affects, three.js matches pairing `corrected` instead of `reference`.
  it("gives the bits of the reference on golden meshes of triangles, and pairing corrected those of three.js", { skip: absent(threeMikktspace, "three") }, async (t) => {
    await threeMikktspace.ready;
    const folder = process.env.TSPACE_GOLDEN;
    if (!folder || !existsSync(folder)) return t.skip("no golden meshes here");
    let compared = 0, unlikeReference = 0;
    for (const name of readdirSync(folder).filter((file) => file.endsWith(".tsg"))) {
      const bytes = readFileSync(`${folder}/${name}`);
      const { mesh: g, isPromised, threshold, wanted: reference } = readGolden(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
      if (!isPromised || threshold !== 180 || g.faceSizes.some((size) => size !== 3)) continue;
      const wanted = threeMikktspace.generateTangents(g.positions, g.normals, g.uvs);
      assert.equal(differences(compat.generateTangents(g.positions, g.normals, g.uvs), reference), 0, name);
      assert.equal(differences(generateTangents({ ...g, faceSizes: null }, { convention: "opengl", pairing: "corrected" }), wanted), 0, name);
      unlikeReference += differences(reference, wanted) !== 0;
      compared += 1;
    }
    assert.ok(compared > 50);
    assert.ok(unlikeReference > 0);
  });
});

describe("computeTangents and three.js's own module", { skip: absent(threeMikktspace, "three") }, () => {
  it("give the same bits on random meshes", async () => {
    const { computeTangents } = await import("tspace/three");
    await threeMikktspace.ready;
    for (const { name, arrays } of randomMeshes()) {
      const geometry = new three.BufferGeometry();
      ["position", "normal", "uv"].forEach((part, i) => geometry.setAttribute(part, new three.BufferAttribute(arrays[i], i < 2 ? 3 : 2)));
      const made = computeTangents(geometry, { convention: "opengl", sanitize: false });
      const tangents = Float32Array.from([...made.index.array].flatMap((v) => [...made.attributes.tangent.array.subarray(4 * v, 4 * v + 4)]));
      assert.equal(differences(tangents, threeMikktspace.generateTangents(...arrays)), 0, name);
    }
  });
});

function gltf(core, attributes, indices) {
  const document = new core.Document();
  const buffer = document.createBuffer();
  const primitive = document.createPrimitive();
  const make = (array, type) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  for (const [name, array] of Object.entries(attributes)) primitive.setAttribute(name, make(array, name.startsWith("TEX") ? "VEC2" : "VEC3"));
  if (indices) primitive.setIndices(make(indices, "SCALAR"));
  document.createMesh().addPrimitive(primitive);
  return { document, primitive, make };
}

describe("the transform for glTF-Transform", { skip: absent(core, "glTF-Transform") }, () => {
  const attributes = { POSITION: mesh.positions, NORMAL: mesh.normals, TEXCOORD_0: mesh.uvs };

  it("splits, and gives each corner the tangent of the library", async () => {
    const { tspaceTangents } = await import("tspace/gltf-transform");
    const { document, primitive } = gltf(core, attributes, mesh.indices);
    await document.transform(tspaceTangents());
    const frames = makeIndexedFrames(mesh, { convention: "gltf" });
    assert.deepEqual([...primitive.getIndices().getArray()], [...frames.indices]);
    assert.deepEqual(primitive.getAttribute("TANGENT").getArray(), frames.tangents);
    assert.equal(primitive.getAttribute("POSITION").getCount(), frames.sourceVertices.length);
  });

  it("adds missing indices", async () => {
    const { tspaceTangents } = await import("tspace/gltf-transform");
    const { document, primitive } = gltf(core, { POSITION: unindexed[0], NORMAL: unindexed[1], TEXCOORD_0: unindexed[2] });
    await document.transform(tspaceTangents());
    const count = primitive.getAttribute("POSITION").getCount();
    assert.ok(count < unindexed[0].length / 3);
    const [indices, tangents] = [primitive.getIndices().getArray(), primitive.getAttribute("TANGENT").getArray()];
    const wanted = generateTangents(mesh, { convention: "gltf" });
    indices.forEach((v, c) => assert.deepEqual(tangents.slice(4 * v, 4 * v + 4), wanted.slice(4 * c, 4 * c + 4)));
  });

  it("computes missing normals", async () => {
    const { tspaceTangents } = await import("tspace/gltf-transform");
    const { document, primitive } = gltf(core, { POSITION: mesh.positions, TEXCOORD_0: mesh.uvs }, mesh.indices);
    await document.transform(tspaceTangents());
    for (const name of ["NORMAL", "TANGENT"])
      assert.equal(primitive.getAttribute(name).getCount(), primitive.getAttribute("POSITION").getCount());
  });

  it("computes tangents of morph targets", async () => {
    const { tspaceTangents } = await import("tspace/gltf-transform");
    const { document, primitive, make } = gltf(core, attributes, mesh.indices);
    const moves = mesh.positions.map((x, i) => (i % 3 === 2 ? 0.3 * Math.sin(5 * mesh.positions[i - 2]) : 0));
    primitive.addTarget(document.createPrimitiveTarget().setAttribute("POSITION", make(moves, "VEC3")));
    await document.transform(tspaceTangents());
    const [target] = primitive.listTargets();
    const count = primitive.getAttribute("POSITION").getCount();
    assert.equal(target.getAttribute("POSITION").getCount(), count);
    const moved = { ...mesh, positions: mesh.positions.map((x, i) => x + moves[i]) };
    const wanted = generateTangents(moved, { convention: "gltf" });
    const [base, delta] = [primitive.getAttribute("TANGENT").getArray(), target.getAttribute("TANGENT").getArray()];
    assert.equal(delta.length, 3 * count);
    assert.ok(delta.some((x) => Math.abs(x) > 0.01));
    primitive.getIndices().getArray().forEach((v, c) => {
      for (let k = 0; k < 3; ++k) assert.ok(Math.abs(base[4 * v + k] + delta[3 * v + k] - wanted[4 * c + k]) < 1e-5);
    });
  });
});

describe("computeTangents for three.js", { skip: absent(three, "three") }, () => {
  it("gives an indexed geometry with all attributes", async () => {
    const { computeTangents } = await import("tspace/three");
    const geometry = new three.TorusKnotGeometry(1, 0.3, 64, 8);
    geometry.morphAttributes.position = [geometry.attributes.position.clone()];
    geometry.addGroup(0, 30, 1);
    const result = computeTangents(geometry, { convention: "opengl" });
    const count = result.attributes.position.count;
    assert.equal(result.index.count, geometry.index.count);
    for (const name of ["normal", "uv", "tangent"]) assert.equal(result.attributes[name].count, count);
    assert.equal(result.morphAttributes.position[0].count, count);
    assert.deepEqual(result.groups, geometry.groups);
    const source = { positions: geometry.attributes.position.array, normals: geometry.attributes.normal.array, uvs: geometry.attributes.uv.array, indices: Uint32Array.from(geometry.index.array) };
    const wanted = generateTangents(source, { convention: "opengl" });
    result.index.array.forEach((v, c) => {
      assert.deepEqual(result.attributes.tangent.array.slice(4 * v, 4 * v + 4), wanted.slice(4 * c, 4 * c + 4));
      const old = geometry.index.array[c];
      assert.deepEqual(result.attributes.position.array.slice(3 * v, 3 * v + 3), geometry.attributes.position.array.slice(3 * old, 3 * old + 3));
    });
  });

  it("adds missing indices, and reads interleaved attributes", async () => {
    const { computeTangents } = await import("tspace/three");
    const plain = new three.SphereGeometry(1, 12, 8).toNonIndexed();
    const result = computeTangents(plain, { convention: "opengl" });
    assert.ok(result.attributes.position.count < plain.attributes.position.count);
    const n = plain.attributes.position.count;
    const numbers = new Float32Array(8 * n);
    for (let i = 0; i < n; ++i) {
      numbers.set(plain.attributes.position.array.slice(3 * i, 3 * i + 3), 8 * i);
      numbers.set(plain.attributes.normal.array.slice(3 * i, 3 * i + 3), 8 * i + 3);
      numbers.set(plain.attributes.uv.array.slice(2 * i, 2 * i + 2), 8 * i + 6);
    }
    const data = new three.InterleavedBuffer(numbers, 8);
    const interleaved = new three.BufferGeometry();
    interleaved.setAttribute("position", new three.InterleavedBufferAttribute(data, 3, 0));
    interleaved.setAttribute("normal", new three.InterleavedBufferAttribute(data, 3, 3));
    interleaved.setAttribute("uv", new three.InterleavedBufferAttribute(data, 2, 6));
    const other = computeTangents(interleaved, { convention: "opengl" });
    for (const name of ["position", "normal", "uv", "tangent"])
      assert.deepEqual(other.attributes[name].array, result.attributes[name].array);
  });

  it("accepts a mesh, and needs no UVs for the method basis", async () => {
    const { computeTangents } = await import("tspace/three");
    const geometry = new three.SphereGeometry(1, 12, 8);
    const body = new three.SkinnedMesh(geometry, new three.MeshBasicMaterial());
    const [of, ofGeometry] = [body, geometry].map((given) => computeTangents(given, { convention: "opengl" }));
    assert.deepEqual(of.attributes.tangent.array, ofGeometry.attributes.tangent.array);
    assert.equal(body.geometry, geometry);
    geometry.deleteAttribute("uv");
    assert.throws(() => computeTangents(geometry, { convention: "opengl" }), { code: "missingAttribute", message: /uv.*"basis"/ });
    const basis = computeTangents(geometry, { convention: "opengl", method: "basis" });
    const wanted = generateTangents({ positions: geometry.attributes.position.array, normals: geometry.attributes.normal.array, indices: Uint32Array.from(geometry.index.array) }, { convention: "opengl", method: "basis" });
    basis.index.array.forEach((v, c) => assert.deepEqual(basis.attributes.tangent.array.slice(4 * v, 4 * v + 4), wanted.slice(4 * c, 4 * c + 4)));
    for (const wrong of [new three.Group(), undefined, {}])
      assert.throws(() => computeTangents(wrong, { convention: "opengl" }), { name: "TypeError", message: /^geometry must be a BufferGeometry or a Mesh, not (Group|undefined|object)$/ });
  });

  it("keeps array types, usage, gpuType, names and the width of the index", async () => {
    const { computeTangents } = await import("tspace/three");
    const { fromHalfFloat, toHalfFloat } = three.DataUtils;
    const box = new three.BoxGeometry();
    const plain = computeTangents(box, { convention: "opengl" }).attributes;
    const half = (name) => new three.Float16BufferAttribute(Uint16Array.from(box.attributes[name].array, toHalfFloat), box.attributes[name].itemSize);
    for (const name of ["position", "normal", "uv"]) box.setAttribute(name, half(name));
    box.attributes.position.setUsage(three.DynamicDrawUsage).name = "moving";
    box.setAttribute("id", new three.Uint16BufferAttribute(Uint16Array.from({ length: 24 }, (_, i) => i), 1));
    box.attributes.id.gpuType = three.IntType;
    box.setAttribute("tint", new three.Uint8ClampedBufferAttribute(new Uint8ClampedArray(96).fill(200), 4, true));
    box.morphAttributes.position = [half("position")];
    box.computeBoundingSphere();
    box.boundingSphere.radius = 9; // enlarged, as for vertices that a shader displaces
    const made = computeTangents(box, { convention: "opengl" });
    for (const [name, attribute] of Object.entries(box.attributes)) {
      const kept = made.attributes[name];
      for (const member of ["constructor", "name", "usage", "gpuType", "normalized", "itemSize"]) assert.equal(kept[member], attribute[member], `${name}.${member}`);
      assert.equal(kept.array.constructor, attribute.array.constructor);
    }
    // the coordinates of a box are exact as half floats
    assert.deepEqual(made.attributes.tangent.array, plain.tangent.array);
    assert.equal(made.attributes.uv.getX(1), fromHalfFloat(box.attributes.uv.array[2]));
    assert.ok(made.morphAttributes.position[0].isFloat16BufferAttribute);
    assert.equal(made.boundingSphere.radius, 9);
    for (const Type of [Int8Array, Uint8Array, Uint8ClampedArray, Int16Array, Uint16Array, Int32Array, Uint32Array]) {
      box.setIndex(new three.BufferAttribute(Type.from(box.index.array), 1).setUsage(three.StreamDrawUsage));
      const { index } = computeTangents(box, { convention: "opengl" });
      assert.deepEqual([index.array.constructor, index.usage], [Type, three.StreamDrawUsage]);
    }
    const strips = new three.PlaneGeometry(1, 1, 16, 6); // 119 vertices; each inner column of faces mirrors its neighbors
    strips.attributes.uv.array.forEach((u, i, all) => (all[i] = i % 2 === 0 ? (i / 2) % 17 % 2 : u));
    for (const [Type, Wanted] of [[Int8Array, Uint8Array], [Uint8ClampedArray, Uint8ClampedArray], [Int16Array, Int16Array], [Float32Array, Uint16Array]]) {
      strips.setIndex(new three.BufferAttribute(Type.from(strips.index.array), 1));
      const made = computeTangents(strips, { convention: "opengl" });
      assert.ok(made.attributes.position.count > 127 && made.attributes.position.count < 255);
      assert.equal(made.index.array.constructor, Wanted);
    }
    assert.ok(computeTangents(box.toNonIndexed(), { convention: "opengl" }).index.array instanceof Uint16Array);
    const many = new three.PlaneGeometry(1, 1, 256, 254); // 65,535 vertices
    assert.ok(computeTangents(many, { convention: "opengl" }).index.array instanceof Uint16Array);
    many.attributes.uv.array.forEach((u, i, all) => (all[i] = i % 2 === 0 ? Math.abs(u - 0.5) : u)); // splits two columns of vertices
    assert.ok(many.index.array instanceof Uint16Array);
    const wide = computeTangents(many, { convention: "opengl" });
    assert.ok(wide.attributes.position.count > 65535 && wide.index.array instanceof Uint32Array);
  });

  it("stores computed normals in the type of the attribute if it can store them", async () => {
    const { computeTangents } = await import("tspace/three");
    const sphere = new three.SphereGeometry(1, 12, 8), { array, count } = sphere.attributes.normal;
    const options = { convention: "opengl", makeNormals: true };
    const exact = computeTangents(sphere, options).attributes.normal;
    const toHalf = three.DataUtils.toHalfFloat, integers = (Type, most) => Type.from(array, (x) => Math.round(most * x));
    const four = new Float32Array(4 * count).fill(9);
    for (let i = 0; i < count; ++i) four.set(array.subarray(3 * i, 3 * i + 3), 4 * i);
    const interleaved = new three.InterleavedBufferAttribute(new three.InterleavedBuffer(integers(Int8Array, 127), 3), 3, 0, true);
    const kinds = [
      [new three.Int8BufferAttribute(integers(Int8Array, 127), 3, true), 1 / 127], [new three.Int16BufferAttribute(integers(Int16Array, 32767), 3, true), 1 / 32767],
      [new three.BufferAttribute(integers(Int32Array, 2147483647), 3, true), 1e-7], [new three.Float16BufferAttribute(Uint16Array.from(array, toHalf), 3), 1e-3],
      [new three.BufferAttribute(Float64Array.from(array), 3), 0], [new three.Float32BufferAttribute(four, 4), 0], [interleaved, 1 / 127],
    ];
    for (const [normal, error] of kinds) {
      Object.assign(normal, { name: "up" });
      if (!normal.data) Object.assign(normal, { usage: three.DynamicDrawUsage, gpuType: three.IntType });
      sphere.setAttribute("normal", normal);
      const made = computeTangents(sphere, options).attributes.normal;
      for (const member of normal.data ? ["normalized", "itemSize", "name"] : ["constructor", "normalized", "itemSize", "name", "usage", "gpuType"]) assert.equal(made[member], normal[member], member);
      assert.equal(made.array.constructor, normal.array.constructor);
      for (let i = 0; i < exact.count; ++i)
        for (const get of ["getX", "getY", "getZ"]) assert.ok(Math.abs(made[get](i) - exact[get](i)) <= error, `${made.array.constructor.name} ${made[get](i)} ${exact[get](i)}`);
      if (normal.itemSize === 4) assert.equal(made.getW(5), 9);
    }
    // unsigned integers, and integers that are not normalized, cannot store unit vectors
    for (const normal of [new three.Uint8BufferAttribute(integers(Uint8Array, 255), 3, true), new three.Int8BufferAttribute(integers(Int8Array, 1), 3)]) {
      sphere.setAttribute("normal", normal);
      assert.deepEqual(computeTangents(sphere, options).attributes.normal.array, exact.array);
    }
  });

  it("keeps instances, also interleaved ones", async () => {
    const { computeTangents } = await import("tspace/three");
    const given = new three.InstancedBufferGeometry().copy(new three.PlaneGeometry());
    given.instanceCount = 5;
    given.setAttribute("offset", new three.InstancedBufferAttribute(Float32Array.from({ length: 15 }, (_, i) => i), 3, false, 2));
    const data = new three.InstancedInterleavedBuffer(Float32Array.from({ length: 20 }, (_, i) => i), 4, 3);
    given.setAttribute("tint", new three.InterleavedBufferAttribute(data, 3, 0));
    given.setAttribute("phase", new three.InterleavedBufferAttribute(data, 1, 3));
    const made = computeTangents(given, { convention: "opengl" });
    assert.deepEqual([made.type, made.instanceCount], ["InstancedBufferGeometry", 5]);
    const { offset, tint, phase } = made.attributes;
    assert.ok(offset.isInstancedBufferAttribute);
    assert.deepEqual([offset.meshPerAttribute, offset.count, [...offset.array]], [2, 5, [...given.attributes.offset.array]]);
    assert.equal(tint.data, phase.data);
    assert.deepEqual([tint.data.isInstancedInterleavedBuffer, tint.data.meshPerAttribute, phase.getX(4)], [true, 3, 19]);
  });

  it("requires a convention and UVs", async () => {
    const { computeTangents } = await import("tspace/three");
    assert.throws(() => computeTangents(new three.SphereGeometry(), {}), { code: "invalidOption" });
    assert.throws(() => computeTangents(new three.BufferGeometry(), { convention: "gltf" }), { code: "missingAttribute" });
    for (const name of ["threshold", "method", "pairing", "makeNormals"])
      assert.throws(() => computeTangents(new three.SphereGeometry(), { convention: "gltf", [name]: null }), ({ message }) => message.startsWith(`${name} must be`) && message.endsWith("not null"));
  });
});
