// SPDX-License-Identifier: MIT
// Node scales move vertices but do not change the strength of a normal map: both sides, every look, and compared with three.js.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { Glb } from "./glb.mjs";
import { difference, drawn, missing, noShared, openBytes, openSample, overGray, ownPicture, shared, shares, shoot, withPage } from "./support.mjs";

const plain = process.env.TSPACE_PLAIN, noPlain = missing || (!plain && "the page of three.js alone is not built");
const small = { width: 900, height: 700 };
const looks = ["lit", "clay", "difference", "normals", "signs", "mirrored", "error", "islands"];

/** Returns pictures of both sides of every look, each side filling the picture. */
async function pictures(tab, bytes, wanted = looks) {
  await openBytes(tab, "crate.glb", bytes);
  // Other content of the page must not change the size of the picture.
  await tab.addStyleTag({ content: ".frame { position: fixed !important; inset: 0 auto auto 0; width: 360px !important; height: 300px !important; }" });
  await drawn(tab);
  await tab.evaluate(() => window.tspaceView.views.stage.viewport.reset(true));
  await drawn(tab);
  const found = new Map();
  for (const look of wanted) {
    for (const [side, split] of [["file", 1], ["right", 0]]) {
      await tab.evaluate(([look, usesColors]) => Object.assign(window.tspaceView.views.stage.viewport.settings, { look, usesColors }), [look === "clay" ? "lit" : look, look !== "clay"]);
      await drawn(tab);
      const { text, view } = await ownPicture(tab, split);
      found.set(`${look}, ${side}`, { ...overGray(text), view });
    }
  }
  return found;
}

async function crate(tab) {
  await openSample(tab, "crate.glb");
  return Buffer.from(await tab.evaluate(() => [...window.tspaceView.model.bytes]));
}

function scaled(bytes, scale, hasTangents = true) {
  const glb = new Glb(bytes);
  for (const node of glb.json.nodes) if (node.mesh !== undefined) node.scale = scale;
  if (!hasTangents) for (const { attributes } of glb.primitives("TANGENT")) delete attributes.TANGENT;
  return glb.finish();
}

/**
 * Returns the model with a scale applied to its vertices instead of its node: N is transformed by the inverse
 * transpose, T by the matrix.
 */
function applied(bytes, scale) {
  const glb = new Glb(bytes), isMirror = scale[0] * scale[1] * scale[2] < 0;
  for (const primitive of glb.primitives("POSITION", "NORMAL", "TANGENT")) {
    const { attributes } = primitive;
    const changed = (name, size, change, isUnit) => {
      const numbers = glb.numbers(attributes[name]), type = `VEC${size}`, { min, max } = glb.json.accessors[attributes[name]];
      for (let i = 0; i < numbers.length; i += size) {
        const v = [0, 1, 2].map((k) => change(numbers[i + k], k)), length = isUnit ? Math.hypot(...v) : 1;
        v.forEach((x, k) => (numbers[i + k] = x / length));
        if (size === 4 && isMirror) numbers[i + 3] *= -1;
      }
      attributes[name] = glb.addFloats(numbers, type);
      if (min) Object.assign(glb.json.accessors[attributes[name]], { min: min.map((x, k) => Math.min(x * scale[k], max[k] * scale[k])), max: max.map((x, k) => Math.max(x * scale[k], min[k] * scale[k])) });
    };
    changed("POSITION", 3, (x, k) => x * scale[k], false);
    changed("NORMAL", 3, (x, k) => x / scale[k], true);
    changed("TANGENT", 4, (x, k) => x * scale[k], true);
    if (!isMirror) continue;
    const indices = glb.indices(primitive);
    for (let i = 0; i < indices.length; i += 3) [indices[i + 1], indices[i + 2]] = [indices[i + 2], indices[i + 1]];
    primitive.indices = glb.addIndices(indices);
  }
  return glb.finish();
}

test("a uniform node scale changes no look on either side, with and without tangents", { skip: missing, timeout: 1_200_000 }, async () => {
  await withPage(async (tab) => {
    const bytes = await crate(tab);
    for (const hasTangents of [true, false]) {
      const before = await pictures(tab, scaled(bytes, [1, 1, 1], hasTangents));
      for (const size of [0.01, 0.1, 10]) {
        for (const [name, picture] of await pictures(tab, scaled(bytes, [size, size, size], hasTangents))) {
          const { mean, count } = difference(picture, before.get(name));
          assert.ok(count > 1000 && mean < 0.05, `${size}, ${hasTangents ? "with" : "without"} tangents, ${name}: ${mean} of 255`);
        }
      }
    }
  }, small);
});

test("a nonuniform or mirroring node scale is lit like the same scale of the vertices, by the page and by three.js", { skip: noPlain, timeout: 1_200_000 }, async (t) => {
  const lit = [];
  await withPage(async (tab) => {
    const bytes = await crate(tab);
    for (const scale of [[2, 1, 0.6], [-1, 1, 1]]) {
      const other = applied(bytes, scale), wanted = ["lit", "clay", "normals", "difference"];
      const own = await pictures(tab, scaled(bytes, scale), wanted), same = await pictures(tab, other, wanted);
      for (const [name, picture] of own) {
        const { mean, count } = difference(picture, same.get(name));
        assert.ok(count > 1000 && mean < 0.3, `${scale}, ${name}: ${mean} of 255`);
      }
      lit.push([scale, scaled(bytes, scale), other, own.get("lit, file"), own.get("lit, right")]);
    }
  }, small);
  await withPage(async (tab) => {
    for (const [scale, bytes, other, file, right] of lit) {
      const alone = async (model) => overGray(await tab.evaluate(([text, view]) => window.renderPlain("crate.glb", { "crate.glb": text }, view), [model.toString("base64"), file.view]));
      const vertices = await alone(other), node = await alone(bytes);
      for (const [side, picture] of [["file", file], ["right", right]]) {
        const { mean } = difference(picture, vertices);
        assert.ok(mean < 0.1, `${scale}, ${side}: ${mean} of 255 beside three.js`);
      }
      // three.js inverts B if a node mirrors a file with tangents, in contrast to its own picture of the same surface.
      t.diagnostic(`three.js itself, ${scale} in the node and in the vertices: ${difference(node, vertices).mean.toFixed(2)} of 255 apart`);
    }
  }, { ...small, url: pathToFileURL(plain).href, allowMessages: true });
});

/** Returns the crate on one bone with this scale. Its triangles are wound for the transformed shape. */
function boned(bytes, scale) {
  const glb = new Glb(bytes), isMirror = scale[0] * scale[1] * scale[2] < 0;
  for (const primitive of glb.primitives("POSITION", "NORMAL", "TANGENT")) {
    const { count } = glb.json.accessors[primitive.attributes.POSITION];
    const zeros = glb.json.accessors.push({ bufferView: glb.addView(new Uint8Array(4 * count)), componentType: 5121, count, type: "VEC4" }) - 1;
    Object.assign(primitive.attributes, { JOINTS_0: zeros, WEIGHTS_0: glb.addFloats(Array.from({ length: 4 * count }, (_, i) => (i % 4 === 0 ? 1 : 0)), "VEC4") });
    if (!isMirror) continue;
    const indices = glb.indices(primitive);
    for (let i = 0; i < indices.length; i += 3) [indices[i + 1], indices[i + 2]] = [indices[i + 2], indices[i + 1]];
    primitive.indices = glb.addIndices(indices);
  }
  const bone = glb.json.nodes.push({ scale }) - 1;
  glb.json.skins = [{ joints: [bone] }];
  for (const node of glb.json.nodes) if (node.mesh !== undefined) node.skin = 0;
  for (const scene of glb.json.scenes) scene.nodes.push(bone);
  return glb.finish();
}

test("a mirroring bone is lit like mirrored vertices", { skip: missing, timeout: 600_000 }, async () => {
  await withPage(async (tab) => {
    const bytes = await crate(tab), wanted = ["lit", "clay", "normals", "difference"];
    for (const scale of [[1, 1, 1], [-1, 1, 1]]) {
      const same = await pictures(tab, applied(bytes, scale), wanted);
      for (const [name, picture] of await pictures(tab, boned(bytes, scale), wanted)) {
        const { mean, count } = difference(picture, same.get(name));
        assert.ok(count > 1000 && mean < 0.3, `${scale}, ${name}: ${mean} of 255`);
      }
    }
  }, small);
});

test("crates with scaled nodes look equal on both sides, without any difference", { skip: noShared, timeout: 600_000 }, async () => {
  await withPage(async (tab) => {
    let first = null;
    for (const name of ["crate-scale-1", "crate-scale-10", "crate-tangents-scale-0.01"]) {
      const found = await pictures(tab, readFileSync(join(shared, "reports/second", `${name}.glb`)), ["lit", "difference"]);
      first ??= found;
      for (const side of ["file", "right"]) {
        const { mean } = difference(found.get(`lit, ${side}`), first.get(`lit, right`));
        assert.ok(mean < 0.05, `${name}, ${side}: ${mean} of 255`);
      }
      const seen = await shares(tab, { none: [41, 48, 89], some: [33, 120, 181], more: [237, 224, 64] }, { left: 0, top: 0, right: 1, bottom: 0.85 });
      assert.ok(seen.none > 0.1 && seen.some + seen.more < 0.0005, `${name}: ${JSON.stringify(seen)}`);
      await shoot(tab, `scale-${name}`);
    }
  }, small);
});
