// SPDX-License-Identifier: MIT
// Shows findings in the picture: selects a suitable look, outlines all affected triangles, and moves the camera to
// local findings.
import { Group, Vector3, type Camera, type Object3D } from "three";
import { bestDirection, facesOf, outlinePart, outlineTriangles, trianglesAt, type Place } from "../picture/overlays.js";
import type { Drawn } from "../picture/scene.js";
import type { Look } from "../picture/shader.js";
import { replaceOverlay, type Viewport } from "../picture/viewport.js";
import type { Finding } from "tspace/gltf";

/** Looks of this page for the views of `tspace render` that findings specify. */
const looks: Record<string, Look> = { sign: "signs", error: "difference", uv: "mirrored" };
export const lookOf = ({ show }: Finding): Look => looks[show] ?? "lit";

/** For findings about directions, tangents with a larger error than this are outlined. */
const kFarDegrees = 5;
/** Maximum numbers of findings, and of triangles of each, that determine the viewpoint. */
const kMostAimed = 50, kMostFaces = 2000;

/** Maximum number of triangles whose boundary is marked in the first view, which must not delay it. */
const kMostMarked = 20_000;

/** If a finding affects a larger fraction of the surface, the camera does not move. */
const kEverywhere = 0.5;

/** The view mirrored in x is considered if it shows more than this fraction of the area that the first view shows. */
const kNearlyAsMuch = 0.75;

/** Thresholds of `check` for tangents that are not unit, and for normals that point backward. */
const kUnit = 0.00674, kBack = -0.1;

/**
 * Returns a test for the triangles that a finding is about, selected by the prefix of its code; null if the picture
 * data cannot tell.
 */
function testFor({ code }: Finding, { corners: { positions: p, normals: n, tangents: t, islands }, frames }: Drawn): ((triangle: number) => boolean) | null {
  const errors = frames?.errors, isAny = (holds: (corner: number) => boolean) => (triangle: number) => holds(3 * triangle) || holds(3 * triangle + 1) || holds(3 * triangle + 2);
  if (errors && /^signs(Inverted|Wrong)/.test(code)) return isAny((corner) => errors[2 * corner + 1] > 0.5);
  if (errors && /^(directions|uvSet|mirroredSeam|uvSeam)/.test(code)) return isAny((corner) => errors[2 * corner] > kFarDegrees);
  if (t && code === "signsMixed") return (triangle) => Math.sign(t[12 * triangle + 3]) !== Math.sign(t[12 * triangle + 7]) || Math.sign(t[12 * triangle + 3]) !== Math.sign(t[12 * triangle + 11]);
  if (t && code === "tangentsNotUnit") return isAny((corner) => Math.abs(Math.hypot(t[4 * corner], t[4 * corner + 1], t[4 * corner + 2]) - 1) > kUnit);
  if (code === "uvsDegenerate") return (triangle) => islands[6 * triangle + 1] === 0.5;
  if (code === "normalsAgainstWinding") return (triangle) => facing(p, n, triangle) < kBack;
  return null;
}

/** Returns the cosine of the angle between a triangle's face normal and the sum of its corner normals. */
function facing(p: Float32Array, n: Float32Array, triangle: number): number {
  const i = 9 * triangle, own = [0, 0, 0], sum = [0, 0, 0], edge = (k: number, axis: number) => p[i + 3 * k + axis] - p[i + axis];
  for (let axis = 0; axis < 3; ++axis) {
    const y = (axis + 1) % 3, z = (axis + 2) % 3;
    own[axis] = edge(1, y) * edge(2, z) - edge(1, z) * edge(2, y);
    sum[axis] = n[i + axis] + n[i + 3 + axis] + n[i + 6 + axis];
  }
  const size = Math.hypot(...own) * Math.hypot(...sum);
  return size > 0 ? (own[0] * sum[0] + own[1] * sum[1] + own[2] * sum[2]) / size : 0;
}

/** Returns all triangles that a finding is about, or else those at the vertices in the finding. */
function trianglesOf(drawn: Drawn, finding: Finding): number[] {
  const holds = testFor(finding, drawn), count = drawn.corners.positions.length / 9;
  const found = holds ? Array.from({ length: count }, (_, triangle) => triangle).filter(holds) : [];
  return found.length > 0 ? found : trianglesAt(drawn, finding.vertices);
}

interface Face {
  center: Vector3;
  out: Vector3;
}

/** Clamps a position of the split line so that both sides remain visible. */
const inPicture = (share: number): number => Math.min(0.8, Math.max(0.2, share));

/** Returns the area of the faces that a camera sees, and the position (0 to 1 along the width) that halves it; null if it sees none. */
function middleOf(faces: Face[], camera: Camera): { seen: number; middle: number | null } {
  const spots: { x: number; size: number }[] = [];
  for (const { center, out } of faces) {
    const size = out.dot(camera.position.clone().sub(center).normalize());
    if (size > 0) spots.push({ x: center.clone().project(camera).x, size });
  }
  spots.sort((a, b) => a.x - b.x);
  const seen = spots.reduce((sum, { size }) => sum + size, 0);
  let left = seen / 2;
  const middle = spots.find(({ size }) => (left -= size) <= 0);
  return { seen, middle: middle ? (middle.x + 1) / 2 : null };
}

export class PlaceView {
  #outline: Object3D | null = null;

  constructor(private viewport: Viewport, private setLook: (look: Look) => void, private setSplit: (share: number) => void) {}

  /**
   * Moves the camera to where most of the findings' area is visible, with the split line at the center of the visible
   * difference: one half shows the file, the other half the correct frames. Of the best view and the one mirrored in x,
   * selects the view whose split line is closer to the center of the picture. Marks the boundary of the affected
   * triangles, unless most triangles, or more than kMostMarked, are affected.
   */
  aim(findings: Finding[]): void {
    const faces: Face[] = [], { scene } = this.viewport, rims = new Group();
    let marked = 0;
    for (const finding of findings.slice(0, kMostAimed)) {
      const drawn = finding.place === "" ? undefined : scene.find(finding.mesh, finding.primitive);
      if (!drawn) continue;
      const triangles = trianglesOf(drawn, finding), step = Math.ceil(triangles.length / kMostFaces);
      faces.push(...facesOf(drawn, triangles.filter((_, i) => i % step === 0)));
      marked += triangles.length;
      if (triangles.length > 0 && marked <= kMostMarked && finding.surfaceShare < kEverywhere) rims.add(outlineTriangles(drawn, triangles).rim);
    }
    const toEye = this.viewport.camera.position.clone().sub(this.viewport.target), isEverywhere = findings[0].surfaceShare >= kEverywhere, toward = isEverywhere ? toEye.normalize() : bestDirection(faces.map(({ out }) => out), toEye);
    if (!toward) return this.setSplit(0.5);
    const views = [toward, new Vector3(-toward.x, toward.y, toward.z)].map((direction) => {
      const { seen, middle } = middleOf(faces, this.viewport.reset(false, direction));
      return { direction, seen, distance: Math.abs((middle ?? 0) - 0.5) };
    });
    const isOtherBetter = !isEverywhere && views[1].seen > kNearlyAsMuch * views[0].seen && views[1].distance < views[0].distance;
    this.viewport.setHome(views[isOtherBetter ? 1 : 0].direction);
    const camera = this.viewport.reset(), middle = this.viewport.middleOfDifference(camera);
    if (middle === null) this.#splitAt(faces, camera);
    else this.setSplit(inPicture(middle));
    this.#outline = replaceOverlay(this.viewport, this.#outline, rims);
  }

  /** Moves the split line to the center of the visible faces. */
  #splitAt(faces: Face[], camera: Camera): void {
    const { middle } = middleOf(faces, camera);
    if (middle !== null) this.setSplit(inPicture(middle));
  }

  clear(): void {
    this.#outline = replaceOverlay(this.viewport, this.#outline, null);
  }

  /**
   * Shows findings and returns the number of outlined triangles. `isOne`: the findings are one of several locations.
   * `isOther`: the findings are about another file, so only parts can be outlined.
   */
  show(findings: Finding[], isOne: boolean, isOther: boolean): number {
    this.clear();
    this.setLook(lookOf(findings[0]));
    const { scene } = this.viewport, outline = new Group(), places: Pick<Place, "center" | "radius" | "faces">[] = [], faces: Face[] = [];
    let outlined = 0, seen = 0, isWhole = false;
    for (const finding of findings) {
      const drawn = finding.place === "" ? undefined : scene.find(finding.mesh, finding.primitive);
      if (!drawn) continue;
      seen += 1;
      const triangles = isOther ? [] : trianglesOf(drawn, finding);
      // A finding without vertices is about the whole primitive.
      isWhole = triangles.length === 0 && scene.drawn.length === 1;
      if (faces.length < kMostFaces) faces.push(...facesOf(drawn, triangles.slice(0, kMostFaces)));
      const place = triangles.length > 0 ? outlineTriangles(drawn, triangles) : { ...outlinePart(drawn), faces: [] };
      outlined += triangles.length > 0 ? triangles.length : drawn.corners.positions.length / 9;
      if (place.radius > 0) outline.add(place.outline);
      places.push(place);
    }
    this.#outline = replaceOverlay(this.viewport, null, outline);
    const share = isOne ? findings[0].surfaceShare : seen / Math.max(1, scene.drawn.length);
    const flies = seen > 0 && !isWhole && (isOne ? scene.drawn.length > 1 || share < kEverywhere : share < kEverywhere);
    const camera = flies ? this.#fly(places) : this.viewport.camera;
    this.#splitAt(faces, camera);
    return outlined;
  }

  #fly(places: Pick<Place, "center" | "radius" | "faces">[]): Camera {
    const center = places.reduce((sum, place) => sum.add(place.center), new Vector3()).divideScalar(places.length);
    const radius = Math.max(...places.map((place) => place.center.distanceTo(center) + place.radius));
    if (!(radius > 0)) return this.viewport.camera;
    const near = Math.max(radius * 1.25, this.viewport.scene.sphere().radius * 0.12);
    const toEye = this.viewport.camera.position.clone().sub(this.viewport.target);
    return this.viewport.fly(center, near, bestDirection(places.flatMap(({ faces }) => faces), toEye));
  }
}
