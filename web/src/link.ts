// SPDX-License-Identifier: MIT
// Encodes the view in the page's address, so that a result can be linked to: look, finding, side, camera.
import { looks, type Look } from "./picture/shader.js";
import type { Stage } from "./views/stage.js";

export interface Linked {
  /** File name of a sample. */
  sample?: string;
  look?: Look;
  /** Index of the finding, from 0. */
  finding?: number;
  /** Position of the split line, 0 to 1. */
  split?: number;
  /** Positions of the camera and of its target. */
  camera?: number[];
}

export function linkedBy(hash: string): Linked {
  const values = new URLSearchParams(hash.replace(/^#/, "")), linked: Linked = {};
  const look = values.get("look") as Look | null, numbers = (values.get("camera") ?? "").split(",").map(Number);
  const sample = values.get("sample");
  if (sample) linked.sample = sample;
  if (look && looks.includes(look)) linked.look = look;
  const finding = Number(values.get("finding") ?? NaN), split = Number(values.get("split") ?? NaN);
  if (Number.isInteger(finding) && finding >= 0) linked.finding = finding;
  if (split >= 0 && split <= 1) linked.split = split;
  if (numbers.length === 6 && numbers.every(Number.isFinite)) linked.camera = numbers;
  return linked;
}

/** Models need memory, so only a few are kept. For others, the address can only restore samples. */
const kMostVisited = 6, kMostVisitedBytes = 400 << 20;

/** Models of this visit by entry of the browser's history, so that Back and Forward switch between them. */
export class Visited<Model> {
  constructor(private bytesOf: (model: Model) => number) {}

  #models = new Map<string, Model>();

  /** Key of the current history entry's model. */
  get #name(): string | undefined {
    return (history.state as { model?: string } | null)?.model;
  }

  /** The model of the current history entry, if it is still in memory. */
  get current(): Model | undefined {
    return this.#models.get(this.#name ?? "");
  }

  /**
   * Adds the model that is shown now. The first model, and a model whose address was typed, use the current history
   * entry.
   */
  add(model: Model): void {
    const state = { model: crypto.getRandomValues(new Uint32Array(4)).join() };
    if (this.#models.size === 0 || this.#name === undefined) history.replaceState(state, "");
    else history.pushState(state, "", "#");
    this.#models.set(state.model, model);
    const bytes = () => [...this.#models.values()].reduce((sum, one) => sum + this.bytesOf(one), 0);
    while (this.#models.size > 1 && (this.#models.size > kMostVisited || bytes() > kMostVisitedBytes)) this.#models.delete(this.#models.keys().next().value!);
  }

  /** Frees all models. */
  clear(): void {
    this.#models.clear();
  }
}

const short = (x: number): string => String(Number(x.toPrecision(5)));

/** Updates the address when the view changes. */
export function keepLink(stage: Stage, finding: () => number | null, sample: () => string | null): () => void {
  let timer = 0;
  const { viewport } = stage;
  const write = () => {
    const { look, split } = viewport.settings, chosen = finding();
    const name = sample();
    const parts = [...(name ? [`sample=${encodeURIComponent(name)}`] : []), `look=${look}`, `split=${short(split)}`, `camera=${[...viewport.camera.position.toArray(), ...viewport.target.toArray()].map(short).join(",")}`];
    if (chosen !== null) parts.push(`finding=${chosen}`);
    history.replaceState(history.state, "", `#${parts.join("&")}`);
  };
  // Browsers limit how often the address may change.
  return () => {
    clearTimeout(timer);
    timer = window.setTimeout(write, 400);
  };
}
