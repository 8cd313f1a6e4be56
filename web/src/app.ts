// SPDX-License-Identifier: MIT
// Controls one model at a time: the order of requests to the worker, and the updates of the views. Results for a model
// that is no longer current are dropped.
import { Vector3 } from "three";
import { LoaderError, loadModel } from "./model/load.js";
import { imageOf, surfaceWith } from "./model/lone_map.js";
import { glbOfObj } from "./model/obj.js";
import type { Model } from "./model/model.js";
import type { Reports } from "./views/share.js";
import { triangleCount, type Part } from "./model/part.js";
import { isMapName, missingFiles, Refusal, type ModelFiles } from "./files.js";
import type { MotionView } from "./views/motion.js";
import type { PartsView } from "./views/parts.js";
import { Scene, type Drawn } from "./picture/scene.js";
import type { CheckReport, IdentifyReport, InspectReport } from "tspace/gltf";
import type { FindingsView } from "./views/findings.js";
import type { LookView } from "./views/look.js";
import type { PlaceView } from "./views/place.js";
import type { Progress } from "./views/progress.js";
import type { Stage } from "./views/stage.js";
import type { UvMapView } from "./views/uv_map.js";
import { WorkError, type Work } from "./worker/client.js";
import { isFile, nameOf, type Arrays, type Calls, type ConvertedMap, type MapReading, type MapTarget, type OtherFile, type Right } from "./worker/protocol.js";

export interface Views {
  stage: Stage;
  findings: FindingsView;
  look: LookView;
  uvMap: UvMapView;
  place: PlaceView;
  parts: PartsView;
  motion: MotionView;
  progress: Progress;
  /** Called with the current model (null: none), and the model that it was fixed from. */
  opened: (model: ModelFiles | null, before: ModelFiles | null) => void;
  /** Called with the names of the file's variants; empty: none. */
  offered: (variants: string[]) => void;
  checked: (report: CheckReport) => void;
  /** Called when everything is complete: the picture, the findings, and the origin of the tangents. */
  ready: () => void;
  inspected: (report: InspectReport) => void;
}

const sentenceOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));
/** Returns a sentence about referenced files that are missing. */
const lacking = (missing: string[]): string => `The model references files that were not dropped: ${missing.slice(0, 8).join(", ")}${missing.length > 8 ? ` and ${missing.length - 8} more` : ""}. Drop them together with the model.`;

/**
 * Returns whether an error is a fault of the page. Errors of the library, the loader, the page's own readers and the
 * browser's file access are about the file.
 */
const isPageFault = (error: unknown): boolean => !(error instanceof LoaderError || error instanceof Refusal || error instanceof DOMException || (error instanceof WorkError && error.code !== "internal"));

/** Returns a sentence about an error that says whether it is a fault of the page. */
function explain(error: unknown): string {
  if (isPageFault(error)) return `This page failed with an internal error (${String(error)}), which does not mean that the file is damaged.`;
  return error instanceof DOMException ? `This file cannot be read: ${sentenceOf(error)}` : sentenceOf(error);
}
/** Initial viewing direction for a lone normal map: almost perpendicular. */
const kMapDirection = new Vector3(0.2, 0.12, 1).normalize();
/** Worker number of the first part of a file to compare with. */
const kFirstOtherPart = 1_000_000;
const copyOf = (arrays: Arrays): Arrays => structuredClone(arrays);

export class App {
  model: ModelFiles | null = null;
  reports: Reports = {};
  /** The fixed file shown right of the split line, and its check report. */
  fixed: { model: ModelFiles; check: CheckReport | null } | null = null;
  /** Parts of the fixed file, or of the file to compare with. */
  #fixedParts: Part[] = [];
  #fixedFile: ModelFiles | null = null;
  #fixedScene: Scene | null = null;
  /** The fixed file has other normals or triangles, so it is drawn as a separate scene. */
  #hasOtherShape = false;
  /** The model from which the current one was fixed. */
  #before: ModelFiles | null = null;
  /** Normal map image of each material, and those images whose green points down according to `check`. */
  #normalImages: number[] = [];
  #greenDown = new Set<number>();
  /** Index of the shown variant, or -1. */
  #variant = -1;
  /** Remarks about loading the model. */
  #remarks: string[] = [];
  #generation = 0;

  constructor(readonly work: Work, private views: Views) {}

  /** Sets the state of the page, which tests and style sheets read. */
  #state(state: "loading" | "ready" | "failed" | "stopped" | "closed"): void {
    document.documentElement.dataset.state = state;
  }

  fail(message: string): void {
    this.work.forget();
    this.#leave("failed");
    this.views.findings.fail(message);
  }

  /** Closes the model and frees its memory: that of the page, the GPU and the worker, which is terminated. */
  close(): void {
    this.work.stop();
    this.#leave("closed");
    this.views.findings.wait("Open a model to see its findings.");
  }

  #leave(state: "failed" | "closed"): void {
    this.#generation += 1;
    this.model = this.#before = null;
    this.reports = {};
    this.#clear();
    this.views.progress.done("");
    this.views.opened(null, null);
    this.#state(state);
  }

  stop(): void {
    this.work.stop();
  }

  #clear(): void {
    const { stage, look, uvMap, place, parts, motion } = this.views;
    place.clear();
    this.fixed = null;
    this.#fixedParts = [];
    this.#fixedFile = null;
    this.#fixedScene?.dispose();
    this.#fixedScene = null;
    this.#normalImages = [];
    this.#greenDown.clear();
    this.#variant = -1;
    this.views.offered([]);
    stage.setGreen("none");
    stage.say("");
    look.offerFile(null);
    stage.nameFiles(null);
    stage.viewport.show(new Scene());
    look.showLines();
    look.showFigures();
    uvMap.reset();
    parts.describe(null);
    parts.reset();
    motion.reset(null);
  }

  /** Opens the fixed file as the model; back() returns to the original. */
  openFixed(fixed: ModelFiles): Promise<void> {
    return this.open(async () => fixed, { before: this.model });
  }

  /** Returns to the model that the current one was fixed from; returns false if there is none. */
  back(): boolean {
    const before = this.#before;
    if (before) void this.open(async () => before);
    return before !== null;
  }

  /**
   * Opens a model. `before`: the model that it was fixed from. `read`: the model if the loader has already read it;
   * then the picture appears before the figures.
   */
  async open(choose: () => Promise<ModelFiles>, { before = null, read }: { before?: ModelFiles | null; read?: Promise<Model> } = {}): Promise<void> {
    const generation = ++this.#generation;
    const isCurrent = () => generation === this.#generation;
    const { findings, progress, opened } = this.views;
    this.work.forget();
    this.#state("loading");
    delete document.documentElement.dataset.picture;
    this.reports = {};
    findings.wait("Reading…");
    let missing: string[] = [];
    progress.at("Reading the file", 0);
    try {
      const chosen = await choose();
      if (!isCurrent()) return;
      missing = missingFiles(chosen);
      const isObj = /\.obj$/i.test(chosen.name), isMap = isMapName(chosen.name);
      const model = isObj ? glbOfObj(chosen) : isMap && !chosen.loneMap ? await this.#onSurface(chosen) : chosen;
      if (!isCurrent()) return;
      this.model = model;
      this.#before = before;
      this.#clear();
      opened(model, before);
      if (!read) await this.#inspect(model, isCurrent);
      if (!isCurrent()) return;
      this.#remarks = isObj ? ["OBJ files are converted to GLB, which is what you see and what is checked."] : isMap ? ["The normal map is shown on a flat surface. Drag the light."] : [];
      if (missing.length > 0) this.#remarks.push(lacking(missing));
      await this.#draw(model, isCurrent, { read });
      if (!isCurrent()) return;
      if (read) await this.#inspect(model, isCurrent);
      await this.#judge(model, isCurrent);
    } catch (error) {
      if (!isCurrent()) return;
      if (error instanceof WorkError && error.code === "stopped") return this.#stopped();
      const sentence = explain(error);
      this.fail(missing.length > 0 ? `${lacking(missing)} (${sentence})` : sentence);
    }
  }

  /** Returns a surface that shows a normal map, with the result of `check` for the image. */
  async #onSurface({ name, bytes }: ModelFiles): Promise<ModelFiles> {
    const { report, image } = await this.work.run("image", { model: { name, bytes, others: new Map() } });
    return { name, bytes: surfaceWith(name, image), others: new Map(), loneMap: { file: bytes, check: report as CheckReport } };
  }

  async #inspect(model: ModelFiles, isCurrent: () => boolean): Promise<void> {
    const report = await this.work.run("report", { verb: "inspect", model });
    if (!isCurrent()) return;
    this.reports.inspect = report;
    this.views.inspected(report as InspectReport);
    this.views.parts.describe(report as InspectReport);
  }

  #stopped(): void {
    this.views.progress.done("Stopped.");
    if (!this.reports.check) this.views.findings.wait("Stopped before the check was complete.");
    this.#state("stopped");
  }

  get variant(): number {
    return this.#variant;
  }

  /**
   * Shows another variant of the file, or none, from the same viewpoint. The findings are unchanged, because they are
   * about the file.
   */
  async setVariant(variant: number): Promise<void> {
    const { model } = this, { progress, look, place } = this.views;
    if (!model || variant === this.#variant) return;
    const generation = this.#generation, isCurrent = () => generation === this.#generation && this.#variant === variant;
    this.#variant = variant;
    try {
      place.clear();
      await this.#draw(model, isCurrent, { isOther: true });
      if (!isCurrent()) return;
      if (this.#fixedFile) await this.#loadFixed(this.#fixedFile, isCurrent);
      await this.compare(look.right, 0.3, 1);
      if (isCurrent()) progress.done("");
    } catch (error) {
      if (isCurrent()) progress.done(sentenceOf(error));
    }
  }

  /** Draws the model. If that fails, a sentence replaces the picture; the findings are still shown. */
  async #draw(model: ModelFiles, isCurrent: () => boolean, { isOther = false, read }: { isOther?: boolean; read?: Promise<Model> } = {}): Promise<void> {
    const { stage, progress } = this.views;
    progress.at("Drawing", 0.1);
    try {
      const { parts, tree, motion, normalImages, variants, remarks: own } = await (read ?? loadModel(model, this.work, this.#variant));
      const remarks = [...this.#remarks, ...own];
      if (!isCurrent()) return;
      this.#normalImages = normalImages;
      const scene = new Scene();
      for (const [i, part] of parts.entries()) {
        if (triangleCount(part.arrays) === 0) continue;
        const corners = await this.work.run("corners", { part: i, arrays: copyOf(part.arrays) }).catch((error: WorkError) => {
          if (error.code === "stopped") throw error;
          remarks.push(`A part of the model cannot be drawn: ${error.message}.`);
          return null;
        });
        if (!isCurrent()) return;
        if (corners) scene.add(i, part, corners);
        progress.at("Drawing", 0.1 + (0.2 * (i + 1)) / parts.length);
      }
      if (!stage.viewport.hasPicture) remarks.unshift("This browser does not support WebGL, so there is no picture. Findings and fixes still work.");
      stage.viewport.show(scene);
      if (!isOther) {
        stage.viewport.setHome(model.loneMap && kMapDirection);
        stage.viewport.reset(true);
        this.views.offered(variants);
      }
      this.views.uvMap.reset();
      this.views.parts.reset(tree);
      this.views.motion.reset(motion);
      this.views.look.showLines();
      if (scene.drawn.length === 0) remarks.push("This file contains nothing that can be drawn.");
      stage.say(remarks.join(" "));
      document.documentElement.dataset.picture = !stage.viewport.hasPicture ? "none" : scene.drawn.length > 0 ? "drawn" : "empty";
    } catch (error) {
      if (!isCurrent() || (error instanceof WorkError && error.code === "stopped")) throw error;
      document.documentElement.dataset.picture = "failed";
      stage.say(`There is no picture. ${explain(error)} The findings do not depend on the picture.`);
    }
  }

  async #judge(model: ModelFiles, isCurrent: () => boolean): Promise<void> {
    const { findings, progress, look } = this.views;
    await this.compare(look.right, 0.3, 0.6);
    if (!isCurrent()) return;
    progress.at("Checking", 0.6);
    const check = (this.reports.check = model.loneMap?.check ?? ((await this.work.run("report", { verb: "check", model })) as CheckReport));
    if (!isCurrent()) return;
    findings.show(check);
    this.views.checked(check);
    this.#turnGreen(check);
    if (!model.loneMap) {
      progress.at("Comparing the tangents with those of known methods", 0.8);
      this.reports.identify = await this.work.run("report", { verb: "identify", model });
      if (!isCurrent()) return;
    }
    findings.showVerdict(model.loneMap ? "A normal map has no tangents." : (this.reports.identify as IdentifyReport).verdict);
    progress.done("");
    this.#state("ready");
    this.views.ready();
  }

  /**
   * Collects the normal maps whose green points down; right of the split line their green is inverted, to show the
   * correct result.
   */
  #turnGreen({ findings, image }: CheckReport): void {
    if (image?.green === "down") this.#greenDown.add(this.#normalImages[0]);
    for (const { code, place } of findings) {
      const material = code === "greenFlipped" ? /^\/materials\/(\d+)\/normalTexture$/.exec(place)?.[1] : undefined;
      if (material !== undefined) this.#greenDown.add(this.#normalImages[Number(material)] ?? -1);
    }
    this.#greenDown.delete(-1);
    this.#showGreen();
  }

  #showGreen(): void {
    const { stage, look } = this.views, { scene } = stage.viewport;
    for (const drawn of scene.drawn) scene.turnGreen(drawn, !isFile(look.right) && this.#greenDown.has(drawn.part.normalImage));
    const withMap = scene.drawn.filter(({ rightMap }) => rightMap !== null);
    const turned = withMap.filter(({ turnsGreen }) => turnsGreen).length;
    stage.setGreen(turned === 0 ? "none" : turned < withMap.length ? "some" : "all");
  }

  /** Returns the check report of a fixed file, or null if it cannot be checked. */
  async checkFixed(model: ModelFiles): Promise<CheckReport | null> {
    const { progress } = this.views;
    progress.at("Checking the fixed file", 0.8);
    try {
      if (!isMapName(model.name)) return (await this.work.run("report", { verb: "check", model })) as CheckReport;
      return (await this.work.run("image", { model: { ...model, bytes: imageOf(model.bytes) } })).report as CheckReport;
    } catch {
      return null;
    } finally {
      progress.done("");
    }
  }

  /** Converts a lone normal map to another format. */
  convertMap({ name, loneMap }: ModelFiles, reading: MapReading, to: MapTarget): Promise<ConvertedMap> {
    if (!loneMap) throw new Error("There is no normal map.");
    return this.work.run("convertMap", { name, file: loneMap.file, reading, to });
  }

  async generate(model: ModelFiles, options: Record<string, unknown>): Promise<{ report: unknown; bytes: Uint8Array<ArrayBuffer> }> {
    const { progress } = this.views;
    progress.at("Fixing", 0.5);
    try {
      return await this.work.run("generate", { model, options });
    } finally {
      progress.done("");
    }
  }

  /**
   * Shows the fixed file right of the split line: its frames and normal maps, and also its normals and triangles if
   * they differ.
   */
  async showFixed(model: ModelFiles, hasOtherShape: boolean, as: OtherFile = "mended"): Promise<void> {
    const generation = this.#generation, isCurrent = () => generation === this.#generation;
    this.#hasOtherShape = hasOtherShape;
    if (!(await this.#loadFixed(model, isCurrent))) return;
    this.#fixedFile = model;
    this.views.look.offerFile(as);
    await this.setRight(as);
  }

  /**
   * Shows another version of the model right of the split line, with the same camera. Returns its check report, or null
   * if another model was opened meanwhile.
   */
  async compareWith(choose: () => Promise<ModelFiles>): Promise<{ name: string; check: CheckReport } | null> {
    const generation = this.#generation, chosen = await choose(), isObj = /\.obj$/i.test(chosen.name);
    const other = isObj ? glbOfObj(chosen) : isMapName(chosen.name) ? await this.#onSurface(chosen) : chosen;
    const check = other.loneMap?.check ?? ((await this.work.run("report", { verb: "check", model: other })) as CheckReport);
    if (generation !== this.#generation || !this.model) return null;
    const names = [this.model.name, other.name] as const;
    await this.showFixed(other, true, "other");
    this.views.stage.nameFiles(names[0] === names[1] ? [`${names[0]} (first)`, `${names[1]} (second)`] : names);
    return { name: other.name, check };
  }

  async #loadFixed(model: ModelFiles, isCurrent: () => boolean): Promise<boolean> {
    const { parts, motion } = await loadModel(model, this.work, this.#variant);
    // Animated models are not drawn as a separate scene, which would have to move too.
    const scene = this.#hasOtherShape && !motion ? new Scene() : null;
    for (const [i, part] of scene ? parts.entries() : []) {
      if (triangleCount(part.arrays) > 0) scene!.add(kFirstOtherPart + i, part, await this.work.run("corners", { part: null, arrays: copyOf(part.arrays) }));
    }
    if (!isCurrent()) return false;
    this.#fixedParts = parts;
    this.#fixedScene?.dispose();
    this.#fixedScene = scene;
    return true;
  }

  /** Computes the frames for the right side and for the error. */
  async setRight(right: Right): Promise<void> {
    const generation = this.#generation;
    try {
      await this.compare(right, 0, 1);
      if (generation === this.#generation) this.views.progress.done("");
    } catch (error) {
      if (generation === this.#generation) this.views.progress.done(sentenceOf(error));
    }
  }

  async compare(right: Right, from: number, to: number): Promise<void> {
    const { stage, progress, look, uvMap } = this.views;
    const { scene } = stage.viewport;
    for (const [i, drawn] of scene.drawn.entries()) {
      progress.at(isFile(right) ? `Reading ${nameOf(right)}` : `Computing frames by ${nameOf(right)}`, from + ((to - from) * i) / scene.drawn.length);
      const fixed = isFile(right) ? this.#fixedParts.find(({ mesh, primitive }) => mesh === drawn.part.mesh && primitive === drawn.part.primitive) : undefined;
      const frames = await this.#frames(drawn, right, fixed);
      if (scene !== stage.viewport.scene || look.right !== right) return;
      scene.setRight(drawn, frames, (fixed ?? drawn.part).normalMap, !isFile(right));
      stage.viewport.ask();
    }
    if (right === "other" && this.#fixedScene && !(await this.#compareBack(this.#fixedScene, scene))) return;
    stage.viewport.showRight(isFile(right) ? this.#fixedScene : null);
    this.#showGreen();
    look.showFigures();
    look.showLines();
    void uvMap.draw();
  }

  /**
   * Compares the other file with this one, so that the picture of the other file shows the error too. Returns false if
   * another model was opened meanwhile.
   */
  async #compareBack(other: Scene, scene: Scene): Promise<boolean> {
    for (const drawn of other.drawn) {
      const part = scene.find(drawn.part.mesh, drawn.part.primitive)?.part, frames = part ? await this.#frames(drawn, "other", part) : null;
      if (scene !== this.views.stage.viewport.scene || other !== this.#fixedScene) return false;
      other.setRight(drawn, frames, part?.normalMap ?? drawn.part.normalMap, false);
    }
    return true;
  }

  /**
   * Returns the frames of a part for the right side, or null if there are none. After the worker was terminated, sends
   * the part again.
   */
  async #frames(drawn: Drawn, right: Right, fixed: Part | undefined): Promise<Calls["otherFrames"]["answer"]> {
    const ask = () =>
      !isFile(right) ? this.work.run("frames", { part: drawn.number, method: right })
      : fixed ? this.work.run("otherFrames", { part: drawn.number, arrays: copyOf(fixed.arrays) })
      : null;
    try {
      return await ask();
    } catch (error) {
      if (!(error instanceof WorkError)) throw error;
      if (error.code === "stopped") throw error;
      if (error.code !== "unknownPart") return null;
      await this.work.run("corners", { part: drawn.number, arrays: copyOf(drawn.part.arrays) });
      return ask();
    }
  }
}
