// SPDX-License-Identifier: MIT
// The lesson: nine figures and a picture, created when the library is loaded.

import { ready } from "tspace";
import { showAcross } from "./across";
import { showAverage } from "./average";
import { showHero } from "./hero";
import { showLight } from "./light";
import { showMethods } from "./methods";
import { showMirror } from "./mirror";
import { showScale } from "./scaled";
import { showRelief } from "./relief";
import { showSeam } from "./seam";
import { showTriangle } from "./triangle";

function find<Type extends Element>(selector: string, type: new () => Type): Type {
  const found = document.querySelector(selector);
  if (!(found instanceof type)) throw new Error(`the page has no ${selector}`);
  return found;
}

const figure = (name: string) => find(`#${name} .drawing`, HTMLElement);
const numbers = (name: string) => find(`#${name} .numbers`, HTMLElement);

try {
  showHero(find("#hero canvas", HTMLCanvasElement), find("#hero input", HTMLInputElement), find("#hero .said", HTMLElement));
  await ready;
  showRelief(figure("relief"), numbers("relief"), find("#down", HTMLInputElement));
  showTriangle(figure("triangle"), numbers("triangle"), find("#triangle .system", HTMLElement));
  showAverage(figure("average"), numbers("average"));
  showAcross(figure("across"), numbers("across"), find("#unit", HTMLInputElement));
  showMirror(figure("mirror"), numbers("mirror"), find("#dropped", HTMLInputElement));
  showSeam(figure("seam"), numbers("seam"), find("#shared", HTMLInputElement));
  showLight(figure("light"), numbers("light"), find("#light canvas", HTMLCanvasElement), find("#light .system", HTMLElement));
  showMethods(figure("methods"), find("#methods tbody", HTMLTableSectionElement), find("#surface", HTMLSelectElement), find("#methods .said-of-surface", HTMLElement));
  showScale(figure("scaled"), numbers("scaled"));
  document.documentElement.dataset["state"] = "ready";
} catch (error) {
  const line = find("#trouble", HTMLElement);
  line.hidden = false;
  line.textContent = `The figures cannot be shown: ${error instanceof Error ? error.message : String(error)}`;
}
