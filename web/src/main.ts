// SPDX-License-Identifier: MIT
// The page: its parts put together, and the ways a model comes in.
import "./style.css";
import { App } from "./app.js";
import { el, replaceChildren } from "./dom.js";
import { chooseModel, droppedFiles, modelsIn, pickedFiles, Pile, type ModelFiles, type Named } from "./files.js";
import { embeddedModel, pageOrigin } from "./embedded.js";
import { lessonLink } from "./lesson.js";
import { keepLink, linkedBy, Visited } from "./link.js";
import { askedModel, askFirst, filesAt } from "./asked.js";
import { faults, samples, type Sample } from "./samples.js";
import { loadModel } from "./model/load.js";
import { FindingsView } from "./views/findings.js";
import { LookView } from "./views/look.js";
import { changesShape, MendView, mendedName, type Mended } from "./views/mend.js";
import { MotionView } from "./views/motion.js";
import { PartsView } from "./views/parts.js";
import { PlaceView } from "./views/place.js";
import { Progress } from "./views/progress.js";
import { pictureFile, reportAs, ShareView } from "./views/share.js";
import { Stage } from "./views/stage.js";
import { TexelView } from "./views/texel.js";
import { UvMapView } from "./views/uv_map.js";
import { Work } from "./worker/client.js";
import type { GenerateReport } from "tspace/gltf";

// The library is read and compiled by the worker while WebGL starts, which holds this thread up for longer than all else. Until
// the worker runs, this thread reads the page's own sample: nobody has to say first whether that is sound.
const work = new Work();
const own = embeddedModel(), asked = own ? null : askedModel(), first = linkedBy(location.hash);
const sampleNamed = (name: string | undefined): Sample | undefined => [...samples, ...faults].find(({ file }) => file === name);
const firstSample = own ? null : (sampleNamed(first.sample) ?? samples[0]);
const firstFiles = firstSample && filesOf(firstSample);
const firstRead = firstFiles && loadModel(firstFiles, work);
firstRead?.catch(() => {}); // said where it would be drawn
await work.started;
const largeMap = el("section", { class: "large-map", "aria-label": "UV map", hidden: true });
const stage = new Stage(largeMap);
const place = new PlaceView(stage.viewport, (look) => stage.setLook(look));
const findings = new FindingsView({
  choose: (chosen, isOne) => (stage.canvas.dataset.outlined = String(place.show(chosen, isOne))),
  mend: (finding) => mend.prepare(finding),
});
const progress = new Progress(() => app.stop());
const look = new LookView(stage, (right) => void app.setRight(right), (variant) => void app.setVariant(variant));
const uvMap = new UvMapView(stage.viewport, work, largeMap);
const parts = new PartsView(stage.viewport, pageOrigin()), motion = new MotionView(stage.viewport);
const texel = new TexelView(stage.viewport, (spot) => uvMap.point(spot));
const title = el("p", { class: "model-name" });
const back = el("button", { type: "button", class: "back", hidden: true, title: "Key: Backspace", onclick: () => app.back() });
const mend = new MendView(
  async (options): Promise<Mended> => {
    const { model } = app;
    if (!model) throw new Error("There is no model.");
    const { report, bytes } = await app.generate(model, options);
    const mended = { name: mendedName(model.name), bytes, others: model.others };
    const checked = await app.checkMended(mended);
    void app.showMended(mended, changesShape(report as GenerateReport)).catch((error: Error) => stage.say(`The mended file cannot be drawn: ${error.message}`));
    return { report, checked, ...mended };
  },
  ({ name, bytes, others }) => void app.openMended({ name, bytes, others }),
);
const app: App = new App(work, {
  stage, findings, look, uvMap, place, parts, motion, progress, opened: showName, offered: (variants) => look.offerVariants(variants), checked: (report) => mend.advise(report), ready: followLink,
  inspected: ({ primitives }) => mend.setCompressed(primitives.some(({ compression }) => compression !== "none")),
});

const share = new ShareView({
  report: (kind) => reportAs(kind, app.model?.name ?? "no model", app.reports),
  picture: async () => {
    const name = app.model?.name ?? "model", blob = await pictureFile(stage.viewport, name, stage.sides);
    return blob && { blob, name: `${name.replace(/^.*\//, "").replace(/\.[^.]*$/, "")}-${stage.viewport.settings.look}.png` };
  },
});

/** The first model is shown as the address says; from then on the address says what is shown. */
let linked = asked ? {} : first;
const keep = keepLink(stage, () => findings.chosen, () => (pile.isEmpty && app.model !== own ? (app.model?.name ?? null) : null));
stage.viewport.onDrawn = () => document.documentElement.dataset.state === "ready" && keep();
function followLink(): void {
  const { look, finding, split, camera } = linked as typeof first;
  linked = {};
  if (finding !== undefined) findings.openFinding(finding);
  if (look) stage.setLook(look);
  if (split !== undefined) stage.setSplit(split);
  if (camera) stage.viewport.lookFrom(camera);
}

/** Models that were shown, what each was mended from, and the files that came with it. */
const visited = new Visited<{ model: ModelFiles; before: ModelFiles | null; pile: Pile }>();
addEventListener("popstate", () => {
  linked = linkedBy(location.hash);
  const { current } = visited, sample = current ? undefined : sampleNamed(linked.sample);
  if (current && current.model !== app.model) {
    pile = current.pile;
    others.hidden = true;
    void app.open(async () => current.model, { before: current.before });
  } else if (sample && sample.file !== app.model?.name) openSample(sample);
  else followLink();
});

function showName(model: ModelFiles | null, before: ModelFiles | null): void {
  if (model && visited.current?.model !== model) visited.add({ model, before, pile });
  mend.reset(model);
  texel.reset();
  replaceChildren(title, model ? model.name : "");
  back.hidden = before === null;
  back.textContent = before ? `Back to ${before.name}` : "";
  document.title = model ? `${model.name} – tspace view` : "tspace view";
  for (const button of sampleButtons) button.setAttribute("aria-pressed", String(model !== null && button.dataset.file === model.name));
  // Two faults may be of one file, so what was chosen stays where it still fits.
  if (gallery.value !== "" && faults[Number(gallery.value)].file !== model?.name) gallery.value = "";
}

let pile = new Pile();
/** Where several models came together: which of them. */
const others = el("select", { class: "models", "aria-label": "Models that came together", hidden: true });

/** Opens what was dropped or chosen; later files may belong to the model that is there. */
function openFiles(dropped: Promise<Named[]> | Named[]): void {
  void app.open(async () => {
    const files = await pile.add(await dropped), models = modelsIn(files);
    others.hidden = models.length < 2;
    replaceChildren(others, ...models.map((path) => el("option", { value: path }, path)));
    others.onchange = () => void app.open(() => chooseModel(files, others.value));
    return chooseModel(files);
  });
}

function picker(text: string, properties: Record<string, unknown>): HTMLElement {
  const input = el("input", { type: "file", multiple: true, tabindex: "-1", ...properties }) as HTMLInputElement;
  input.addEventListener("change", () => {
    const files = input.files ? pickedFiles(input.files) : [];
    input.value = "";
    if (files.length > 0) openFiles(files);
  });
  return el("span", { class: "picker" }, input, el("button", { type: "button", onclick: () => input.click() }, text));
}

function filesOf({ file, bytes }: Sample): ModelFiles {
  return { name: file, bytes: bytes(), others: new Map() };
}

function openSample(sample: Sample): void {
  pile = new Pile();
  others.hidden = true;
  void app.open(async () => filesOf(sample));
}

const sampleButtons = samples.map((sample) =>
  el("button", { type: "button", class: "sample", "data-file": sample.file, title: sample.hint, "aria-pressed": "false", onclick: () => openSample(sample) }, sample.name));

const gallery = el("select", { class: "faults", "aria-label": "Faults of real files" }, el("option", { value: "" }, "Faults…"),
  ...faults.map(({ name, hint }, i) => el("option", { value: i, title: hint }, name)));
gallery.addEventListener("change", () => {
  if (gallery.value === "") return;
  openSample(faults[Number(gallery.value)]);
});

const header = el("header", { class: "bar" },
  el("h1", {}, "tspace ", el("span", {}, "view")),
  el("div", { class: "open" }, picker("Open model…", { accept: ".glb,.vrm,.gltf,.obj,.zip,.bin,.mtl,image/*", "aria-label": "Open model" }), picker("Folder…", { webkitdirectory: true, "aria-label": "Open folder" })),
  el("nav", { class: "samples", "aria-label": "Samples" }, el("span", { class: "quiet" }, "Samples"), ...sampleButtons, gallery),
  lessonLink() || null, others, title, back);
const inspector = el("aside", { class: "inspector", "aria-label": "Inspector" }, look.element, texel.element, uvMap.element, motion.element, parts.element, mend.element, share.element);
const main = el("main", {}, findings.element, stage.element, inspector);
const footer = el("footer", {}, progress.element, el("span", { class: "quiet" }, `Drop a .glb, a .zip, a folder with a .gltf, or an .obj anywhere. ${asked ? `Nothing but a request to ${asked.host} can leave this computer.` : "Nothing leaves this computer."}`));
const question = asked && askFirst(asked, () => {
  linked = first;
  openFiles(filesAt(asked));
});
document.body.append(header, ...(question ? [question] : []), main, footer);

addEventListener("keydown", (event) => {
  const isText = event.target instanceof HTMLInputElement && event.target.type === "text";
  if (event.key === "Backspace" && !isText && app.back()) event.preventDefault();
});

for (const type of ["dragenter", "dragover"]) {
  addEventListener(type, (event) => {
    event.preventDefault();
    document.body.classList.add("dropping");
  });
}
addEventListener("dragleave", (event) => event.relatedTarget === null && document.body.classList.remove("dropping"));
addEventListener("drop", (event) => {
  event.preventDefault();
  document.body.classList.remove("dropping");
  const { dataTransfer } = event;
  // Entries of a drop can be asked for only now, so the first await comes after that.
  if (dataTransfer) {
    openFiles(droppedFiles(dataTransfer));
  }
});

if (own) void app.open(async () => own);
else if (firstFiles && firstRead) void app.open(async () => firstFiles, { read: firstRead });

/** For tests, and for those who look with the browser's console. */
Object.assign(window, { tspaceView: app });
