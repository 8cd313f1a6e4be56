// SPDX-License-Identifier: MIT
// Compares run times of tspace and other packages in one process: node test/bench.mjs in build/js/project, after
// scripts/js.
import { MeshoptTangents } from "meshoptimizer";
import * as three from "three/examples/jsm/libs/mikktspace.module.js";
import { generateTangents, ready } from "tspace";
import * as small from "tspace/mikktspace";
import { grid } from "./meshes.mjs";

await Promise.all([ready, small.ready, three.ready, MeshoptTangents.ready]);
const mesh = grid(224);
const { positions, normals, uvs, indices } = mesh;
const perCorner = (array, size) => {
  const all = new Float32Array(size * indices.length);
  indices.forEach((v, c) => all.set(array.subarray(size * v, size * v + size), size * c));
  return all;
};
const unindexed = { positions: perCorner(positions, 3), normals: perCorner(normals, 3), uvs: perCorner(uvs, 2) };
const options = { convention: "gltf" };

const rounds = Number(process.argv[2] ?? 41);
/** Returns the minimum times of alternating runs, so that other load affects all candidates alike. */
function race(title, calls) {
  const times = calls.map(() => []);
  for (let round = 0; round < rounds + 5; ++round) {
    calls.forEach(([, call], i) => {
      const begin = performance.now();
      call();
      if (round >= 5) times[i].push(performance.now() - begin);
    });
  }
  const least = times.map((list) => Math.min(...list));
  console.log(`${title}, ${indices.length / 3} triangles`);
  calls.forEach(([name], i) => console.log(`  ${name.padEnd(34)} ${least[i].toFixed(1)} ms  ${(least[i] / least.at(-1)).toFixed(2)}`));
}

race("indexed", [
  ["tspace", () => generateTangents(mesh, options)],
  ["tspace/mikktspace", () => small.generateTangents(mesh, options)],
  ["meshoptimizer, Compatible", () => MeshoptTangents.generateTangents(indices, positions, 3, normals, 3, uvs, 2, ["Compatible"])],
]);
race("unindexed", [
  ["tspace", () => generateTangents(unindexed, options)],
  ["tspace/mikktspace", () => small.generateTangents(unindexed, options)],
  ["three.js r187, mikktspace", () => three.generateTangents(unindexed.positions, unindexed.normals, unindexed.uvs)],
]);
