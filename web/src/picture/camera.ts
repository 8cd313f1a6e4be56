// SPDX-License-Identifier: MIT
// The camera: position, target, and animated transitions.
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Scene } from "./scene.js";

/** Fraction of the picture's width or height that a model fills. */
const kFilled = 0.85;
/** Initial viewing direction. */
const kFirstDirection = new Vector3(0.55, 0.42, 1).normalize();

/** Returns a unit direction to look from: zero, and directions along the vertical (without "up"), are replaced. */
function usable(toward: Vector3): Vector3 {
  const direction = toward.clone().normalize();
  if (direction.lengthSq() === 0 || !Number.isFinite(direction.x)) direction.set(0.5, 0.4, 1).normalize();
  if (Math.abs(direction.y) > 0.985) direction.set(0.12, Math.sign(direction.y), 0.12).normalize();
  return direction;
}

export class Eye {
  readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  readonly controls: OrbitControls;
  /** Direction from which the whole model is shown, unless another one is given. */
  #home = kFirstDirection;
  #flight: { from: Vector3; to: Vector3; fromTarget: Vector3; toTarget: Vector3; start: number } | null = null;

  constructor(canvas: HTMLCanvasElement, private sceneNow: () => Scene, private ask: () => void) {
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.ask());
    this.controls.mouseButtons.RIGHT = null; // drags the light
    this.controls.keyPanSpeed = 24;
    this.camera.position.set(0, 0, 4);
  }

  /** The point that the camera looks at and orbits. */
  get target(): Vector3 {
    return this.controls.target;
  }

  /** Moves the camera to a position, looking at a target. */
  lookFrom([x, y, z, tx, ty, tz]: number[]): void {
    this.fly(new Vector3(tx, ty, tz), 1, null, true);
    this.stopFlight();
    this.camera.position.set(x, y, z);
    this.controls.target.set(tx, ty, tz);
    const { center, radius } = this.sceneNow().sphere(), far = this.camera.position.distanceTo(center) + radius;
    this.camera.near = far / 5000;
    this.camera.far = far * 3;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.ask();
  }

  /** Animates the camera to show a sphere, from direction `toward` if given. Returns the final camera. */
  fly(center: Vector3, radius: number, toward: Vector3 | null, isInstant = false): PerspectiveCamera {
    const angle = (this.camera.fov * Math.PI) / 360, narrow = Math.min(1, this.camera.aspect);
    const distance = (radius / Math.sin(Math.atan(Math.tan(angle) * narrow))) * 1.08;
    const direction = usable(toward ?? this.camera.position.clone().sub(this.controls.target));
    return this.#flyTo(center, distance, direction, isInstant);
  }

  #flyTo(center: Vector3, distance: number, direction: Vector3, isInstant: boolean): PerspectiveCamera {
    const to = center.clone().addScaledVector(direction, distance);
    const isCalm = isInstant || matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.#flight = isCalm ? null : { from: this.camera.position.clone(), to, fromTarget: this.controls.target.clone(), toTarget: center.clone(), start: performance.now() };
    const size = this.sceneNow().sphere();
    const far = size.radius + size.center.distanceTo(center) + distance;
    this.camera.near = Math.max(far / 5000, distance / 200);
    this.camera.far = far * 3;
    this.controls.maxDistance = far * 2;
    this.camera.updateProjectionMatrix();
    if (isCalm) { // at once, because the next flight begins where this one ends
      this.camera.position.copy(to);
      this.controls.target.copy(center);
      this.controls.update();
    }
    this.ask();
    const there = this.camera.clone();
    there.position.copy(to);
    there.lookAt(center);
    there.updateMatrixWorld();
    return there;
  }

  /** Shows the whole model from a direction, and returns the final camera. */
  reset(isInstant = false, from = this.#home): PerspectiveCamera {
    const toward = usable(from), scene = this.sceneNow(), { center, radius } = scene.sphere();
    const { middle, distance } = this.#frameFor(scene.points(), center, radius, toward);
    return this.#flyTo(middle, distance, toward, isInstant);
  }

  /** Returns the target and the distance from which the points fill kFilled of the picture's width or height. */
  #frameFor(points: Float32Array, center: Vector3, radius: number, toward: Vector3): { middle: Vector3; distance: number } {
    const across = Math.tan((this.camera.fov * Math.PI) / 360), sides = [across * this.camera.aspect, across];
    const right = new Vector3(0, 1, 0).cross(toward).normalize(), up = toward.clone().cross(right);
    const middle = center.clone();
    let distance = (radius / across) * 1.5;
    // In perspective closer points look larger, so center and distance depend on each other.
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

  setHome(toward = kFirstDirection): void {
    this.#home = toward;
  }

  stopFlight(): void {
    this.#flight = null;
  }

  /** Advances the current animation, if any. */
  move(now: number): void {
    if (!this.#flight) return;
    const { from, to, fromTarget, toTarget, start } = this.#flight;
    const t = Math.min(1, (now - start) / 450), ease = t * t * (3 - 2 * t);
    this.camera.position.lerpVectors(from, to, ease);
    this.controls.target.lerpVectors(fromTarget, toTarget, ease);
    if (t >= 1) this.#flight = null;
    this.controls.update();
    if (this.#flight) this.ask();
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }
}
