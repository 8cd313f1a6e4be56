// SPDX-License-Identifier: MIT
// A figure: a drawing that is redrawn on every change, and handles that a mouse, a finger or the arrow keys move.

import type { Vec2 } from "./vector";

const kSvg = "http://www.w3.org/2000/svg";

export function element<Name extends keyof SVGElementTagNameMap>(name: Name, attributes: Record<string, string | number> = {}) {
  const made = document.createElementNS(kSvg, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}

/** A part of the drawing with separate coordinates: x to the right, y up. */
export interface Plane {
  /** Position of (0, 0) in the drawing. */
  origin: Vec2;
  /** Number of pixels per unit. */
  unit: number;
}

const clamp = (value: number, [low, high]: Vec2) => Math.min(high, Math.max(low, value));

export class Figure {
  readonly svg: SVGSVGElement;
  private readonly drawing = element("g");
  private readonly handles = element("g", { class: "handles" });
  private readonly movers: (() => void)[] = [];
  private draw = () => {};

  constructor(host: HTMLElement, width: number, height: number, label: string) {
    this.svg = element("svg", { viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": label });
    this.svg.append(this.drawing, this.handles);
    host.append(this.svg);
  }

  /** Calls `draw` now, and after each move of a handle. */
  show(draw: () => void) {
    this.draw = draw;
    this.redraw();
  }

  redraw() {
    this.drawing.replaceChildren();
    this.draw();
    for (const move of this.movers) move();
  }

  /** Converts coordinates of a plane to those of the drawing. */
  static at(plane: Plane, [x, y]: Vec2): Vec2 {
    return [plane.origin[0] + plane.unit * x, plane.origin[1] - plane.unit * y];
  }

  add<Name extends keyof SVGElementTagNameMap>(name: Name, attributes: Record<string, string | number>, words?: string) {
    const made = element(name, attributes);
    if (words !== undefined) made.textContent = words;
    this.drawing.append(made);
    return made;
  }

  polygon(plane: Plane, points: readonly Vec2[], name: string) {
    return this.add("polygon", { class: name, points: points.map((p) => Figure.at(plane, p).join(",")).join(" ") });
  }

  line(plane: Plane, from: Vec2, to: Vec2, name: string) {
    const [a, b] = [Figure.at(plane, from), Figure.at(plane, to)];
    return this.add("line", { class: name, x1: a[0], y1: a[1], x2: b[0], y2: b[1] });
  }

  /** Draws an arrow; nothing if its length is zero. The head is a path, so that it is also printed. */
  arrow(plane: Plane, from: Vec2, step: Vec2, name: string, word = "") {
    const a = Figure.at(plane, from), b = Figure.at(plane, [from[0] + step[0], from[1] + step[1]]);
    const size = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (!(size > 1)) return;
    const x = (b[0] - a[0]) / size, y = (b[1] - a[1]) / size;
    this.add("line", { class: `arrow ${name}`, x1: a[0], y1: a[1], x2: b[0] - 6 * x, y2: b[1] - 6 * y });
    const head = [b, [b[0] - 10 * x - 4 * y, b[1] - 10 * y + 4 * x], [b[0] - 10 * x + 4 * y, b[1] - 10 * y - 4 * x]];
    this.add("polygon", { class: `head ${name}`, points: head.map((p) => p.join(",")).join(" ") });
    if (word) this.add("text", { class: `word ${name}`, x: b[0] + 20 * x, y: b[1] + 20 * y + 5, "text-anchor": "middle" }, word);
  }

  word(plane: Plane, at: Vec2, words: string, name = "") {
    const [x, y] = Figure.at(plane, at);
    return this.add("text", { class: `word ${name}`, x, y, "text-anchor": "middle" }, words);
  }

  /** Adds a movable point. `get` and `set` use the coordinates of the plane; `set` receives positions inside the bounds only. */
  handle(plane: Plane, label: string, get: () => Vec2, set: (to: Vec2) => void, bounds: readonly [Vec2, Vec2], name = "") {
    const knob = element("circle", { class: `handle ${name}`, r: 9, tabindex: 0, role: "slider", "aria-label": label });
    const moveTo = (x: number, y: number) => {
      set([clamp(x, bounds[0]), clamp(y, bounds[1])]);
      this.redraw();
    };
    knob.addEventListener("pointerdown", (event) => {
      knob.setPointerCapture(event.pointerId);
      event.preventDefault();
      knob.focus();
    });
    knob.addEventListener("pointermove", (event) => {
      const matrix = this.svg.getScreenCTM();
      if (!knob.hasPointerCapture(event.pointerId) || !matrix) return;
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
      moveTo((at.x - plane.origin[0]) / plane.unit, (plane.origin[1] - at.y) / plane.unit);
    });
    knob.addEventListener("keydown", (event) => {
      const step = event.shiftKey ? 0.1 : 0.02;
      const moves: Record<string, Vec2> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
      const move = moves[event.key];
      if (!move) return;
      event.preventDefault();
      const [x, y] = get();
      moveTo(x + move[0], y + move[1]);
    });
    this.handles.append(knob);
    this.movers.push(() => {
      const [x, y] = Figure.at(plane, get());
      knob.setAttribute("cx", String(x));
      knob.setAttribute("cy", String(y));
      const value = get().map((v) => v.toFixed(2)).join(", ");
      knob.setAttribute("aria-valuetext", value);
      knob.setAttribute("aria-valuenow", get()[0].toFixed(2));
    });
  }
}

/** A line of numbers below a figure, with fixed and variable text. */
export class Numbers {
  private readonly rows = new Map<string, HTMLElement>();

  constructor(private readonly host: HTMLElement) {}

  set(name: string, value: string) {
    let row = this.rows.get(name);
    if (!row) {
      const line = document.createElement("div");
      const head = document.createElement("dt");
      row = document.createElement("dd");
      head.textContent = name;
      line.append(head, row);
      this.host.append(line);
      this.rows.set(name, row);
    }
    row.textContent = value;
  }
}

/** A matrix in brackets: editable fields if `set` is given, otherwise text. */
export class Matrix {
  readonly element = document.createElement("span");
  private readonly cells: HTMLElement[][];

  constructor(rows: number, columns: number, label: string, private readonly set?: (row: number, column: number, value: number) => void) {
    this.element.className = "matrix numbers-in";
    this.element.style.gridTemplateColumns = `repeat(${columns}, auto)`;
    this.element.setAttribute("role", "group");
    this.element.setAttribute("aria-label", label);
    this.cells = Array.from({ length: rows }, (_, row) => Array.from({ length: columns }, (_, column) => this.cell(row, column, label)));
    this.element.append(...this.cells.flat());
  }

  private cell(row: number, column: number, label: string): HTMLElement {
    if (!this.set) return document.createElement("span");
    const field = document.createElement("input");
    field.type = "number";
    field.step = "0.05";
    field.setAttribute("aria-label", `${label}: row ${row + 1}, column ${column + 1}`);
    field.addEventListener("input", () => Number.isFinite(field.valueAsNumber) && this.set!(row, column, field.valueAsNumber));
    return field;
  }

  /** A field that is being edited keeps the typed text. */
  show(values: readonly (readonly number[])[], say: (value: number) => string) {
    this.cells.forEach((row, i) => row.forEach((cell, k) => {
      const value = values[i]![k]!;
      if (!(cell instanceof HTMLInputElement)) cell.textContent = say(value);
      else if (document.activeElement !== cell) cell.value = value.toFixed(2);
    }));
  }
}
