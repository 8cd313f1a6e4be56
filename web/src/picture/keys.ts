// SPDX-License-Identifier: MIT
// Keys that rotate, move and zoom the picture.
import type { Eye } from "./camera.js";

const kStep = Math.PI / 24;

/** Moves the camera by a key; returns false if the key has no function. */
export function moveByKey(event: KeyboardEvent, eye: Eye): boolean {
  const c = eye.controls;
  const turn: Record<string, () => void> = {
    ArrowLeft: () => (event.shiftKey ? c.pan(30, 0) : c.rotateLeft(kStep)),
    ArrowRight: () => (event.shiftKey ? c.pan(-30, 0) : c.rotateLeft(-kStep)),
    ArrowUp: () => (event.shiftKey ? c.pan(0, 30) : c.rotateUp(kStep)),
    ArrowDown: () => (event.shiftKey ? c.pan(0, -30) : c.rotateUp(-kStep)),
    "+": () => c.dollyIn(0.88),
    "=": () => c.dollyIn(0.88),
    "-": () => c.dollyOut(0.88),
    "0": () => eye.reset(),
    Home: () => eye.reset(),
  };
  const act = turn[event.key];
  if (!act || event.ctrlKey || event.metaKey || event.altKey) return false;
  event.preventDefault();
  eye.stopFlight();
  act();
  c.update();
  return true;
}
