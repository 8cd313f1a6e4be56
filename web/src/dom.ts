// SPDX-License-Identifier: MIT
// Creates elements without markup: data from a model becomes a text node or an attribute, never HTML.

type Child = Node | string | null | undefined | false;
type Properties = Record<string, unknown>;

/** Creates an element: `el("button", { class: "plain", onclick: f, "aria-pressed": "true" }, "Text")` */
export function el<K extends keyof HTMLElementTagNameMap>(tag: K, properties: Properties = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value as EventListener);
    else if (name === "class") element.className = String(value);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  append(element, ...children);
  return element;
}

export function append(element: Element, ...children: Child[]): void {
  for (const child of children) if (child) element.append(child);
}

export function replaceChildren(element: Element, ...children: Child[]): void {
  element.replaceChildren(...children.filter((child): child is Node | string => Boolean(child)));
}

/** Creates radio buttons that look like one control. */
export function choice<T extends string>(label: string, options: readonly (readonly [T, string])[], chosen: T, changed: (value: T) => void) {
  const name = `choice-${++choices}`;
  const inputs = new Map<T, HTMLInputElement>();
  const group = el("fieldset", { class: "choice" }, el("legend", {}, label));
  for (const [value, text] of options) {
    const input = el("input", { type: "radio", name, value, onchange: () => changed(value) });
    input.checked = value === chosen;
    inputs.set(value, input);
    group.append(el("label", {}, input, el("span", {}, text)));
  }
  /** Null: nothing is chosen. */
  const set = (value: T | null): void => inputs.forEach((input, own) => (input.checked = own === value));
  return { element: group, set };
}
let choices = 0;

export function checkbox(text: string, checked: boolean, changed: (on: boolean) => void) {
  const input = el("input", { type: "checkbox", onchange: () => changed(input.checked) }) as HTMLInputElement;
  input.checked = checked;
  return { element: el("label", { class: "check" }, input, el("span", {}, text)), input };
}

export function select<T extends string>(label: string, options: readonly (readonly [T, string])[], chosen: T, changed: (value: T) => void) {
  const input = el("select", { onchange: () => changed(input.value as T) }) as HTMLSelectElement;
  for (const [value, text] of options) input.append(el("option", { value }, text));
  input.value = chosen;
  return { element: el("label", { class: "select" }, el("span", {}, label), input), input };
}

/** Creates a slider with its value next to it. */
export function slider(label: string, { min, max, step, value, unit }: { min: number; max: number; step: number; value: number; unit: string }, changed: (value: number) => void): HTMLElement {
  const input = el("input", { type: "range", min, max, step, value }), text = el("span", { class: "number" }, `${value}${unit}`);
  input.addEventListener("input", () => {
    text.textContent = `${input.value}${unit}`;
    changed(Number(input.value));
  });
  return el("label", { class: "select slider" }, el("span", {}, label), input, text);
}

/** Disables buttons until work has ended. Disabling takes the focus from a button, which gets it back afterwards. */
export async function disabledDuring(buttons: readonly HTMLButtonElement[], work: () => Promise<void>): Promise<void> {
  const focused = buttons.find((button) => button === document.activeElement);
  for (const button of buttons) button.disabled = true;
  try {
    await work();
  } finally {
    for (const button of buttons) button.disabled = false;
    if (document.activeElement === document.body) focused?.focus();
  }
}

/** Formats a number as `1,234` regardless of the browser's language, because reports are in English. */
export const count = (n: number): string => n.toLocaleString("en");

export const plural = (n: number, one: string): string => `${count(n)} ${one}${n === 1 ? "" : "s"}`;

/** Returns a button that opens the file dialog. */
export function filePicker(text: string, properties: Properties, take: (files: File[]) => void): HTMLElement {
  const input = el("input", { type: "file", tabindex: "-1", ...properties });
  input.addEventListener("change", () => {
    const files = [...(input.files ?? [])];
    input.value = "";
    if (files.length > 0) take(files);
  });
  return el("span", { class: "picker" }, input, el("button", { type: "button", onclick: () => input.click() }, text));
}
