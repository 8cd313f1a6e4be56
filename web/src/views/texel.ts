// SPDX-License-Identifier: MIT
// Information at the pointer: the texel, its normal, the frame there, and the angle between the results of both frames.
import { Matrix4, Ray, Vector2, Vector3, type Texture } from "three";
import { el, replaceChildren } from "../dom.js";
import { PlacedFrame } from "../picture/frame.js";
import type { Drawn } from "../picture/scene.js";
import type { Viewport } from "../picture/viewport.js";

export interface Spot {
  drawn: Drawn;
  partIndex: number;
  /** Index of the part's triangle, and the barycentric weights of its corners. */
  triangle: number;
  weights: [number, number, number];
}

/** Returns the barycentric weights where a ray meets the plane of a triangle. */
function weightsAt(ray: Ray, a: Vector3, b: Vector3, c: Vector3): Vector3 | null {
  const ab = b.clone().sub(a), ac = c.clone().sub(a), normal = ab.clone().cross(ac);
  const along = normal.dot(ray.direction);
  if (along === 0) return null;
  const p = ray.at(normal.dot(a.clone().sub(ray.origin)) / along, new Vector3()).sub(a);
  const area = normal.lengthSq();
  const v = p.clone().cross(ac).dot(normal) / area, w = ab.clone().cross(p).dot(normal) / area;
  return Number.isFinite(v + w) ? new Vector3(1 - v - w, v, w) : null;
}

/** Reads single texels of images. */
class TexelReader {
  #context = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });

  read(texture: Texture, u: number, v: number): { column: number; row: number; rgb: [number, number, number] } | null {
    const image = texture.image as { width: number; height: number };
    if (!this.#context || !(image.width > 0)) return null;
    const wrap = (x: number) => x - Math.floor(x);
    const column = Math.min(image.width - 1, Math.floor(wrap(u) * image.width));
    const row = Math.min(image.height - 1, Math.floor(wrap(v) * image.height));
    this.#context.globalCompositeOperation = "copy"; // replaces the previous texel instead of drawing over it
    this.#context.drawImage(texture.image as CanvasImageSource, column, row, 1, 1, 0, 0, 1, 1);
    const [r, g, b] = this.#context.getImageData(0, 0, 1, 1).data;
    return { column, row, rgb: [r, g, b] };
  }
}

const text = (v: Vector3): string => [v.x, v.y, v.z].map((x) => (Math.abs(x) < 0.0005 ? "0.000" : x.toFixed(3)).replace("-", "−")).join("  ");

export class TexelView {
  readonly element = el("details", { class: "panel texel", open: innerWidth >= 900 }, el("summary", {}, "At the pointer"));
  #body = el("div", { class: "rows" });
  #reader = new TexelReader();
  #isBusy = false;
  #next: PointerEvent | null = null;

  constructor(private viewport: Viewport, private found: (spot: Spot | null) => void) {
    this.element.append(this.#body);
    this.reset();
    viewport.canvas.addEventListener("pointermove", (event) => event.buttons === 0 && void this.#look(event));
    viewport.canvas.addEventListener("pointerleave", () => ((this.#next = null), this.found(null)));
    viewport.canvas.addEventListener("pointerdown", (event) => event.pointerType !== "mouse" && void this.#look(event));
  }

  reset(): void {
    this.#say("Point at the model to see the texel and the tangent frame at that position.");
  }

  #say(sentence: string): void {
    replaceChildren(this.#body, el("p", { class: "quiet" }, sentence));
  }

  async #look(event: PointerEvent): Promise<void> {
    this.#next = event;
    if (this.#isBusy) return;
    this.#isBusy = true;
    try {
      while (this.#next) {
        const { clientX, clientY } = this.#next;
        this.#next = null;
        const box = this.viewport.canvas.getBoundingClientRect();
        await this.#show(clientX - box.left, clientY - box.top, box);
      }
    } finally {
      this.#isBusy = false;
    }
  }

  async #show(x: number, y: number, box: DOMRect): Promise<void> {
    const { viewport } = this, { scene } = viewport;
    const hit = scene.at(await viewport.pick(x, y));
    if (!hit) return this.found(null);
    const { drawn, place, triangle } = hit;
    const pointer = new Vector2((x / box.width) * 2 - 1, 1 - (y / box.height) * 2);
    const far = new Vector3(pointer.x, pointer.y, 0.5).unproject(viewport.camera);
    const ray = new Ray(viewport.camera.position.clone(), far.sub(viewport.camera.position).normalize()).applyMatrix4(new Matrix4().copy(place).invert());
    const p = drawn.corners.positions;
    const [a, b, c] = [0, 3, 6].map((k) => new Vector3().fromArray(p, 9 * triangle + k));
    const weights = weightsAt(ray, a, b, c);
    if (weights) this.#describe(drawn, place, triangle, weights);
  }

  #describe(drawn: Drawn, place: Matrix4, triangle: number, weights: Vector3): void {
    const mix = (data: Float32Array, size: number, k: number) => {
      const at = (corner: number) => data[size * (3 * triangle + corner) + k];
      return weights.x * at(0) + weights.y * at(1) + weights.z * at(2);
    };
    const mixed = (data: Float32Array, size: number) => new Vector3(mix(data, size, 0), mix(data, size, 1), mix(data, size, 2));
    const { corners, frames, part } = drawn;
    const n = mixed(corners.normals, 3), frame = new PlacedFrame(place);
    // Like in the shaders: a frame at each corner, interpolated.
    const shaded = (tangents: Float32Array, { x, y, z }: Vector3) => [0, 1, 2].reduce((sum, k) => {
      const corner = 3 * triangle + k, weight = weights.getComponent(k);
      const normal = new Vector3().fromArray(corners.normals, 3 * corner), t = new Vector3().fromArray(tangents, 4 * corner);
      return sum.addScaledVector(frame.tangent(t), weight * x).addScaledVector(frame.bitangent(normal, t, tangents[4 * corner + 3]), weight * y).addScaledVector(frame.normal(normal), weight * z);
    }, new Vector3()).normalize();
    const uv: [number, number] | null = corners.uvs && [mix(corners.uvs, 2, 0), mix(corners.uvs, 2, 1)];
    this.found({ drawn, partIndex: this.viewport.scene.drawn.indexOf(drawn), triangle, weights: [weights.x, weights.y, weights.z] });
    const texelOf = (map: Texture | null) => (uv && map ? this.#reader.read(map, uv[0], uv[1]) : null);
    const normalOf = (texel: ReturnType<typeof texelOf>, turn = 1) => {
      const [x, y, z] = texel ? texel.rgb.map((c) => (c / 255) * 2 - 1) : [0, 0, 1];
      return new Vector3(x * part.normalScale, turn * y * part.normalScale, z).normalize();
    };
    const texel = texelOf(part.normalMap), decoded = normalOf(texel);
    const rightNormal = drawn.rightMap === part.normalMap && !drawn.turnsGreen ? decoded : normalOf(texelOf(drawn.rightMap), drawn.turnsGreen ? -1 : 1);
    const rows: [string, string][] = [];
    const vertices = [0, 1, 2].map((k) => (part.arrays.indices ? part.arrays.indices[3 * triangle + k] : 3 * triangle + k));
    rows.push(["Triangle", `${triangle} (vertices ${vertices.join(", ")})`]);
    if (uv) rows.push(["UV", uv.map((x) => x.toFixed(4)).join("  ")]);
    if (texel) rows.push(["Texel", `${texel.column}, ${texel.row}: ${texel.rgb.join(" ")}`], ["Its normal", text(decoded)]);
    if (drawn.turnsGreen) rows.push(["Green inverted", text(rightNormal)]);
    rows.push(["N", text(n.clone().normalize())]);
    const results: Vector3[] = [];
    for (const [whose, tangents, lit] of [["file", corners.tangents, decoded], ["right", frames?.tangents ?? null, rightNormal]] as const) {
      if (!tangents) {
        rows.push([`T, ${whose}`, "none"]);
        continue;
      }
      const t = mixed(tangents, 4), w = mix(tangents, 4, 3);
      const bitangent = n.clone().cross(t).multiplyScalar(w);
      rows.push([`T, ${whose}`, text(t.clone().normalize())], [`B, ${whose}`, `${text(bitangent.clone().normalize())}  (w ${w > 0 ? "+" : "−"}${Math.abs(w).toFixed(w * w === 1 ? 0 : 2)})`]);
      results.push(shaded(tangents, lit));
    }
    const list = el("dl", {});
    for (const [name, value] of rows) list.append(el("dt", {}, name), el("dd", {}, value));
    if (results.length === 2) {
      const degrees = (Math.acos(Math.min(1, Math.max(-1, results[0].dot(results[1])))) * 180) / Math.PI;
      list.append(el("dt", {}, "Angle"), el("dd", { class: degrees > 5 ? "bad" : "good" }, Number.isFinite(degrees) ? `${degrees.toFixed(2)}° between the two shaded normals` : "not a number"));
    }
    replaceChildren(this.#body, list);
  }
}
