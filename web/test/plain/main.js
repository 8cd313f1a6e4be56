// SPDX-License-Identifier: MIT
// Renders a model with three.js alone, in the environment, light and pose of the page: the reference of plain.test.mjs.
// With the fragment #crate, it shows the crate that the page shows first, and marks the time of its first picture.
import { DirectionalLight, LoadingManager, NeutralToneMapping, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import crate from "../../samples/crate.glb?inline";
import { environmentFor } from "../../src/picture/environment.ts";

const canvas = document.querySelector("canvas"), decode = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
renderer.setClearColor(0, 0);
renderer.toneMapping = NeutralToneMapping;

/** Returns a picture as PNG. `files`: path to base64 content; `view`: the camera of the page. */
window.renderPlain = async (name, files, { width, height, position, target, up, fov, near, far, light }) => {
  const urls = new Map(Object.entries(files).map(([path, text]) => [path, URL.createObjectURL(new Blob([decode(text)]))]));
  const manager = new LoadingManager();
  manager.setURLModifier((url) => (/^(data|blob):/i.test(url) ? url : (urls.get(decodeURIComponent(url).replace(/^\.\//, "")) ?? "data:,")));
  const bytes = decode(files[name]), gltf = await new GLTFLoader(manager).parseAsync(/\.gltf$/i.test(name) ? new TextDecoder().decode(bytes) : bytes.buffer, "");
  renderer.setSize(width, height, false);
  const scene = new Scene(), camera = new PerspectiveCamera(fov, width / height, near, far), lamp = new DirectionalLight(0xffffff, 2);
  camera.position.fromArray(position);
  camera.up.fromArray(up);
  camera.lookAt(...target);
  lamp.position.fromArray(light);
  scene.add(gltf.scene, lamp);
  // The page does not use the lights of a file.
  const lights = [];
  gltf.scene.traverse((object) => object.isLight && lights.push(object));
  for (const one of lights) one.removeFromParent();
  scene.environment = environmentFor(renderer);
  renderer.render(scene, camera);
  return canvas.toDataURL("image/png").split(",")[1];
};

async function showCrate() {
  const gltf = await new GLTFLoader().parseAsync(decode(crate.slice(crate.indexOf(",") + 1)).buffer, "");
  renderer.setPixelRatio(Math.min(2, devicePixelRatio));
  renderer.setSize(innerWidth, innerHeight);
  const scene = new Scene(), camera = new PerspectiveCamera(40, innerWidth / innerHeight, 0.01, 100), lamp = new DirectionalLight(0xffffff, 2);
  camera.position.set(2, 1.5, 2);
  camera.lookAt(0, 0, 0);
  lamp.position.set(-1, 2, 3);
  scene.add(gltf.scene, lamp);
  renderer.render(scene, camera);
  performance.mark("first picture");
}
if (location.hash === "#crate") await showCrate();
document.documentElement.dataset.state = "ready";
