// SPDX-License-Identifier: MIT
// Tests three.js's WebGPURenderer and TSL with tangents of tspace/three, bundled by Vite, in headless Chromium.
import assert from "node:assert/strict";
import { it } from "node:test";
import { missing, runPage } from "./browser.mjs";

/** Returns the color (tangent.x, bitangent.y, sign) of a square in front of the camera; its texture is mirrored if `mirrored`. */
const page = `
import * as THREE from "three/webgpu";
import { bitangentWorld, tangentGeometry, tangentWorld, vec3, vec4 } from "three/tsl";
import { computeTangents, ready } from "tspace/three";

async function color(renderer, mirrored) {
  const geometry = new THREE.PlaneGeometry(2, 2);
  if (mirrored) for (let i = 0; i < 4; ++i) geometry.attributes.uv.setX(i, 1 - geometry.attributes.uv.getX(i));
  const material = new THREE.MeshBasicNodeMaterial();
  material.colorNode = vec4(vec3(tangentWorld.x, bitangentWorld.y, tangentGeometry.w).mul(0.5).add(0.5), 1);
  const mesh = new THREE.Mesh(geometry, material);
  mesh.geometry = computeTangents(mesh, { convention: "opengl" });
  const scene = new THREE.Scene();
  scene.add(mesh);
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
  camera.position.z = 2;
  const target = new THREE.RenderTarget(4, 4);
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  return [...(await renderer.readRenderTargetPixelsAsync(target, 1, 1, 1, 1))].slice(0, 3);
}
/** Returns the brightness of a wall with a normal map tilted along u, lit from the right and from the left. */
async function lit(renderer, mirrored) {
  const geometry = new THREE.PlaneGeometry(2, 2);
  if (mirrored) for (let i = 0; i < 4; ++i) geometry.attributes.uv.setX(i, 1 - geometry.attributes.uv.getX(i));
  const normalMap = new THREE.DataTexture(Uint8Array.of(218, 128, 218, 255), 1, 1);
  normalMap.needsUpdate = true;
  const material = new THREE.MeshStandardNodeMaterial({ normalMap, roughness: 1 });
  const scene = new THREE.Scene();
  scene.add(new THREE.Mesh(computeTangents(geometry, { convention: "opengl" }), material));
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
  camera.position.z = 2;
  const light = new THREE.DirectionalLight(0xffffff, 3);
  scene.add(light);
  const target = new THREE.RenderTarget(4, 4);
  const levels = [];
  for (const x of [1, -1]) {
    light.position.set(x, 0, 1);
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    levels.push((await renderer.readRenderTargetPixelsAsync(target, 1, 1, 1, 1))[0]);
  }
  return levels;
}
try {
  await ready;
  const result = {};
  for (const forceWebGL of [true, false]) {
    const renderer = new THREE.WebGPURenderer({ forceWebGL });
    await renderer.init();
    const name = renderer.backend.isWebGPUBackend ? "webgpu" : "webgl";
    if (result[name]) continue; // no WebGPU here: the renderer fell back to WebGL
    result[name] = {};
    for (const mirrored of [false, true]) result[name][mirrored] = { color: await color(renderer, mirrored), lit: await lit(renderer, mirrored) };
  }
  window.result = result;
} catch (error) {
  window.result = { error: String(error.stack) };
}
`;

it("three.js's WebGPURenderer draws with tangents of tspace/three", { skip: missing }, async (t) => {
  const result = await runPage({ page });
  assert.ok(result.webgl || result.webgpu);
  t.diagnostic(`drawn by ${Object.keys(result).join(" and ")}`);
  for (const [name, of] of Object.entries(result)) {
    assert.deepEqual(of.false.color, [255, 255, 255], `${name}: T along +x, B along +y, sign +1`);
    assert.deepEqual(of.true.color, [0, 255, 0], `${name}: T along -x, B along +y, sign -1`);
    const [[right, left], [mirroredRight, mirroredLeft]] = [of.false.lit, of.true.lit];
    assert.ok(right > left + 50 && mirroredLeft > mirroredRight + 50, `${name}: texels lean along u: ${right} ${left}, ${mirroredRight} ${mirroredLeft}`);
  }
});
