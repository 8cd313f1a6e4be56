// SPDX-License-Identifier: MIT
// Motion in a file: animations, morph weights, and cameras. The parts of the picture follow it.
import { AnimationMixer, Vector3, type AnimationClip, type Camera, type Mesh, type Object3D } from "three";
import { poseOf } from "./pose.js";
import type { Part } from "./part.js";

export interface MorphSlider {
  name: string;
  get: () => number;
  set: (weight: number) => void;
}

export class Motion {
  readonly clips: readonly AnimationClip[];
  readonly cameras: readonly Camera[];
  #mixer: AnimationMixer;
  #roots: readonly Object3D[];
  /** The first object of each part. Parts with several placements do not follow the motion of nodes. */
  #objects: readonly [Part, Mesh][];
  #chosen: AnimationClip | null = null;

  constructor(roots: readonly Object3D[], clips: readonly AnimationClip[], cameras: readonly Camera[], objects: readonly [Part, Mesh][]) {
    this.clips = clips;
    this.cameras = cameras;
    this.#roots = roots;
    this.#objects = objects;
    this.#mixer = new AnimationMixer(roots[0]);
  }

  /** Selects an animation; null: the pose stored in the file. */
  choose(clip: AnimationClip | null): void {
    this.#mixer.stopAllAction();
    this.#chosen = clip;
    if (clip) this.#mixer.clipAction(clip).play();
    this.#update();
  }

  at(seconds: number): void {
    if (!this.#chosen) return;
    this.#mixer.setTime(seconds);
    this.#update();
  }

  /** Returns the weights of all morph targets, with their names in the file. */
  sliders(): MorphSlider[] {
    return this.#objects.flatMap(([part, mesh]) => Object.entries(mesh.morphTargetDictionary ?? {}).map(([name, i]) => ({
      name: `${part.name || part.materialName || `${part.mesh}/${part.primitive}`}: ${name}`,
      get: () => mesh.morphTargetInfluences?.[i] ?? 0,
      set: (weight: number) => {
        if (mesh.morphTargetInfluences) mesh.morphTargetInfluences[i] = weight;
        this.#update();
      },
    })));
  }

  #update(): void {
    for (const root of this.#roots) root.updateMatrixWorld(true);
    for (const [part, mesh] of this.#objects) {
      part.pose = poseOf(mesh);
      if (part.places.length === 1 && !part.pose?.matrices) part.places[0].copy(mesh.matrixWorld).premultiply(part.moved);
    }
  }

  /** Returns the position of a camera, and a point that it looks at. */
  static viewOf(camera: Camera, distance: number): number[] {
    const at = new Vector3().setFromMatrixPosition(camera.matrixWorld), way = new Vector3(0, 0, -1).transformDirection(camera.matrixWorld);
    return [...at.toArray(), ...at.clone().addScaledVector(way, distance).toArray()];
  }
}
