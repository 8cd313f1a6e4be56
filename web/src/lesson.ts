// SPDX-License-Identifier: MIT
// Links to the lesson, which is next to the page: maps findings to the figures that explain them.
import { el } from "./dom.js";
import { pageOrigin } from "./embedded.js";

/** Sections of learn.html, by prefix of the finding's code. */
const sections: readonly (readonly [RegExp, string])[] = [
  [/^signs/, "mirror"],
  [/^(uvSeam|mirroredSeam|splitFrames)/, "seam"],
  [/^(directions|uvSet|textureTransform|uvsDegenerate)/, "triangle"],
  [/^(green|normalMap)/, "relief"],
  [/^tangentsNotOrthogonal/, "average"],
  [/^tangentsNotUnit/, "across"],
  [/^tangents/, "relief"],
];

/** Returns whether the lesson is next to the page. Pages created by the tool may be anywhere, without the lesson. */
const isBeside = (): boolean => pageOrigin() === null;

export const lessonLink = (): HTMLElement | false => isBeside() && el("a", { class: "lesson", href: "learn.html", title: "A lesson with interactive figures" }, "Tangents explained");

/** Returns a link to the figure that explains a kind of finding. */
export function figureLink(code: string): HTMLElement | false {
  const section = sections.find(([pattern]) => pattern.test(code))?.[1];
  return isBeside() && section !== undefined && el("a", { class: "lesson", href: `learn.html#${section}` }, "Open the lesson");
}
