// SPDX-License-Identifier: MIT
// renderModels: opens page.html, which renders models with three.js, and returns its results.
import path from "node:path";
import { fileURLToPath } from "node:url";
import { openPage } from "./open_page.mjs";

const page_folder = path.dirname(fileURLToPath(import.meta.url));

/// Renders models. `models`: name -> path of a GLB. Returns { by: renderer, pixels: name -> side -> bytes, pictures:
/// name -> side -> PNG }.
export async function renderModels({ chromium, three_folder, models, timeout_ms }) {
    const result = { pixels: {}, pictures: {} };
    /// Addresses below /page and /three are files. /models/NAME is the file models[NAME].
    const answer = ([area, ...rest]) => {
        if (area === "list") return { json: Object.keys(models) };
        if (area === "models") return { file: models[rest.join("/")] };
        const folder = { page: page_folder, three: three_folder }[area];
        return folder && { file: path.join(folder, ...rest) };
    };
    const received = ([what, name, side], bytes) => {
        ({ pixels: result.pixels, picture: result.pictures }[what][name] ??= {})[side] = bytes;
    };
    result.by = await openPage({ chromium, page: "/page/page.html", answer, received, timeout_ms });
    return result;
}
