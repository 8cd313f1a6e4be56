// SPDX-License-Identifier: MIT
// Shows findings in the picture: the look in which they are seen, outlines of all that they are about, and a flight to what is
// only somewhere.
import { Group, Vector3, type Object3D } from "three";
import { bestDirection, outlinePart, outlineTriangles, trianglesAt, type Place } from "../picture/overlays.js";
import type { Drawn } from "../picture/scene.js";
import type { Look } from "../picture/shader.js";
import { replaceOverlay, type Viewport } from "../picture/viewport.js";
import type { Finding } from "tspace/gltf";

/** The look in which a kind of finding is seen, by how its name begins. */
const looks: readonly (readonly [RegExp, Look])[] = [
  [/^signs/, "signs"],
  [/^(mirroredSeam|uvSeam|directions|uvSet|textureTransform|splitFrames|tangents(NotOrthogonal|NotUnit|NotFinite))/, "difference"],
  [/^uvsDegenerate/, "mirrored"],
];
export const lookOf = ({ code }: Finding): Look => looks.find(([pattern]) => pattern.test(code))?.[1] ?? "lit";

/** Tangents farther off than this are outlined where a finding is about directions. */
const kFarDegrees = 5;
/** Of a finding on more of the surface than this the picture stays where it is. */
const kEverywhere = 0.5;

/** The triangles that a finding is about, as the comparison with right frames has them; else those at the vertices it names. */
function trianglesOf(drawn: Drawn, finding: Finding): number[] {
  const errors = drawn.frames?.errors, found: number[] = [];
  const isSign = /^signs(Inverted|Wrong)/.test(finding.code), isDirection = /^(directions|uvSet|mirroredSeam|uvSeam)/.test(finding.code);
  if (errors && (isSign || isDirection)) {
    const isFar = (corner: number) => (isSign ? errors[2 * corner + 1] > 0.5 : errors[2 * corner] > kFarDegrees);
    for (let t = 0; t < errors.length / 6; ++t) if (isFar(3 * t) || isFar(3 * t + 1) || isFar(3 * t + 2)) found.push(t);
  }
  return found.length > 0 ? found : trianglesAt(drawn, finding.vertices);
}

export class PlaceView {
  #outline: Object3D | null = null;

  constructor(private viewport: Viewport, private setLook: (look: Look) => void) {}

  clear(): void {
    this.#outline = replaceOverlay(this.viewport, this.#outline, null);
  }

  /** Returns how many triangles are outlined. isOne: of several places this one. */
  show(findings: Finding[], isOne: boolean): number {
    this.clear();
    this.setLook(lookOf(findings[0]));
    const { scene } = this.viewport, outline = new Group(), places: Omit<Place, "outline">[] = [];
    let outlined = 0, seen = 0;
    for (const finding of findings) {
      const drawn = finding.place === "" ? undefined : scene.find(finding.mesh, finding.primitive);
      if (!drawn) continue;
      seen += 1;
      const triangles = trianglesOf(drawn, finding);
      // Without vertices the finding is about all of the primitive.
      const place = triangles.length > 0 ? outlineTriangles(drawn, triangles) : { ...outlinePart(drawn), faces: [] };
      outlined += triangles.length > 0 ? triangles.length : drawn.corners.positions.length / 9;
      if (place.radius > 0) outline.add(place.outline);
      places.push(place);
    }
    this.#outline = replaceOverlay(this.viewport, null, outline);
    const share = isOne ? findings[0].surfaceShare : seen / Math.max(1, scene.drawn.length);
    if (seen > 0 && (isOne ? scene.drawn.length > 1 || share < kEverywhere : share < kEverywhere)) this.#fly(places);
    return outlined;
  }

  #fly(places: Omit<Place, "outline">[]): void {
    const center = places.reduce((sum, place) => sum.add(place.center), new Vector3()).divideScalar(places.length);
    const radius = Math.max(...places.map((place) => place.center.distanceTo(center) + place.radius));
    if (!(radius > 0)) return;
    const near = Math.max(radius * 1.25, this.viewport.scene.sphere().radius * 0.12);
    const toEye = this.viewport.camera.position.clone().sub(this.viewport.target);
    this.viewport.fly(center, near, bestDirection(places.flatMap(({ faces }) => faces), toEye));
  }
}
