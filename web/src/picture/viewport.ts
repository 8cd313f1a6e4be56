// SPDX-License-Identifier: MIT
// The picture: camera, controls, light, and drawing when something has changed and not otherwise.
import { BufferAttribute, Color, DirectionalLight, Matrix4, NeutralToneMapping, NoBlending, PerspectiveCamera, Scene as ThreeScene, Vector2, Vector3, WebGLRenderer, WebGLRenderTarget, type Object3D } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Scene } from "./scene.js";
import { environmentFor, type Surroundings } from "./environment.js";
import { setValues, type Look, type PictureValues } from "./shader.js";
import type { MapCorners } from "../worker/protocol.js";

/** Looks with two sides. */
export const hasSplit = (look: Look): boolean => look === "lit" || look === "normals" || look === "signs";

export interface Settings {
  look: Look;
  map: 0 | 1 | 2;
  isWire: boolean;
  usesColors: boolean;
  /** 0 to 1 from the left: where frames of the file end and right ones begin. */
  split: number;
  /** What surfaces mirror. */
  surroundings: Surroundings;
  /** Whether parts keep the lamp off others. */
  hasShadows: boolean;
}

/** One attribute for each array, so that what was sent to the graphics card stays there. */
const attributes = new WeakMap<Float32Array, BufferAttribute>();
function attributeOf(values: Float32Array<ArrayBuffer>): BufferAttribute {
  const attribute = attributes.get(values) ?? new BufferAttribute(values, 2);
  attributes.set(values, attribute);
  return attribute;
}

const kStep = Math.PI / 24;
/** How much of the picture a model fills, along its width or its height. */
const kFilled = 0.85;

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

export class Viewport {
  readonly canvas: HTMLCanvasElement;
  readonly settings: Settings = { look: "lit", map: 1, isWire: false, usesColors: true, split: 0.5, surroundings: "room", hasShadows: false };
  /** Null where the browser has no WebGL: then nothing is drawn, and all else works. */
  readonly renderer: WebGLRenderer | null;
  readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  readonly overlay = new ThreeScene();
  scene = new Scene();
  /** What stands right of the line in the place of the scene: a file with other normals or triangles. */
  #right: Scene | null = null;
  /** Where light comes from, as the camera sees it: x right, y up, z to the eye. */
  readonly light = new Vector3(-0.45, 0.55, 0.7).normalize();
  onDrawn: () => void = () => {};
  #controls: OrbitControls;
  #world = new ThreeScene();
  #lamp = new DirectionalLight(0xffffff, 2);
  #isAsked = false;
  #hasDrawn = false;
  #flight: { from: Vector3; to: Vector3; fromTarget: Vector3; toTarget: Vector3; start: number } | null = null;
  #pickTarget = new WebGLRenderTarget(1, 1, { depthBuffer: true });

  constructor(canvas: HTMLCanvasElement) {
    this.canvas = canvas;
    this.renderer = rendererFor(canvas);
    this.#controls = new OrbitControls(this.camera, canvas);
    this.#controls.enableDamping = false;
    this.#controls.addEventListener("change", () => this.ask());
    this.#controls.mouseButtons.RIGHT = null; // drags the light
    this.#controls.keyPanSpeed = 24;
    canvas.addEventListener("keydown", (event) => this.#key(event));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("pointermove", (event) => this.#dragLight(event));
    canvas.addEventListener("webglcontextrestored", () => this.ask());
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.camera.position.set(0, 0, 4);
    this.#lamp.shadow.mapSize.set(2048, 2048);
    this.#world.add(this.#lamp, this.#lamp.target);
    this.#resize();
  }

  get hasPicture(): boolean {
    return this.renderer !== null;
  }

  /** What the camera looks at, and turns about. */
  get target(): Vector3 {
    return this.#controls.target;
  }

  show(scene: Scene): void {
    this.showRight(null);
    this.#world.remove(this.scene.root);
    this.scene.dispose();
    this.scene = scene;
    this.#world.add(scene.root);
    this.ask();
  }

  /** Another file right of the line, or none: then the scene itself stands there, in its right frames. */
  showRight(right: Scene | null): void {
    if (this.#right) this.#world.remove(this.#right.root);
    this.#right = right;
    if (right) {
      right.root.visible = false;
      this.#world.add(right.root);
    }
    this.ask();
  }

  /** Draws in the next frame. */
  ask(): void {
    if (this.#isAsked) return;
    this.#isAsked = true;
    requestAnimationFrame((now) => {
      this.#isAsked = false;
      this.#move(now);
      this.#draw();
      this.onDrawn();
    });
  }

  setSurroundings(name: Surroundings): void {
    this.settings.surroundings = name;
    this.#world.environment?.dispose();
    this.#world.environment = null; // made when it is drawn
    this.ask();
  }

  setShadows(on: boolean): void {
    this.settings.hasShadows = this.#lamp.castShadow = on;
    if (this.renderer) this.renderer.shadowMap.enabled = on;
    this.ask();
  }

  /** The lamp stands outside of the scene, and its shadows take in all of it. */
  #placeLamp(light: Vector3): void {
    this.#lamp.position.copy(light);
    if (!this.settings.hasShadows) return void this.#lamp.target.position.set(0, 0, 0);
    const { center, radius } = this.scene.sphere(), { camera } = this.#lamp.shadow;
    this.#lamp.target.position.copy(center);
    this.#lamp.position.multiplyScalar(2 * radius).add(center);
    Object.assign(camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 0.5 * radius, far: 3.5 * radius });
    camera.updateProjectionMatrix();
    this.#lamp.shadow.normalBias = 0.006 * radius; // about three texels of the shadow map
  }

  /** Puts the eye at a place, looking at another. */
  lookFrom([x, y, z, tx, ty, tz]: number[]): void {
    this.fly(new Vector3(tx, ty, tz), 1, null, true);
    this.#flight = null;
    this.camera.position.set(x, y, z);
    this.#controls.target.set(tx, ty, tz);
    const { center, radius } = this.scene.sphere(), far = this.camera.position.distanceTo(center) + radius;
    this.camera.near = far / 5000;
    this.camera.far = far * 3;
    this.camera.updateProjectionMatrix();
    this.#controls.update();
    this.ask();
  }

  setLight(x: number, y: number): void {
    const length = Math.hypot(x, y), k = length > 1 ? 1 / length : 1;
    this.light.set(x * k, y * k, Math.sqrt(Math.max(0.0025, 1 - Math.min(1, length) ** 2))).normalize();
    this.ask();
  }

  /** Looks at a sphere; from `toward`, where that is given. */
  fly(center: Vector3, radius: number, toward: Vector3 | null, isInstant = false): void {
    const angle = (this.camera.fov * Math.PI) / 360, narrow = Math.min(1, this.camera.aspect);
    const distance = (radius / Math.sin(Math.atan(Math.tan(angle) * narrow))) * 1.08;
    const direction = (toward ?? this.camera.position.clone().sub(this.#controls.target)).clone().normalize();
    if (direction.lengthSq() === 0 || !Number.isFinite(direction.x)) direction.set(0.5, 0.4, 1).normalize();
    // Straight from above, "up" would have no direction.
    if (Math.abs(direction.y) > 0.985) direction.set(0.12, Math.sign(direction.y), 0.12).normalize();
    this.#flyTo(center, distance, direction, isInstant);
  }

  #flyTo(center: Vector3, distance: number, direction: Vector3, isInstant: boolean): void {
    const to = center.clone().addScaledVector(direction, distance);
    const isCalm = isInstant || matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.#flight = { from: this.camera.position.clone(), to, fromTarget: this.#controls.target.clone(), toTarget: center.clone(), start: isCalm ? -Infinity : performance.now() };
    const size = this.scene.sphere();
    const far = size.radius + size.center.distanceTo(center) + distance;
    this.camera.near = Math.max(far / 5000, distance / 200);
    this.camera.far = far * 3;
    this.#controls.maxDistance = far * 2;
    this.camera.updateProjectionMatrix();
    this.ask();
  }

  reset(isInstant = false): void {
    const { center, radius } = this.scene.sphere(), toward = new Vector3(0.55, 0.42, 1).normalize();
    const { middle, distance } = this.#frameFor(this.scene.points(), center, radius, toward);
    this.#flyTo(middle, distance, toward, isInstant);
  }

  /** Where to look and from how far, so that points fill kFilled of the picture, along its width or its height. */
  #frameFor(points: Float32Array, center: Vector3, radius: number, toward: Vector3): { middle: Vector3; distance: number } {
    const across = Math.tan((this.camera.fov * Math.PI) / 360), sides = [across * this.camera.aspect, across];
    const right = new Vector3(0, 1, 0).cross(toward).normalize(), up = toward.clone().cross(right);
    const middle = center.clone();
    let distance = (radius / across) * 1.5;
    // What is near looks larger, so the middle and the distance depend on each other.
    for (let round = 0; round < 6 && points.length > 0; ++round) {
      const low = [Infinity, Infinity], high = [-Infinity, -Infinity], p = new Vector3();
      for (let i = 0; i < points.length; i += 3) {
        p.fromArray(points, i).sub(middle);
        const depth = Math.max(distance - p.dot(toward), 0.05 * distance);
        for (const [k, axis] of [right, up].entries()) {
          const at = p.dot(axis) / (depth * sides[k]);
          low[k] = Math.min(low[k], at), high[k] = Math.max(high[k], at);
        }
      }
      middle.addScaledVector(right, ((low[0] + high[0]) / 2) * sides[0] * distance).addScaledVector(up, ((low[1] + high[1]) / 2) * sides[1] * distance);
      distance = Math.max((distance * Math.max(high[0] - low[0], high[1] - low[1])) / (2 * kFilled), 1.02 * radius * 0.1);
    }
    return { middle, distance };
  }

  /** The number of the triangle at a place of the canvas, in CSS pixels, or -1. */
  async pick(x: number, y: number): Promise<number> {
    const { renderer } = this;
    if (!renderer) return -1;
    const ratio = renderer.getPixelRatio(), size = renderer.getSize(new Vector2());
    this.#setUniforms((u) => ((u.uIsPick.value = true), (u.uAlphaTest.value = 0)));
    this.camera.setViewOffset(size.x * ratio, size.y * ratio, Math.floor(x * ratio), Math.floor(y * ratio), 1, 1);
    renderer.setRenderTarget(this.#pickTarget);
    renderer.clear();
    renderer.render(this.#world, this.camera);
    renderer.setRenderTarget(null);
    this.camera.clearViewOffset();
    this.#setUniforms((u) => (u.uIsPick.value = false));
    const p = new Uint8Array(4);
    await renderer.readRenderTargetPixelsAsync(this.#pickTarget, 0, 0, 1, 1, p);
    return (p[0] | (p[1] << 8) | (p[2] << 16) | (p[3] << 24)) - 1;
  }

  /** The UV map of a part as pixels, from the top row down, or null without WebGL; `area` is scale and offset of UVs. */
  async drawMap(partIndex: number, map: MapCorners, look: Look, isWire: boolean, { width, height }: { width: number; height: number }, area: [number, number, number, number]): Promise<Uint8ClampedArray<ArrayBuffer> | null> {
    const { renderer } = this;
    if (!renderer) return null;
    const target = new WebGLRenderTarget(width, height, { samples: 4 });
    const { drawn } = this.scene;
    const clear = renderer.getClearColor(new Color()), alpha = renderer.getClearAlpha();
    drawn.forEach(({ meshes }, i) => meshes.forEach((mesh, k) => (mesh.visible = i === partIndex && k === 0)));
    const { material, geometry } = drawn[partIndex];
    const { side } = material, own = { mapUv: geometry.getAttribute("mapUv"), island: geometry.getAttribute("island") };
    setValues(material, { ...this.#values(), look, isWire, split: Infinity });
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
    renderer.render(this.#world, this.camera);
    renderer.setRenderTarget(null);
    renderer.setClearColor(clear, alpha);
    geometry.setAttribute("mapUv", own.mapUv).setAttribute("island", own.island);
    material.uniforms.uIsMap.value = false;
    material.depthTest = true;
    material.side = side;
    this.scene.show(false);
    const upsideDown = new Uint8ClampedArray(4 * width * height), rows = new Uint8ClampedArray(4 * width * height), row = 4 * width;
    await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height, upsideDown);
    target.dispose();
    for (let y = 0; y < height; ++y) rows.set(upsideDown.subarray(row * (height - 1 - y), row * (height - y)), row * y);
    return rows;
  }

  /** The picture as it is now, in pixels of the canvas; null without WebGL. */
  draw(): ImageBitmap | OffscreenCanvas | null {
    if (!this.renderer) return null;
    this.#draw();
    // The canvas holds what was drawn until this task ends.
    const copy = new OffscreenCanvas(this.canvas.width, this.canvas.height);
    copy.getContext("2d")!.drawImage(this.canvas, 0, 0);
    return copy;
  }

  #values(): PictureValues & Settings {
    const light = this.light.clone().transformDirection(this.camera.matrixWorld);
    return { ...this.settings, split: this.settings.split * this.canvas.width, light, eye: this.camera.position };
  }

  #setUniforms(change: (uniforms: Record<string, { value: unknown }>) => void): void {
    for (const { material, part } of this.scene.drawn) {
      material.uniforms.uAlphaTest.value = part.alphaTest;
      change(material.uniforms);
      material.uniformsNeedUpdate = true;
    }
  }

  #draw(): void {
    const { renderer } = this;
    // An empty canvas is what is there before the first model, and the graphics card has enough to do then.
    if (!renderer || (this.scene.drawn.length === 0 && !this.#hasDrawn)) return;
    this.camera.updateMatrixWorld();
    const values = this.#values();
    for (const { material } of this.scene.drawn) setValues(material, values);
    this.#placeLamp(values.light);
    // The first picture does not wait for the environment, which is blurred for each roughness.
    const wantsSurface = values.look === "lit" && values.usesColors && !values.isWire, isSurface = wantsSurface && this.#hasDrawn;
    if (isSurface) this.#world.environment ??= environmentFor(renderer, values.surroundings);
    else if (wantsSurface && this.scene.drawn.length > 0) this.ask();
    renderer.clear();
    if (this.#right && hasSplit(values.look)) this.#drawSides(renderer, this.#right, values, isSurface);
    else this.#drawScene(renderer, this.scene, isSurface);
    renderer.render(this.overlay, this.camera);
    if (this.scene.drawn.length > 0 && !this.#hasDrawn) performance.mark("first picture");
    this.#hasDrawn ||= this.scene.drawn.length > 0;
  }

  #drawScene(renderer: WebGLRenderer, scene: Scene, isSurface: boolean): void {
    scene.show(isSurface);
    renderer.render(this.#world, this.camera);
    scene.show(false);
  }

  /** Left of the line the scene, right of it the other file as that is: its own frames. */
  #drawSides(renderer: WebGLRenderer, right: Scene, values: PictureValues, isSurface: boolean): void {
    const { x: width, y: height } = renderer.getSize(new Vector2()), line = Math.round(width * Math.min(1, this.settings.split));
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
      this.#drawScene(renderer, scene, isSurface);
    }
    renderer.setScissorTest(false);
    this.scene.root.visible = true;
    right.root.visible = false;
  }

  #move(now: number): void {
    if (!this.#flight) return;
    const { from, to, fromTarget, toTarget, start } = this.#flight;
    const t = Math.min(1, (now - start) / 450), ease = t * t * (3 - 2 * t);
    this.camera.position.lerpVectors(from, to, ease);
    this.#controls.target.lerpVectors(fromTarget, toTarget, ease);
    if (t >= 1) this.#flight = null;
    this.#controls.update();
    if (this.#flight) this.ask();
  }

  #key(event: KeyboardEvent): void {
    const c = this.#controls;
    const turn: Record<string, () => void> = {
      ArrowLeft: () => (event.shiftKey ? c.pan(30, 0) : c.rotateLeft(kStep)),
      ArrowRight: () => (event.shiftKey ? c.pan(-30, 0) : c.rotateLeft(-kStep)),
      ArrowUp: () => (event.shiftKey ? c.pan(0, 30) : c.rotateUp(kStep)),
      ArrowDown: () => (event.shiftKey ? c.pan(0, -30) : c.rotateUp(-kStep)),
      "+": () => c.dollyIn(0.88),
      "=": () => c.dollyIn(0.88),
      "-": () => c.dollyOut(0.88),
      "0": () => this.reset(),
      Home: () => this.reset(),
    };
    const act = turn[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.#flight = null;
    act();
    c.update();
    this.ask();
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
    this.renderer?.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.ask();
  }
}

/** Adds to what lies over the picture, and takes it away. */
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
