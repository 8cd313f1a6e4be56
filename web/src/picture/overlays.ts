// SPDX-License-Identifier: MIT
// Overlays of the picture: T, B and N as lines, and outlines of triangles that a finding names.
import { Box3, Box3Helper, BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial, Sphere, Vector3 } from "three";
import { PlacedFrame } from "./frame.js";
import type { Drawn, Scene } from "./scene.js";

export type Axis = "t" | "b" | "n";

const kMostLines = 40_000;
const colors: Record<Axis, number> = { t: 0xe5484d, b: 0x30a46c, n: 0x3e8ef7 };
const lineMaterials = Object.fromEntries(Object.entries(colors).map(([axis, color]) => [axis, new LineBasicMaterial({ color })])) as Record<Axis, LineBasicMaterial>;

/** Returns T, B or N of a corner in world space, with its length in the file. */
function vectorAt(drawn: Drawn, frame: PlacedFrame, tangents: Float32Array | null, corner: number, axis: Axis): Vector3 | null {
  const n = new Vector3().fromArray(drawn.corners.normals, 3 * corner);
  if (axis === "n") return frame.normal(n).multiplyScalar(n.length());
  if (!tangents) return null;
  const t = new Vector3().fromArray(tangents, 4 * corner), w = tangents[4 * corner + 3];
  return axis === "t" ? frame.tangent(t).multiplyScalar(t.length()) : frame.bitangent(n, t, w).setLength(n.clone().cross(t).length() * Math.abs(w));
}

/**
 * Returns the corners whose frames are drawn, at most `most`, evenly chosen: one per vertex, or all corners if frames
 * differ by corner.
 */
function shownCorners(drawn: Drawn, isRight: boolean, most: number): number[] {
  const indices = drawn.part.arrays.indices, count = drawn.corners.positions.length / 3;
  if (isRight || !indices) {
    const step = Math.max(1, Math.ceil(count / most));
    return Array.from({ length: Math.floor(count / step) }, (_, i) => i * step);
  }
  const seen = new Uint8Array(drawn.part.arrays.positions.length / 3), corners: number[] = [];
  for (let corner = 0; corner < count; ++corner) {
    if (!seen[indices[corner]]) corners.push(corner);
    seen[indices[corner]] = 1;
  }
  const step = Math.max(1, Math.ceil(corners.length / most));
  return corners.filter((_, i) => i % step === 0);
}

/** Returns T, B and N of the file's frames, or of those on the right side, as lines of the given length. */
export function frameLines(scene: Scene, axes: Axis[], isRight: boolean, length: number): Group {
  const group = new Group();
  const most = Math.ceil(kMostLines / Math.max(1, scene.drawn.length));
  const p = new Vector3();
  for (const drawn of scene.drawn) {
    const tangents = isRight ? (drawn.frames?.tangents ?? null) : drawn.corners.tangents;
    const corners = shownCorners(drawn, isRight, most);
    for (const place of drawn.part.places) {
      const frame = new PlacedFrame(place);
      for (const axis of axes) {
        const ends: number[] = [];
        for (const corner of corners) {
          const v = vectorAt(drawn, frame, tangents, corner, axis);
          if (!v || !Number.isFinite(v.x + v.y + v.z)) continue;
          p.fromArray(drawn.corners.positions, 3 * corner).applyMatrix4(place);
          v.clampLength(0, 4).multiplyScalar(length);
          ends.push(p.x, p.y, p.z, p.x + v.x, p.y + v.y, p.z + v.z);
        }
        const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(ends), 3));
        const lines = new LineSegments(geometry, lineMaterials[axis]);
        lines.frustumCulled = false;
        group.add(lines);
      }
    }
  }
  return group;
}

/** Returns the mean edge length of the drawn triangles. */
export function usualEdge(scene: Scene): number {
  let sum = 0, count = 0;
  const a = new Vector3(), b = new Vector3();
  for (const { corners, part } of scene.drawn) {
    const scale = part.places[0]?.getMaxScaleOnAxis() ?? 1, triangles = corners.positions.length / 9;
    const step = Math.max(1, Math.floor(triangles / 500));
    for (let t = 0; t < triangles; t += step) {
      const edge = a.fromArray(corners.positions, 9 * t).distanceTo(b.fromArray(corners.positions, 9 * t + 3)) * scale;
      if (Number.isFinite(edge) && edge > 0) (sum += edge), (count += 1);
    }
  }
  return count > 0 ? sum / count : 1;
}

const outlineMaterial = new LineBasicMaterial({ color: 0xff2d6f, depthTest: false, transparent: true });
const rimMaterial = new LineBasicMaterial({ color: 0xff2d6f });
const fillMaterial = new MeshBasicMaterial({ color: 0xff2d6f, transparent: true, opacity: 0.28, depthTest: false, side: 2 });

/** Material for large regions: drawn only where they are visible, and transparent. */
const regionMaterial = new MeshBasicMaterial({ color: 0xff2d6f, transparent: true, opacity: 0.1, side: 2, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 });

export interface Place {
  outline: Group;
  /** The part of `outline` that consists of lines. */
  rim: LineSegments;
  center: Vector3;
  radius: number;
  /** Outward normal of each triangle; its length is the triangle's area. */
  faces: Vector3[];
}

const steps = [-1, 0, 1];
const directions = steps.flatMap((x) => steps.flatMap((y) => steps.map((z) => new Vector3(x, y, z)))).filter((v) => v.lengthSq() > 0).map((v) => v.normalize());

/**
 * Returns the direction from which most of the triangles' area is visible. Prefers the current direction if nearly as
 * much is visible from there; null: no direction.
 */
export function bestDirection(faces: Vector3[], toEye: Vector3): Vector3 | null {
  const seenFrom = (direction: Vector3) => faces.reduce((sum, face) => sum + Math.max(0, face.dot(direction)), 0);
  const out = faces.reduce((sum, face) => sum.add(face), new Vector3()).normalize(), eye = toEye.clone().normalize();
  const all = [...directions, out], seen = all.map(seenFrom), most = Math.max(...seen);
  if (!(most > 0)) return null;
  return seenFrom(eye) > 0.75 * most ? eye : all[seen.indexOf(most)];
}

/** Maximum number of triangles whose edges are all drawn; of more triangles only the boundary is drawn. */
const kMostEdges = 60;

/** Returns the edges that belong to exactly one of the triangles, compared by position, as pairs of corners. */
function rimOf(p: Float32Array, triangles: number[]): [number, number][] {
  const numbers = new Map<string, number>(), edges = new Map<string, [number, number] | null>();
  const number = (corner: number) => {
    const key = `${p[3 * corner]} ${p[3 * corner + 1]} ${p[3 * corner + 2]}`;
    if (!numbers.has(key)) numbers.set(key, numbers.size);
    return numbers.get(key)!;
  };
  for (const triangle of triangles) {
    const corners = [0, 1, 2].map((k) => 3 * triangle + k), own = corners.map(number);
    for (let k = 0; k < 3; ++k) {
      const a = own[k], b = own[(k + 1) % 3], key = a < b ? `${a} ${b}` : `${b} ${a}`;
      edges.set(key, edges.has(key) ? null : [corners[k], corners[(k + 1) % 3]]);
    }
  }
  return [...edges.values()].filter((edge) => edge !== null);
}

/**
 * Returns centers and outward normals of triangles of a part, at its first placement. The length of a normal is the
 * triangle's area.
 */
export function facesOf(drawn: Drawn, triangles: number[]): { center: Vector3; out: Vector3 }[] {
  const { positions: p, normals: n } = drawn.corners, frame = new PlacedFrame(drawn.part.places[0] ?? new Matrix4()), matrix = drawn.part.places[0] ?? new Matrix4();
  return triangles.map((triangle) => {
    const [a, b, c] = [0, 1, 2].map((k) => new Vector3().fromArray(p, 9 * triangle + 3 * k).applyMatrix4(matrix)), out = new Vector3();
    for (let k = 0; k < 3; ++k) out.add(frame.normal(new Vector3().fromArray(n, 9 * triangle + 3 * k)));
    const twiceArea = b.clone().sub(a).cross(c.clone().sub(a)).length();
    return { center: a.add(b).add(c).divideScalar(3), out: out.setLength(twiceArea / 2) };
  }).filter(({ center, out }) => Number.isFinite(center.lengthSq() + out.lengthSq()));
}

/** Outlines some triangles of a part, at its first placement. */
export function outlineTriangles(drawn: Drawn, triangles: number[]): Place {
  const p = drawn.corners.positions, n = drawn.corners.normals;
  const edges: number[] = [], faces: number[] = [], points: Vector3[] = [];
  const matrix = drawn.part.places[0] ?? new Matrix4();
  const outward: Vector3[] = [], own = new Vector3(), frame = new PlacedFrame(matrix);
  for (const triangle of triangles) {
    const corner = [0, 1, 2].map((k) => new Vector3().fromArray(p, 9 * triangle + 3 * k).applyMatrix4(matrix));
    if (!corner.every((c) => Number.isFinite(c.x + c.y + c.z))) continue;
    const face = new Vector3();
    corner.forEach((c, k) => {
      const next = corner[(k + 1) % 3];
      if (triangles.length <= kMostEdges) edges.push(c.x, c.y, c.z, next.x, next.y, next.z);
      faces.push(c.x, c.y, c.z);
      if (Number.isFinite(own.fromArray(n, 9 * triangle + 3 * k).x)) face.add(frame.normal(own));
    });
    const twiceArea = corner[1].clone().sub(corner[0]).cross(corner[2].clone().sub(corner[0])).length();
    outward.push(face.setLength(twiceArea / 2));
    points.push(...corner);
  }
  if (triangles.length > kMostEdges) {
    const end = new Vector3();
    for (const rim of rimOf(p, triangles)) for (const corner of rim) edges.push(...end.fromArray(p, 3 * corner).applyMatrix4(matrix).toArray());
  }
  const outline = new Group();
  const geometry = (data: number[]) => new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(data), 3));
  const rim = new LineSegments(geometry(edges), triangles.length <= kMostEdges ? outlineMaterial : rimMaterial);
  for (const object of [new Mesh(geometry(faces), triangles.length <= kMostEdges ? fillMaterial : regionMaterial), rim]) {
    object.frustumCulled = false;
    outline.add(object);
  }
  const center = points.reduce((sum, point) => sum.add(point), new Vector3()).divideScalar(Math.max(1, points.length));
  const radius = points.reduce((most, point) => Math.max(most, point.distanceTo(center)), 0);
  return { outline, rim, center, radius, faces: outward };
}

/** Outlines the bounding box of a part, at its first placement. */
export function outlinePart(drawn: Drawn): Pick<Place, "outline" | "center" | "radius"> {
  const p = drawn.corners.positions, box = new Box3(), point = new Vector3();
  for (let i = 0; i < p.length; i += 3) if (Number.isFinite(point.fromArray(p, i).lengthSq())) box.expandByPoint(point);
  const helper = new Box3Helper(box);
  helper.material = outlineMaterial;
  const outline = new Group().add(helper);
  outline.applyMatrix4(drawn.part.places[0] ?? new Matrix4());
  const { center, radius } = box.applyMatrix4(outline.matrix).getBoundingSphere(new Sphere());
  return { outline, center, radius };
}

const kMostOutlined = 3000;

/** Returns the triangles that use any of these vertices of the primitive. */
export function trianglesAt(drawn: Drawn, vertices: number[]): number[] {
  const wanted = new Set(vertices), indices = drawn.part.arrays.indices, found: number[] = [];
  const count = drawn.corners.positions.length / 3;
  for (let corner = 0; corner < count && found.length < kMostOutlined; ++corner) {
    const triangle = Math.floor(corner / 3);
    if (wanted.has(indices ? indices[corner] : corner) && found[found.length - 1] !== triangle) found.push(triangle);
  }
  return found;
}
