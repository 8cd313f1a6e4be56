// SPDX-License-Identifier: MIT
// The entry "tspace/gltf-transform": a transform that creates indices, computes tangents, splits vertices, and adds
// tangents to morph targets.
import { object } from "./check.js";
import { gather } from "./gather.js";
import { makeIndexedFrames, Plan, ready, sanitizeTangents, splitVertices } from "./index.js";

export { ready };

const kTriangles = 4;

function readFloats(accessor) {
  const array = accessor.getArray();
  if (array instanceof Float32Array) return array;
  const size = accessor.getElementSize(), element = [];
  const numbers = new Float32Array(size * accessor.getCount());
  for (let i = 0; i < accessor.getCount(); ++i) numbers.set(accessor.getElement(i, element), size * i);
  return numbers;
}

const sum = (a, b) => a.map((x, i) => x + b[i]);

function uvsOf(primitive) {
  const texture = primitive.getMaterial()?.getNormalTextureInfo();
  return primitive.getAttribute(`TEXCOORD_${texture?.getTexCoord() ?? 0}`) ?? primitive.getAttribute("TEXCOORD_0");
}

/** Returns all accessors with an entry per vertex: [owner, semantic, accessor]. */
const vertexData = (primitive) =>
  [primitive, ...primitive.listTargets()].flatMap((owner) =>
    owner.listSemantics().map((name) => [owner, name, owner.getAttribute(name)]));

/** Creates indices for a primitive without them: one vertex for all corners whose attributes are all equal. */
function indexPrimitive(document, primitive) {
  const count = primitive.getAttribute("POSITION").getCount();
  const attributes = vertexData(primitive).map(([, , accessor]) => ({ data: readFloats(accessor), size: accessor.getElementSize() }));
  const split = splitVertices({ indices: new Uint32Array(count), vertexCount: 1 }, attributes);
  rewrite(document, primitive, split.indices, split.sourceCorners);
}

/**
 * Replaces every vertex accessor by one with the entries `sources`. Accessors may be shared, so new ones are created.
 */
function rewrite(document, primitive, indices, sources) {
  for (const [owner, name, accessor] of vertexData(primitive)) {
    const own = gather(accessor.getArray(), accessor.getElementSize(), sources);
    owner.setAttribute(name, accessor.clone().setArray(own));
  }
  const list = sources.length <= 0xffff ? Uint16Array.from(indices) : indices;
  const buffer = primitive.getAttribute("POSITION").getBuffer();
  primitive.setIndices(document.createAccessor().setType("SCALAR").setArray(list).setBuffer(buffer));
}

/** Computes tangents per corner for the pose of each morph target, with the tangent groups of the base mesh. */
function targetTangents(primitive, mesh, { makeNormals, normals, sanitize, orthogonalizeAll, report, ...options }) {
  const targets = primitive.listTargets().filter((t) => t.getAttribute("POSITION") || t.getAttribute("NORMAL"));
  if (targets.length === 0) return [];
  const plan = new Plan(mesh, options);
  const moved = (target, name, base) => {
    const accessor = target.getAttribute(name);
    return accessor ? sum(base, readFloats(accessor)) : base;
  };
  try {
    return targets.map((target) => {
      const pose = { positions: moved(target, "POSITION", mesh.positions), normals: moved(target, "NORMAL", mesh.normals) };
      return { target, tangents: sanitizeTangents({ ...mesh, ...pose }, plan.evaluate(pose)) };
    });
  } finally {
    plan.destroy();
  }
}

function addTangents(document, primitive, options) {
  if (!primitive.getIndices()) indexPrimitive(document, primitive);
  const normal = primitive.getAttribute("NORMAL");
  const mesh = {
    positions: readFloats(primitive.getAttribute("POSITION")),
    normals: normal && readFloats(normal),
    uvs: readFloats(uvsOf(primitive)),
    indices: Uint32Array.from(primitive.getIndices().getArray()),
  };
  const frames = makeIndexedFrames(mesh, { ...options, convention: "gltf" });
  if (!normal) {
    // Computing normals per corner may have split vertices, so tangents are then computed for the split primitive.
    rewrite(document, primitive, frames.indices, frames.sourceVertices);
    const buffer = primitive.getAttribute("POSITION").getBuffer();
    primitive.setAttribute("NORMAL", document.createAccessor().setType("VEC3").setArray(frames.normals).setBuffer(buffer));
    return addTangents(document, primitive, options);
  }
  const base = gather(frames.tangents, 4, frames.indices);
  const targets = targetTangents(primitive, mesh, { ...options, convention: "gltf" });
  const split = splitVertices(
    { indices: mesh.indices, vertexCount: mesh.positions.length / 3 },
    [base, ...targets.map((t) => t.tangents)].map((data) => ({ data, size: 4 })),
  );
  rewrite(document, primitive, split.indices, split.sourceVertices);
  const buffer = primitive.getAttribute("POSITION").getBuffer();
  const perVertex = (tangents) => {
    const own = new Float32Array(4 * split.sourceCorners.length);
    split.sourceCorners.forEach((corner, v) => own.set(corner === 0xffffffff ? [1, 0, 0, 1] : tangents.subarray(4 * corner, 4 * corner + 4), 4 * v));
    return own;
  };
  const own = perVertex(base);
  primitive.setAttribute("TANGENT", document.createAccessor().setType("VEC4").setArray(own).setBuffer(buffer));
  for (const { target, tangents } of targets) {
    const pose = perVertex(tangents);
    const differences = new Float32Array((own.length / 4) * 3).map((_, i) => {
      const at = 4 * Math.floor(i / 3) + (i % 3);
      return pose[at] - own[at];
    });
    target.setAttribute("TANGENT", document.createAccessor().setType("VEC3").setArray(differences).setBuffer(buffer));
  }
}

export function tspaceTangents(options = {}) {
  const { overwrite = false, ...rest } = object(options, "options");
  return async function tspaceTangents(document) {
    await ready;
    for (const mesh of document.getRoot().listMeshes()) {
      for (const primitive of mesh.listPrimitives()) {
        if (primitive.getMode() !== kTriangles || !primitive.getAttribute("POSITION") || !uvsOf(primitive)) continue;
        if (primitive.getAttribute("TANGENT") && !overwrite) continue;
        addTangents(document, primitive, rest);
      }
    }
  };
}
