// SPDX-License-Identifier: MIT
// Converts a lone normal map with one click: green up or down, three channels or two, PNG, KTX2 or DDS.
import { count, disabledDuring, el, replaceChildren } from "../dom.js";
import { mapReading } from "./advice.js";
import type { ModelFiles } from "../files.js";
import type { ConvertedMap, MapReading, MapTarget } from "../worker/protocol.js";

interface Target {
  name: string;
  detail: string;
  /** Appended to the name of the map, before the extension. */
  suffix: string;
  green: "up" | "down";
  to: MapTarget;
}

const targets: readonly Target[] = [
  { name: "PNG, green up", detail: "glTF, OpenGL, Blender, Unity", suffix: "gltf", green: "up", to: "png" },
  { name: "PNG, green down", detail: "DirectX, Unreal", suffix: "directx", green: "down", to: "png" },
  { name: "KTX2, two channels", detail: "BC5 for desktop, green up", suffix: "gltf", green: "up", to: "bc5.ktx2" },
  { name: "KTX2 for mobile", detail: "EAC, two channels, green up", suffix: "gltf-eac", green: "up", to: "eac-rg11.ktx2" },
  { name: "DDS, green up", detail: "BC5, two channels", suffix: "gltf", green: "up", to: "bc5.dds" },
  { name: "DDS, green down", detail: "BC5, two channels, DirectX", suffix: "directx", green: "down", to: "bc5.dds" },
];

type Convert = (model: ModelFiles, reading: MapReading, to: MapTarget) => Promise<ConvertedMap>;

export class ConvertView {
  readonly element = el("details", { class: "panel convert", hidden: true }, el("summary", {}, "Convert this map"));
  #said = el("p", { class: "quiet", role: "status" });
  #rows = el("div", { class: "rows" });
  #url = "";

  constructor(private convert: Convert) {
    this.element.append(this.#rows);
  }

  /** Offers conversions of a lone normal map; hidden for models. */
  show(model: ModelFiles | null): void {
    const check = model?.loneMap?.check;
    this.element.hidden = !check;
    this.element.open = check !== undefined;
    this.#forget();
    replaceChildren(this.#said);
    if (!model || !check) return;
    const found = mapReading(check), isKnown = check.image?.green === "up" || check.image?.green === "down";
    if (!found) return replaceChildren(this.#rows, el("p", { class: "quiet" }, "This image is not a normal map in tangent space, or converting it needs a mesh. The finding names the command that converts it."));
    const buttons: HTMLButtonElement[] = targets.map((target) => el("button", { type: "button", class: "target", onclick: () => void disabledDuring(buttons, () => this.#make(model, found.reading, target)) }, el("strong", {}, target.name), el("span", {}, target.detail)));
    replaceChildren(this.#rows, !found.isSure && el("p", { class: "quiet" }, "The relief fits two interpretations of the map. The finding names both; these files use the first one."), !isKnown && el("p", { class: "quiet" }, "The relief does not show in which direction green points, so the map is read with green up."), el("div", { class: "targets" }, ...buttons), this.#said);
  }

  #forget(): void {
    if (this.#url) URL.revokeObjectURL(this.#url);
    this.#url = "";
  }

  async #make(model: ModelFiles, reading: MapReading, { suffix, green, to }: Target): Promise<void> {
    const flipGreen = (reading.flipGreen ?? false) !== (green === "down");
    this.#said.textContent = "Converting…";
    try {
      const { bytes, width, height, format, notes } = await this.convert(model, { ...reading, flipGreen }, to);
      const name = `${model.name.replace(/^.*\//, "").replace(/\.[^.]*$/, "")}-${suffix}.${to.split(".").pop()}`;
      this.#forget();
      this.#url = URL.createObjectURL(new Blob([bytes], { type: to === "png" ? "image/png" : "application/octet-stream" }));
      const link = el("a", { href: this.#url, download: name }, name);
      replaceChildren(this.#said, link, `: ${width} x ${height}, ${format}, ${count(bytes.length)} bytes. ${notes.join(" ")}`);
      link.click();
    } catch (error) {
      this.#said.textContent = `The map cannot be converted: ${error instanceof Error ? error.message : String(error)}`;
    }
  }
}
