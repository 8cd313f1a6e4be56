// SPDX-License-Identifier: MIT
// Encodes the view in the page's address, so that a result can be linked to: look, finding, side, camera.
import { looks, type Look } from "./picture/shader.js";
import type { Stage } from "./views/stage.js";

export interface Linked {
  /** The file name of a sample. */
  sample?: string;
  look?: Look;
  /** Number of the finding, from 0. */
  finding?: number;
  /** Where the line between both sides is, 0 to 1. */
  split?: number;
  /** Place of the eye, and what it looks at. */
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

/** Each model lies in memory, so only some are kept; of others the address knows samples. */
const kMostVisited = 6, kMostVisitedBytes = 400 << 20;

/** Models of this visit by places of the browser's history, so that its Back and Forward go through them. */
export class Visited<Model> {
  constructor(private bytesOf: (model: Model) => number) {}

  #models = new Map<string, Model>();

  /** What this place of the history calls its model. */
  get #name(): string | undefined {
    return (history.state as { model?: string } | null)?.model;
  }

  /** What is shown at this place of the history, where that is known. */
  get current(): Model | undefined {
    return this.#models.get(this.#name ?? "");
  }

  /** Another model is shown. The first one has the place that the page has, and so has one whose address was typed. */
  add(model: Model): void {
    const state = { model: crypto.getRandomValues(new Uint32Array(4)).join() };
    if (this.#models.size === 0 || this.#name === undefined) history.replaceState(state, "");
    else history.pushState(state, "", "#");
    this.#models.set(state.model, model);
    const bytes = () => [...this.#models.values()].reduce((sum, one) => sum + this.bytesOf(one), 0);
    while (this.#models.size > 1 && (this.#models.size > kMostVisited || bytes() > kMostVisitedBytes)) this.#models.delete(this.#models.keys().next().value!);
  }

  /** Returns the memory of all models. */
  clear(): void {
    this.#models.clear();
  }
}

const short = (x: number): string => String(Number(x.toPrecision(5)));

/** Keeps the address in step with what is seen. */
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
