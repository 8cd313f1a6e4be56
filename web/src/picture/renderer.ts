// SPDX-License-Identifier: MIT
// Rendering on the GPU: the scene, another file to the right of the split line, the lamp, its shadows, and the
// environment.
import { DirectionalLight, NeutralToneMapping, Scene as ThreeScene, Vector2, WebGLRenderer, type DataTexture, type PerspectiveCamera } from "three";
import { environmentFor, environmentOf, type Surroundings } from "./environment.js";
import type { Readable } from "./picking.js";
import { Scene } from "./scene.js";
import { setValues, type Look, type PictureValues } from "./shader.js";

/** Returns whether a look has two sides. */
export const hasSplit = (look: Look): boolean => look === "lit" || look === "normals" || look === "signs";

/** Returns the width of each of two pictures side by side. Both have the same number of whole pixels. */
export const halfOf = (width: number): number => Math.floor(width / 2);

export interface Settings {
  look: Look;
  map: 0 | 1 | 2;
  isWire: boolean;
  usesColors: boolean;
  /**
   * Position of the split line, from 0 (left) to 1: the frames of the file are on its left, those to compare with on
   * its right.
   */
  split: number;
  /** Shows two pictures side by side with the same camera: the file, and what is otherwise right of the line. */
  isBeside: boolean;
  /** The environment that surfaces reflect. */
  surroundings: Surroundings;
  /** Parts cast shadows of the lamp. */
  hasShadows: boolean;
  /** Rotation of the environment about the vertical axis, in degrees. */
  turn: number;
  /** Exposure, in stops: each stop doubles the brightness. */
  stops: number;
}

function rendererFor(canvas: HTMLCanvasElement): WebGLRenderer | null {
  const context = canvas.getContext("webgl2", { antialias: true, alpha: true, depth: true, stencil: false, preserveDrawingBuffer: false });
  if (!context) return null;
  const renderer = new WebGLRenderer({ canvas, context, antialias: true, alpha: true });
  renderer.setClearColor(0, 0);
  renderer.autoClear = false;
  renderer.toneMapping = NeutralToneMapping;
  renderer.setPixelRatio(Math.min(2, devicePixelRatio));
  return renderer;
}

export class Picture {
  /** Null if the browser has no WebGL. */
  readonly renderer: WebGLRenderer | null;
  readonly overlay = new ThreeScene();
  scene = new Scene();
  /** A file with other normals or triangles, drawn right of the line instead of the scene. */
  #right: Scene | null = null;
  #world = new ThreeScene();
  #lamp = new DirectionalLight(0xffffff, 2);
  #hasDrawn = false;
  #panorama: DataTexture | null = null;

  constructor(canvas: HTMLCanvasElement) {
    this.renderer = rendererFor(canvas);
    this.#lamp.shadow.mapSize.set(2048, 2048);
    this.#world.add(this.#lamp, this.#lamp.target);
  }

  /** Returns the state for reading back. `isBeside`: reads from the left of two pictures. */
  readable(camera: PerspectiveCamera, isBeside = false): Readable | null {
    const size = this.renderer?.getSize(new Vector2());
    if (isBeside && size) size.x = halfOf(size.x);
    return this.renderer && { renderer: this.renderer, world: this.#world, scene: this.scene, camera, size: size! };
  }

  show(scene: Scene): void {
    this.showRight(null);
    this.#world.remove(this.scene.root);
    this.scene.dispose();
    // three.js references the arrays of the geometry that it drew last until it draws another one.
    this.renderer?.resetState();
    this.scene = scene;
    this.#world.add(scene.root);
  }

  showRight(right: Scene | null): void {
    if (this.#right) this.#world.remove(this.#right.root);
    this.#right = right;
    if (right) {
      right.root.visible = false;
      this.#world.add(right.root);
    }
  }

  /** Sets an environment provided by the user. Null: generated environments. */
  setPanorama(panorama: DataTexture | null): void {
    this.#panorama?.dispose();
    this.#panorama = panorama;
    this.forgetEnvironment();
  }

  /** Makes the next picture generate the environment again. */
  forgetEnvironment(): void {
    this.#world.environment?.dispose();
    this.#world.environment = null;
  }

  setShadows(on: boolean): void {
    this.#lamp.castShadow = on;
    if (this.renderer) this.renderer.shadowMap.enabled = on;
  }

  /** Places the lamp outside the scene, so that its shadows cover the whole scene. */
  #placeLamp(values: PictureValues & Settings): void {
    this.#lamp.position.copy(values.light);
    if (!values.hasShadows) return void this.#lamp.target.position.set(0, 0, 0);
    const { center, radius } = this.scene.sphere(), { camera } = this.#lamp.shadow;
    this.#lamp.target.position.copy(center);
    this.#lamp.position.multiplyScalar(2 * radius).add(center);
    Object.assign(camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 0.5 * radius, far: 3.5 * radius });
    camera.updateProjectionMatrix();
    this.#lamp.shadow.normalBias = 0.006 * radius; // about three texels of the shadow map
  }

  /** Draws the picture. Returns whether another picture must follow, because the first one omits the environment. */
  draw(camera: PerspectiveCamera, values: PictureValues & Settings, split: number): boolean {
    const { renderer } = this;
    // Before the first model the canvas is empty, and the GPU is busy with other work.
    if (!renderer || (this.scene.drawn.length === 0 && !this.#hasDrawn)) return false;
    for (const { material } of this.scene.drawn) setValues(material, values);
    this.#placeLamp(values);
    // The first frame does not wait for the environment, which is blurred for each roughness level.
    const wantsSurface = values.look === "lit" && values.usesColors && !values.isWire, isSurface = wantsSurface && this.#hasDrawn;
    if (isSurface) this.#world.environment ??= this.#panorama ? environmentOf(renderer, this.#panorama) : environmentFor(renderer, values.surroundings);
    this.#world.environmentRotation.y = (values.turn * Math.PI) / 180;
    renderer.toneMappingExposure = 2 ** values.stops;
    renderer.clear();
    if (values.isBeside) this.#drawBeside(renderer, camera, values, isSurface);
    else {
      if (this.#right && hasSplit(values.look)) this.#drawSides(renderer, camera, this.#right, values, isSurface, split);
      else this.#drawScene(renderer, camera, this.scene, isSurface);
      renderer.render(this.overlay, camera);
    }
    if (this.scene.drawn.length > 0 && !this.#hasDrawn) performance.mark("first picture");
    this.#hasDrawn ||= this.scene.drawn.length > 0;
    return wantsSurface && !isSurface && this.scene.drawn.length > 0;
  }

  #drawScene(renderer: WebGLRenderer, camera: PerspectiveCamera, scene: Scene, isSurface: boolean): void {
    scene.show(isSurface);
    renderer.render(this.#world, camera);
    scene.show(false);
  }

  /**
   * Draws two pictures of the same size. If the right side has no scene of its own, the right one shows the other
   * frames of this scene.
   */
  #drawBeside(renderer: WebGLRenderer, camera: PerspectiveCamera, values: PictureValues, isSurface: boolean): void {
    const { x: width, y: height } = renderer.getSize(new Vector2()), half = halfOf(width), other = this.#right ?? this.scene;
    renderer.setScissorTest(true);
    for (const [scene, from, split] of [[this.scene, 0, Infinity], [other, width - half, other === this.scene ? 0 : Infinity]] as const) {
      this.scene.root.visible = other.root.visible = false;
      scene.root.visible = true;
      for (const one of scene.drawn) {
        setValues(one.material, { ...values, split });
        one.hidden = this.scene.find(one.part.mesh, one.part.primitive)?.hidden ?? new Set();
      }
      renderer.setViewport(from, 0, half, height);
      renderer.setScissor(from, 0, half, height);
      this.#drawScene(renderer, camera, scene, isSurface);
      renderer.render(this.overlay, camera);
    }
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, width, height);
    other.root.visible = false;
    this.scene.root.visible = true;
  }

  /** Draws the scene left of the line, and the other file with its own frames right of it. */
  #drawSides(renderer: WebGLRenderer, camera: PerspectiveCamera, right: Scene, values: PictureValues, isSurface: boolean, split: number): void {
    const { x: width, y: height } = renderer.getSize(new Vector2()), line = Math.round(width * Math.min(1, split));
    for (const one of right.drawn) {
      setValues(one.material, { ...values, split: Infinity });
      one.hidden = this.scene.find(one.part.mesh, one.part.primitive)?.hidden ?? new Set();
    }
    renderer.setScissorTest(true);
    for (const [scene, from, to] of [[this.scene, 0, line], [right, line, width]] as const) {
      if (from === to) continue;
      this.scene.root.visible = scene === this.scene;
      right.root.visible = scene === right;
      renderer.setScissor(from, 0, to - from, height);
      this.#drawScene(renderer, camera, scene, isSurface);
    }
    renderer.setScissorTest(false);
    this.scene.root.visible = true;
    right.root.visible = false;
  }
}
