// SPDX-License-Identifier: MIT
// Flies to the place of a finding and outlines it.
import type { Object3D } from "three";
import { outlinePart, outlineTriangles, trianglesAt } from "../picture/overlays.js";
import type { Drawn } from "../picture/scene.js";
import { replaceOverlay, type Viewport } from "../picture/viewport.js";
import type { Finding } from "tspace/gltf";

export class PlaceView {
  #outline: Object3D | null = null;

  constructor(private viewport: Viewport) {}

  clear(): void {
    this.#outline = replaceOverlay(this.viewport, this.#outline, null);
  }

  /** Returns how many triangles are outlined. */
  show(finding: Finding): number {
    this.clear();
    const drawn = this.viewport.scene.find(finding.mesh, finding.primitive);
    if (!drawn || finding.place === "") {
      this.viewport.reset();
      return 0;
    }
    const triangles = trianglesAt(drawn, finding.vertices);
    // Without vertices the finding is about all of the primitive.
    if (triangles.length === 0) return this.#showPart(drawn);
    const { outline, center, radius, normal } = outlineTriangles(drawn, triangles);
    if (radius === 0) outline.clear();
    this.#outline = replaceOverlay(this.viewport, null, outline);
    const all = this.viewport.scene.sphere();
    const near = Math.max(radius * 1.5, all.radius * 0.12);
    if (radius > 0) this.viewport.fly(center, near, normal.lengthSq() > 0.01 ? normal.normalize() : null);
    return triangles.length;
  }

  #showPart(drawn: Drawn): number {
    const { outline, center, radius } = outlinePart(drawn);
    this.#outline = replaceOverlay(this.viewport, null, outline);
    if (radius > 0) this.viewport.fly(center, radius, null);
    return drawn.corners.positions.length / 9;
  }
}
