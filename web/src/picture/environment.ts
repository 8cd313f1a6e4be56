// SPDX-License-Identifier: MIT
// What surfaces mirror: a grey room with three lamps, made here.
import { BackSide, BoxGeometry, Color, Float32BufferAttribute, Mesh, MeshBasicMaterial, PMREMGenerator, Scene, SphereGeometry, type Texture, type WebGLRenderer } from "three";

/** Place, size and brightness of the lamps; the largest is above and to the left, where the lamp of the page is at first. */
const lamps: readonly { at: [number, number, number]; size: [number, number, number]; light: number }[] = [
  { at: [-4, 6, 3], size: [4, 0.2, 4], light: 9 },
  { at: [6, 2, 2], size: [0.2, 3, 3], light: 4 },
  { at: [0, 1, -7], size: [6, 2, 0.2], light: 2 },
];
const kAbove = new Color(0.62, 0.64, 0.68), kBelow = new Color(0.16, 0.15, 0.14);

function room(): Scene {
  const scene = new Scene();
  const sphere = new SphereGeometry(20, 32, 16), heights = sphere.getAttribute("position");
  const colors = Array.from({ length: heights.count }, (_, i) => kBelow.clone().lerp(kAbove, 0.5 + 0.5 * (heights.getY(i) / 20)).toArray()).flat();
  sphere.setAttribute("color", new Float32BufferAttribute(colors, 3));
  scene.add(new Mesh(sphere, new MeshBasicMaterial({ vertexColors: true, side: BackSide })));
  for (const { at, size, light } of lamps) {
    const lamp = new Mesh(new BoxGeometry(...size), new MeshBasicMaterial({ color: new Color(light, light, light) }));
    lamp.position.set(...at);
    scene.add(lamp);
  }
  return scene;
}

/** As PMREM has it: blurred for each roughness. */
export function environmentFor(renderer: WebGLRenderer): Texture {
  const generator = new PMREMGenerator(renderer), scene = room();
  const { texture } = generator.fromScene(scene, 0.02);
  generator.dispose();
  scene.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    object.geometry.dispose();
    object.material.dispose();
  });
  return texture;
}
