// SPDX-License-Identifier: MIT
// Reflected environments: a gray room with three lamps, other generated environments, or a panorama provided by the
// user.
import { BackSide, BoxGeometry, Color, DataTexture, EquirectangularReflectionMapping, Float32BufferAttribute, LinearFilter, Mesh, MeshBasicMaterial, PMREMGenerator, RGBAFormat, Scene, SphereGeometry, type Texture, type TextureDataType, type WebGLRenderer } from "three";
import { HDRLoader } from "three/examples/jsm/loaders/HDRLoader.js";

export const surroundings = ["room", "studio", "sky", "sunset"] as const;
export type Surroundings = (typeof surroundings)[number];

interface Lamp {
  at: [number, number, number];
  size: [number, number, number];
  light: number;
  color?: [number, number, number];
}

/** Background colors from bottom to top, and lamps: positions, sizes and brightness. */
const kinds: Record<Surroundings, { below: Color; level?: Color; above: Color; lamps: readonly Lamp[] }> = {
  // The largest lamp is above and to the left, like the initial lamp of the page.
  room: {
    below: new Color(0.16, 0.15, 0.14), above: new Color(0.62, 0.64, 0.68),
    lamps: [{ at: [-4, 6, 3], size: [4, 0.2, 4], light: 9 }, { at: [6, 2, 2], size: [0.2, 3, 3], light: 4 }, { at: [0, 1, -7], size: [6, 2, 0.2], light: 2 }],
  },
  // Dark, with tall lamps on both sides and one above: rim light and long highlights.
  studio: {
    below: new Color(0.02, 0.02, 0.02), above: new Color(0.1, 0.1, 0.11),
    lamps: [{ at: [-7, 1, 1], size: [0.2, 9, 2], light: 14 }, { at: [7, 1, -1], size: [0.2, 9, 2], light: 9 }, { at: [0, 8, 1], size: [4, 0.2, 2], light: 8 }],
  },
  sky: {
    below: new Color(0.2, 0.18, 0.15), level: new Color(0.75, 0.95, 1.25), above: new Color(0.16, 0.42, 1.15),
    lamps: [{ at: [-6, 9, 6], size: [1.6, 1.6, 1.6], light: 55, color: [1, 0.95, 0.86] }],
  },
  sunset: {
    below: new Color(0.08, 0.06, 0.06), level: new Color(1.1, 0.5, 0.22), above: new Color(0.12, 0.16, 0.36),
    lamps: [{ at: [-11, 1.6, 3], size: [1.8, 1.8, 1.8], light: 45, color: [1, 0.55, 0.25] }],
  },
};

function sceneOf({ below, level, above, lamps }: (typeof kinds)[Surroundings]): Scene {
  const scene = new Scene();
  const sphere = new SphereGeometry(20, 32, 16), heights = sphere.getAttribute("position");
  const colorAt = (y: number) => (!level ? below.clone().lerp(above, 0.5 + 0.5 * y) : y < 0 ? level.clone().lerp(below, Math.min(1, -6 * y)) : level.clone().lerp(above, Math.sqrt(y)));
  sphere.setAttribute("color", new Float32BufferAttribute(Array.from({ length: heights.count }, (_, i) => colorAt(heights.getY(i) / 20).toArray()).flat(), 3));
  scene.add(new Mesh(sphere, new MeshBasicMaterial({ vertexColors: true, side: BackSide })));
  for (const { at, size, light, color: [r, g, b] = [1, 1, 1] } of lamps) {
    const lamp = new Mesh(new BoxGeometry(...size), new MeshBasicMaterial({ color: new Color(light * r, light * g, light * b) }));
    lamp.position.set(...at);
    scene.add(lamp);
  }
  return scene;
}

/** Reads the panorama of an HDR file (Radiance). Throws if the file is invalid. */
export function panoramaOf(file: ArrayBuffer): DataTexture {
  const { data, width, height, type } = new HDRLoader().parse(file) as { data: Uint16Array<ArrayBuffer>; width: number; height: number; type: TextureDataType };
  if (!(width > 0 && height > 0) || data.length !== 4 * width * height) throw new Error("the file is shorter than its header declares");
  const panorama = new DataTexture(data, width, height, RGBAFormat, type, EquirectangularReflectionMapping);
  panorama.minFilter = panorama.magFilter = LinearFilter;
  panorama.flipY = true;
  panorama.needsUpdate = true;
  return panorama;
}

/** Returns a panorama blurred for each roughness level. */
export function environmentOf(renderer: WebGLRenderer, panorama: DataTexture): Texture {
  const generator = new PMREMGenerator(renderer), { texture } = generator.fromEquirectangular(panorama);
  generator.dispose();
  return texture;
}

/** Returns a generated environment as created by PMREM: blurred for each roughness level. */
export function environmentFor(renderer: WebGLRenderer, name: Surroundings = "room"): Texture {
  const generator = new PMREMGenerator(renderer), scene = sceneOf(kinds[name]);
  const { texture } = generator.fromScene(scene, 0.02);
  generator.dispose();
  scene.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    object.geometry.dispose();
    object.material.dispose();
  });
  return texture;
}
