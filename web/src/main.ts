// SPDX-License-Identifier: MIT
// The page: assembles its parts, and handles all ways to open a model.
import "./style.css";
import { App } from "./app.js";
import { el, filePicker, replaceChildren } from "./dom.js";
import { chooseModel, droppedFiles, mapType, modelsIn, pickedFiles, Pile, type ModelFiles, type Named } from "./files.js";
import { embeddedModel, pageOrigin } from "./embedded.js";
import { lessonLink } from "./lesson.js";
import { keepLink, linkedBy, Visited } from "./link.js";
import { pageWith } from "./one_page.js";
import { forgetModel, keepModel, keptModel } from "./own_store.js";
import { askedModel, askFirst, filesAt } from "./asked.js";
import { samples, type Sample } from "./samples.js";
import { loadModel } from "./model/load.js";
import { imageOf, surfaceWith } from "./model/lone_map.js";
import { mapReading, planFor, worstOf, type Plan } from "./views/advice.js";
import { ConvertView } from "./views/convert.js";
import { FindingsView } from "./views/findings.js";
import { FixView } from "./views/fix.js";
import { GalleryView } from "./views/gallery.js";
import { LookView } from "./views/look.js";
import { changesShape, FixOptionsView, fixedName, type FixedModel } from "./views/fix_options.js";
import { MotionView } from "./views/motion.js";
import { PartsView } from "./views/parts.js";
import { PlaceView } from "./views/place.js";
import { Progress } from "./views/progress.js";
import { pictureFile, reportAs, ShareView } from "./views/share.js";
import { Stage } from "./views/stage.js";
import { TexelView } from "./views/texel.js";
import { UvMapView } from "./views/uv_map.js";
import { Work } from "./worker/client.js";
import type { CheckReport, GenerateReport } from "tspace/gltf";

// The worker reads and compiles the library while WebGL starts, which blocks this thread longer than anything else.
// Until the worker runs, this thread reads the page's own sample, which needs no check.
const work = new Work();
const own = embeddedModel(), asked = own ? null : askedModel(), first = linkedBy(location.hash || (pageOrigin()?.shown ?? ""));
const sampleNamed = (name: string | undefined): Sample | undefined => samples.find(({ file }) => file === name);
const kept = own || asked || first.sample ? null : await keptModel();
const firstSample = own || kept ? null : (sampleNamed(first.sample) ?? samples[0]);
const firstFiles = firstSample && filesOf(firstSample);
const firstRead = firstFiles && loadModel(firstFiles, work);
firstRead?.catch(() => {}); // reported when the model is drawn
await work.started;
const largeMap = el("section", { class: "large-map", "aria-label": "UV map", hidden: true });
let plan: Plan | null = null;
const fix = new FixView(() => plan && void fixOptions.run(plan.tangents));
const stage = new Stage(fix.caption, fix.element, largeMap);
const place = new PlaceView(stage.viewport, (look) => stage.setLook(look), (share) => stage.setSplit(share));
const findings = new FindingsView({
  choose: (chosen, isOne) => (stage.canvas.dataset.outlined = String(place.show(chosen, isOne, app.fixed !== null))),
  addToFix: (finding) => fixOptions.prepare(finding),
});
const progress = new Progress(() => app.stop());
const look = new LookView(stage, (right) => void app.setRight(right), (variant) => void app.setVariant(variant));
const uvMap = new UvMapView(stage.viewport, work, largeMap);
const convert = new ConvertView((model, reading, to) => app.convertMap(model, reading, to));
const parts = new PartsView(stage.viewport, pageOrigin()), motion = new MotionView(stage.viewport);
const texel = new TexelView(stage.viewport, (spot) => uvMap.point(spot));
const title = el("p", { class: "model-name" });
const back = el("button", { type: "button", class: "back", hidden: true, title: "Key: Backspace", onclick: () => app.back() });
const close = el("button", { type: "button", class: "close", hidden: true, "aria-label": "Close the model", title: "Close the model and free its memory", onclick: closeModel }, "×");
const fixOptions = new FixOptionsView(
  async (options): Promise<FixedModel> => {
    const { model } = app;
    if (!model) throw new Error("No model is open.");
    const { name, report, bytes } = (await convertedMap(model)) ?? { name: fixedName(model.name), ...(await app.generate(model, options)) };
    const fixed = { name, bytes, others: model.others };
    const checked = await app.checkFixed(fixed), download = model.loneMap && { bytes: imageOf(bytes), type: mapType(name) };
    void app.showFixed(fixed, changesShape(report as GenerateReport)).catch((error: Error) => stage.say(`The fixed file cannot be drawn: ${error.message}`));
    return { report, checked, download, ...fixed, ...(download && checked && { loneMap: { file: download.bytes, check: checked } }) };
  },
  ({ name, bytes, others, loneMap }) => void app.openFixed({ name, bytes, others, loneMap }),
  { started: () => fix.working(), failed: (message) => fix.failed(message), done: showFixed },
);
const app: App = new App(work, {
  stage, findings, look, uvMap, place, parts, motion, progress, opened: showName, offered: (variants) => look.offerVariants(variants), checked, ready: followLink,
  inspected: ({ primitives }) => fixOptions.setCompressed(primitives.some(({ compression }) => compression !== "none")),
});

/**
 * Converts a lone normal map with other channels than glTF's to a PNG with glTF's channels; null if no conversion is
 * needed.
 */
async function convertedMap(model: ModelFiles): Promise<{ name: string; report: unknown; bytes: Uint8Array<ArrayBuffer> } | null> {
  const reading = model.loneMap && mapReading(model.loneMap.check)?.reading;
  if (!reading || !(reading.channels || reading.curve)) return null;
  const name = fixedName(model.name).replace(/\.[^.]*$/, ".png"), { bytes, notes } = await app.convertMap(model, reading, "png");
  const map = { image: 0, name: model.name, flipped: reading.flipGreen, mended: true, reason: "its channels were not those of glTF" };
  return { name, bytes: surfaceWith(name, bytes), report: { changed: true, inputBytes: model.loneMap!.file.length, outputBytes: bytes.length, primitives: [], normalMaps: [map], warnings: notes } };
}

const share = new ShareView({
  report: (kind) => (app.fixed?.check ? reportAs(kind, app.fixed.model.name, { check: app.fixed.check }) : reportAs(kind, app.model?.name ?? "no model is open", app.reports)),
  picture: async () => {
    const name = app.model?.name ?? "model", blob = await pictureFile(stage.viewport, name, stage.sides, stage.swatches);
    return blob && { blob, name: `${name.replace(/^.*\//, "").replace(/\.[^.]*$/, "")}-${stage.viewport.settings.look}.png` };
  },
  page: async () => app.model && { blob: await pageWith(app.model, location.hash), name: `${app.model.name.replace(/^.*\//, "").replace(/\.[^.]*$/, "")}.html` },
  link: () => location.href,
});

function checked(report: CheckReport): void {
  fixOptions.advise(report);
  plan = planFor(report);
  fix.offer(report, plan);
  convert.show(app.model);
}

/** Shows a fixed file right of the split line. The list, the look and the counts are then about the fixed file. */
function showFixed({ name, bytes, others, checked: after }: FixedModel, url: string, isChanged: boolean): void {
  const before = app.reports.check as CheckReport | undefined;
  if (!before) return fix.wait();
  if (!isChanged) return fix.offer(before, null);
  app.fixed = { model: { name, bytes, others }, check: after };
  plan = after && planFor(after);
  fix.done(name, url, before.counts, after?.counts ?? null, plan?.tangents === "overwrite" ? plan : null);
  place.clear();
  if (after) findings.show(after, true);
  if (!app.model?.loneMap) findings.showVerdict("tspace, in the fixed file.");
  stage.setLook("lit");
}

/** View of the first model, from the address; afterwards the address follows the view. */
let linked = asked ? {} : first;
const keep = keepLink(stage, () => findings.chosen, () => (pile.isEmpty && app.model !== own ? (app.model?.name ?? null) : null));
stage.viewport.onDrawn = () => document.documentElement.dataset.state === "ready" && keep();
function followLink(): void {
  const { look: wanted, finding, split, camera } = linked as typeof first, { check } = app.reports as { check?: CheckReport };
  linked = {};
  // The first view shows the worst finding.
  const worst = check && worstOf(check);
  const isDrawn = document.documentElement.dataset.picture === "drawn";
  // Without colors the relief of the samples stands out, and with it their faults. A fixed file is shown like its model.
  if (back.hidden) look.suggestColors(!(worst && sampleNamed(app.model?.name)));
  if (worst && isDrawn && finding === undefined && split === undefined && !camera) place.aim(check!.findings.filter(({ code }) => code === worst.code));
  if (finding !== undefined) findings.openFinding(finding);
  if (wanted) stage.setLook(wanted);
  if (split !== undefined) stage.setSplit(split);
  if (camera) stage.viewport.lookFrom(camera);
}

/** Models that were shown, the model that each was fixed from, and the files that were opened with it. */
const visited = new Visited<{ model: ModelFiles; before: ModelFiles | null; pile: Pile }>(({ model }) => model.bytes.length);
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
  fixOptions.reset(model);
  convert.show(null);
  plan = null;
  fix.wait();
  texel.reset();
  replaceChildren(title, model ? model.name : "");
  close.hidden = model === null;
  if (before === null && document.activeElement === back) close.focus(); // the button disappears
  back.hidden = before === null;
  back.textContent = before ? `Back to ${before.name}` : "";
  document.title = model ? `${model.name} – tspace view` : "tspace view";
  gallery.mark(model?.name ?? null);
}

/** Removes the model, and all earlier models, from memory. */
function closeModel(): void {
  visited.clear();
  pile = new Pile();
  others.hidden = true;
  app.close();
  header.querySelector<HTMLElement>(".open button")?.focus();
}

let pile = new Pile();
/** Choice of the model, if several were opened together. */
const others = el("select", { class: "models", "aria-label": "Models that were opened together", hidden: true });

/** Opens dropped or chosen files; later files may belong to the current model. */
function openFiles(dropped: Promise<Named[]> | Named[]): void {
  void app.open(async () => {
    const files = await pile.add(await dropped), models = modelsIn(files);
    others.hidden = models.length < 2;
    replaceChildren(others, ...models.map((path) => el("option", { value: path }, path)));
    others.onchange = () => void app.open(() => chooseModel(files, others.value));
    const chosen = await chooseModel(files), { name } = chosen;
    // The functions here share one scope, which `others` keeps: none of them uses `chosen`, so that its bytes can be freed.
    if (!asked) void keepModel(chosen).then((isKept) => showKept(isKept ? name : null));
    return chosen;
  });
}

/** Shows another version of the model right of the split line. */
async function compare(dropped: Named[]): Promise<void> {
  try {
    const before = app.reports.check as CheckReport | undefined, other = await app.compareWith(async () => chooseModel(await new Pile().add(dropped)));
    if (!other || !before || !app.model) return;
    plan = null;
    fix.compare([app.model.name, other.name], [before.counts, other.check.counts]);
    place.clear();
  } catch (error) {
    stage.say(`The other file cannot be compared: ${error instanceof Error ? error.message : String(error)}`);
  } finally {
    progress.done("");
  }
}

const picker = (text: string, properties: Record<string, unknown>, take: (files: Named[]) => void = openFiles): HTMLElement =>
  filePicker(text, { multiple: true, ...properties }, (files) => take(pickedFiles(files)));

function filesOf({ file, bytes }: Sample): ModelFiles {
  return { name: file, bytes: bytes(), others: new Map() };
}

function openSample(sample: Sample): void {
  pile = new Pile();
  others.hidden = true;
  void app.open(async () => filesOf(sample));
}

const gallery = new GalleryView(openSample);

const header = el("header", { class: "bar" },
  el("p", { class: "brand" }, "tspace ", el("span", {}, "view")),
  el("h1", {}, "Drop a model to see where its bumps look like dents, and fix it. ", el("span", {}, asked ? `Nothing is uploaded; the page only downloads from ${asked.host}.` : "Nothing is uploaded.")),
  el("div", { class: "open" }, picker("Open model…", { accept: ".glb,.vrm,.gltf,.obj,.zip,.bin,.mtl,image/*,.ktx2,.dds", "aria-label": "Open model" }), picker("Folder…", { webkitdirectory: true, "aria-label": "Open folder" }),
    picker("Compare with…", { accept: ".glb,.vrm,.gltf,.obj,.zip,.bin,.mtl,image/*,.ktx2,.dds", "aria-label": "Compare with another version" }, (files) => void compare(files))),
  others, title, close, back);
const inspector = el("aside", { class: "inspector", "aria-label": "Inspector" }, convert.element, look.element, texel.element, uvMap.element, motion.element, parts.element, fixOptions.element, share.element);
const main = el("main", {}, gallery.element, findings.element, stage.element, inspector);
const keptLine = el("p", { class: "kept row" });
const footer = el("footer", {}, progress.element, keptLine, el("span", { class: "quiet" }, "Drop a .glb, .vrm, .obj or .zip, a folder with a .gltf, or a normal map (PNG, JPEG, WebP, KTX2, DDS) anywhere on the page."), lessonLink() || null);
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
  // Entries of a drop are only accessible now, so they are read before the first await.
  if (dataTransfer) {
    openFiles(droppedFiles(dataTransfer));
  }
});

/** Shows below the page that a model is stored in the browser, with a button that deletes it. */
function showKept(name: string | null): void {
  replaceChildren(keptLine, name && el("span", { class: "quiet" }, `${name} is kept in this browser for the next visit.`), name && el("button", { type: "button", class: "small", onclick: () => void forgetModel().then(() => showKept(null)) }, "Remove it"));
}

if (own) void app.open(async () => own);
else if (kept) void app.open(async () => kept).then(() => showKept(kept.name));
else if (firstFiles && firstRead) void app.open(async () => firstFiles, { read: firstRead });

/** For tests, and for use in the browser's console. */
Object.assign(window, { tspaceView: app });
