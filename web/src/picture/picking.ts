// SPDX-License-Identifier: MIT
// Data read back from the GPU: the triangle at a position of the picture, and the UV map of a part.
import { BufferAttribute, Color, NoBlending, WebGLRenderTarget, type PerspectiveCamera, type Scene as ThreeScene, type Vector2, type WebGLRenderer } from "three";
import type { Scene } from "./scene.js";
import { setValues, type PictureValues } from "./shader.js";
import type { MapCorners } from "../worker/protocol.js";

/** One attribute per array, so that uploaded data are reused. */
const attributes = new WeakMap<Float32Array, BufferAttribute>();
function attributeOf(values: Float32Array<ArrayBuffer>): BufferAttribute {
  const attribute = attributes.get(values) ?? new BufferAttribute(values, 2);
  attributes.set(values, attribute);
  return attribute;
}

/** The state of the picture that is needed for reading back. */
export interface Readable {
  renderer: WebGLRenderer;
  world: ThreeScene;
  scene: Scene;
  camera: PerspectiveCamera;
  /** Size of the picture in CSS pixels. */
  size: Vector2;
}

function setUniforms(scene: Scene, change: (uniforms: Record<string, { value: unknown }>) => void): void {
  for (const { material, part } of scene.drawn) {
    material.uniforms.uAlphaTest.value = part.alphaTest;
    change(material.uniforms);
    material.uniformsNeedUpdate = true;
  }
}

/** Returns the index of the triangle at a position of the canvas (in CSS pixels), or -1. */
export async function pickTriangle({ renderer, world, scene, camera, size }: Readable, target: WebGLRenderTarget, x: number, y: number): Promise<number> {
  const ratio = renderer.getPixelRatio();
  setUniforms(scene, (u) => ((u.uIsPick.value = true), (u.uAlphaTest.value = 0)));
  camera.setViewOffset(size.x * ratio, size.y * ratio, Math.floor(x * ratio), Math.floor(y * ratio), 1, 1);
  renderer.setRenderTarget(target);
  renderer.clear();
  renderer.render(world, camera);
  renderer.setRenderTarget(null);
  camera.clearViewOffset();
  setUniforms(scene, (u) => (u.uIsPick.value = false));
  const p = new Uint8Array(4);
  await renderer.readRenderTargetPixelsAsync(target, 0, 0, 1, 1, p);
  return (p[0] | (p[1] << 8) | (p[2] << 16) | (p[3] << 24)) - 1;
}

/** Returns the UV map of a part as pixels, top row first. `area`: scale and offset of UVs. */
export async function drawUvMap({ renderer, world, scene, camera }: Readable, values: PictureValues, partIndex: number, map: MapCorners, { width, height }: { width: number; height: number }, area: [number, number, number, number]): Promise<Uint8ClampedArray<ArrayBuffer>> {
  const target = new WebGLRenderTarget(width, height, { samples: 4 });
  const { drawn } = scene;
  const clear = renderer.getClearColor(new Color()), alpha = renderer.getClearAlpha();
  drawn.forEach(({ meshes }, i) => meshes.forEach((mesh, k) => (mesh.visible = i === partIndex && k === 0)));
  const { material, geometry } = drawn[partIndex];
  const { side } = material, own = { mapUv: geometry.getAttribute("mapUv"), island: geometry.getAttribute("island") };
  setValues(material, { ...values, split: Infinity });
  material.side = 2;
  material.depthTest = false;
  material.blending = NoBlending;
  material.uniforms.uIsMap.value = true;
  material.uniforms.uMapArea.value = area;
  material.uniforms.uSplit.value = 1e9;
  geometry.setAttribute("mapUv", attributeOf(map.uvs)).setAttribute("island", attributeOf(map.islands));
  renderer.setRenderTarget(target);
  renderer.setClearColor(0, 0);
  renderer.clear();
  renderer.render(world, camera);
  renderer.setRenderTarget(null);
  renderer.setClearColor(clear, alpha);
  geometry.setAttribute("mapUv", own.mapUv).setAttribute("island", own.island);
  material.uniforms.uIsMap.value = false;
  material.depthTest = true;
  material.side = side;
  scene.show(false);
  const upsideDown = new Uint8ClampedArray(4 * width * height), rows = new Uint8ClampedArray(4 * width * height), row = 4 * width;
  await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height, upsideDown);
  target.dispose();
  for (let y = 0; y < height; ++y) rows.set(upsideDown.subarray(row * (height - 1 - y), row * (height - y)), row * y);
  return rows;
}
