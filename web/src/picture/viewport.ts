// SPDX-License-Identifier: MIT
// The picture: redraws only when something has changed. The camera is in camera.ts, rendering in renderer.ts, and
// reading back in picking.ts.
import { Vector3, WebGLRenderTarget, type Matrix4, type Object3D, type PerspectiveCamera } from "three";
import { Eye } from "./camera.js";
import { moveByKey } from "./keys.js";
import { drawUvMap, pickTriangle } from "./picking.js";
import { halfOf, hasSplit, Picture, type Settings } from "./renderer.js";
import { Scene } from "./scene.js";
import { panoramaOf, type Surroundings } from "./environment.js";
import type { Look, PictureValues } from "./shader.js";
import type { MapCorners } from "../worker/protocol.js";

export { hasSplit };

/** Width in pixels of the downscaled pictures that are compared, and the smallest visible difference of a channel. */
const kCoarse = 256, kSeenStep = 16;

export class Viewport {
  readonly canvas: HTMLCanvasElement;
  readonly settings: Settings = { look: "lit", map: 1, isWire: false, usesColors: true, split: 0.5, isBeside: false, surroundings: "room", hasShadows: false, turn: 0, stops: 0 };
  /** Direction to the light in view space: x right, y up, z toward the camera. */
  readonly light = new Vector3(-0.45, 0.55, 0.7).normalize();
  onDrawn: () => void = () => {};
  readonly #picture: Picture;
  readonly #eye: Eye;
  #isAsked = false;
  #pickTarget = new WebGLRenderTarget(1, 1, { depthBuffer: true });

  constructor(canvas: HTMLCanvasElement) {
    this.canvas = canvas;
    this.#picture = new Picture(canvas);
    this.#eye = new Eye(canvas, () => this.scene, () => this.ask());
    canvas.addEventListener("keydown", (event) => moveByKey(event, this.#eye) && this.ask());
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("pointermove", (event) => this.#dragLight(event));
    canvas.addEventListener("webglcontextrestored", () => this.ask());
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
  }

  /** False without WebGL: nothing is drawn, but everything else works. */
  get hasPicture(): boolean {
    return this.#picture.renderer !== null;
  }

  get scene(): Scene {
    return this.#picture.scene;
  }

  /** Numbers of objects in GPU memory. */
  get resources(): { geometries: number; textures: number } {
    const { geometries = 0, textures = 0 } = this.#picture.renderer?.info.memory ?? {};
    return { geometries, textures };
  }

  get camera(): PerspectiveCamera {
    return this.#eye.camera;
  }

  get overlay(): Object3D {
    return this.#picture.overlay;
  }

  /** The point that the camera looks at and orbits. */
  get target(): Vector3 {
    return this.#eye.target;
  }

  show(scene: Scene): void {
    this.#picture.show(scene);
    this.ask();
  }

  /** Shows another file right of the line; null: the scene itself, with the correct frames. */
  showRight(right: Scene | null): void {
    this.#picture.showRight(right);
    this.ask();
  }

  /** Requests a redraw in the next frame. */
  ask(): void {
    if (this.#isAsked) return;
    this.#isAsked = true;
    requestAnimationFrame((now) => {
      this.#isAsked = false;
      this.#eye.move(now);
      this.#draw();
      this.onDrawn();
    });
  }

  setSurroundings(name: Surroundings): void {
    this.settings.surroundings = name;
    this.#picture.setPanorama(null);
    this.ask();
  }

  /** Sets an environment provided by the user, as an HDR file (Radiance). Throws if the file is invalid. */
  setPanorama(file: ArrayBuffer): void {
    this.#picture.setPanorama(panoramaOf(file));
    this.ask();
  }

  setShadows(on: boolean): void {
    this.settings.hasShadows = on;
    this.#picture.setShadows(on);
    this.ask();
  }

  /**
   * Switches between one picture and two pictures side by side. The whole model stays visible, from the same direction.
   */
  setBeside(on: boolean): void {
    if (on === this.settings.isBeside) return;
    this.settings.isBeside = on;
    this.#resize();
    this.reset(true, this.camera.position.clone().sub(this.target).normalize());
  }

  setLight(x: number, y: number): void {
    const length = Math.hypot(x, y), k = length > 1 ? 1 / length : 1;
    this.light.set(x * k, y * k, Math.sqrt(Math.max(0.0025, 1 - Math.min(1, length) ** 2))).normalize();
    this.ask();
  }

  /** Moves the camera to a position, looking at a target. */
  lookFrom(place: number[]): void {
    this.#eye.lookFrom(place);
    this.ask();
  }

  /** Animates the camera to show a sphere, from direction `toward` if given. */
  fly(center: Vector3, radius: number, toward: Vector3 | null, isInstant = false): PerspectiveCamera {
    return this.#eye.fly(center, radius, toward, isInstant);
  }

  /** Sets the direction of the view that `reset` shows; without an argument, the default direction. */
  setHome(toward?: Vector3): void {
    this.#eye.setHome(toward);
  }

  /** Shows the whole model, and returns the final camera. */
  reset(isInstant = false, toward?: Vector3): PerspectiveCamera {
    return this.#eye.reset(isInstant, toward);
  }

  /** Returns the index of the triangle at a position of the canvas (in CSS pixels), or -1. */
  async pick(x: number, y: number): Promise<number> {
    const from = this.#picture.readable(this.camera, this.settings.isBeside);
    return from ? pickTriangle(from, this.#pickTarget, x < from.size.x ? x : x - (this.canvas.clientWidth - from.size.x), y) : -1;
  }

  /** Returns the UV map of a part as pixels, top row first, or null without WebGL. `area`: scale and offset of UVs. */
  async drawMap(part: number, map: MapCorners, look: Look, isWire: boolean, size: { width: number; height: number }, area: [number, number, number, number]): Promise<Uint8ClampedArray<ArrayBuffer> | null> {
    const from = this.#picture.readable(this.camera);
    return from && drawUvMap(from, { ...this.#values(), look, isWire }, part, map, size, area);
  }

  /** Returns the current picture in pixels of the canvas, or null without WebGL. */
  draw(): OffscreenCanvas | null {
    if (!this.hasPicture) return null;
    this.#draw();
    // The canvas keeps its content until this task ends.
    const copy = new OffscreenCanvas(this.canvas.width, this.canvas.height);
    copy.getContext("2d")!.drawImage(this.canvas, 0, 0);
    return copy;
  }

  /**
   * Returns the position (0 to 1 along the width) that halves the area where both sides of the split line visibly
   * differ in the view of a camera; null if nothing differs, and without WebGL.
   */
  middleOfDifference(camera: PerspectiveCamera): number | null {
    const width = kCoarse, height = Math.max(1, Math.round((kCoarse * this.canvas.height) / this.canvas.width));
    if (!this.hasPicture || this.settings.isBeside || !hasSplit(this.settings.look)) return null;
    const [left, right] = [1, 0].map((split) => {
      this.#picture.draw(camera, { ...this.#values(camera), split: split * this.canvas.width }, split);
      const context = new OffscreenCanvas(width, height).getContext("2d")!;
      context.drawImage(this.canvas, 0, 0, width, height);
      return context.getImageData(0, 0, width, height).data;
    });
    this.ask();
    const columns = new Uint32Array(width);
    for (let i = 0; i < left.length; i += 4) {
      if ([0, 1, 2].some((k) => Math.abs(left[i + k] - right[i + k]) > kSeenStep)) columns[(i / 4) % width] += 1;
    }
    let rest = columns.reduce((sum, n) => sum + n, 0) / 2;
    const middle = columns.findIndex((n) => n > 0 && (rest -= n) <= 0);
    return middle < 0 ? null : (middle + 0.5) / width;
  }

  #values(camera = this.camera): PictureValues & Settings {
    const light = this.light.clone().transformDirection(camera.matrixWorld);
    return { ...this.settings, split: this.settings.split * this.canvas.width, light, eye: camera.position };
  }

  #draw(): void {
    this.camera.updateMatrixWorld();
    if (this.#picture.draw(this.camera, this.#values(), this.settings.split)) this.ask();
  }

  #dragLight(event: PointerEvent): void {
    if (!(event.buttons & 2)) return;
    const box = this.canvas.getBoundingClientRect(), radius = Math.min(box.width, box.height) / 2;
    this.setLight((event.clientX - box.left - box.width / 2) / radius, -(event.clientY - box.top - box.height / 2) / radius);
    this.canvas.dispatchEvent(new CustomEvent("light"));
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.#picture.renderer?.setSize(width, height, false);
    this.#eye.resize(this.settings.isBeside ? halfOf(width) : width, height);
    this.ask();
  }
}

/** Replaces an overlay of the picture. */
export function replaceOverlay(viewport: Viewport, old: Object3D | null, next: Object3D | null): Object3D | null {
  if (old) {
    viewport.overlay.remove(old);
    old.traverse((object) => (object as { geometry?: { dispose(): void } }).geometry?.dispose());
  }
  if (next) viewport.overlay.add(next);
  viewport.ask();
  return next;
}

export const inverse = (matrix: Matrix4): Matrix4 => matrix.clone().invert();
