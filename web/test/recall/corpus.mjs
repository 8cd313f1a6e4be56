// SPDX-License-Identifier: MIT
// Writes twenty correct models, each with four kinds of damage, as files.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { addSecondSet, averageSeams, giveNormalMaps, invertSigns, readFirstSet } from "./damage.mjs";
import { Glb } from "../glb.mjs";

export const models = [
  "blender/01_cube/01_cube.gltf", "blender/01_sphere/01_sphere.gltf", "features/ShapeCollection.glb", "obj/spot.obj",
  "khronos/Fox.glb", "khronos/CesiumMan.glb", "khronos/NormalTangentTest.glb", "khronos/BoomBoxWithAxes.glb", "khronos/Lantern.glb",
  "khronos/Suzanne/Suzanne.gltf", "khronos/ClearCoatTest.glb", "khronos/FlightHelmet/FlightHelmet.gltf", "khronos/SciFiHelmet.glb",
  "assets/ycb_mustard_bottle.glb", "assets/Ghost.glb", "assets/sofa_03/sofa_03_1k.gltf", "assets/tea_set_01/tea_set_01_1k.gltf",
  "assets/hp-mixed-reality-left.glb", "assets/MaterialsVariantsShoe_draco.glb", "assets/ChessBoard_draco.glb",
];

/** Finding codes that identify each damage, including equivalent ones. */
export const damages = {
  signs: { named: ["signsInverted"], found: ["signsWrong"] },
  seams: { named: ["uvSeamAveraged", "mirroredSeamAveraged"], found: ["directionsWrong", "signsMixed", "signsWrong"] },
  uvSet: { named: ["uvSetWrong"], found: ["directionsWrong"] },
  green: { named: ["greenFlipped"], found: ["greenMixed"] },
};
export const codes = Object.values(damages).flatMap(({ named, found }) => [...named, ...found]);

/** Minimum share of triangles whose tangents averageSeams changes visibly; below it, seams are no kind of damage. */
const kLeastTouched = 0.01;

/**
 * Writes NAME-sound.glb and NAME-DAMAGE.glb of a model into a folder. NAME-sound.glb contains the file's tangents if check
 * has no finding, otherwise those of mikktspace. Returns the kinds of damage; models without UV seams have no averaged
 * seams.
 */
export function writeModel(tool, path, folder, name) {
  const file = (kind) => join(folder, `${name}-${kind}.glb`);
  const generate = (from, to, ...options) => execFileSync(tool, ["generate", file(from), "-o", file(to), "--quiet", ...options], { stdio: "ignore" });
  const change = (from, to, act) => {
    const glb = new Glb(readFileSync(file(from)));
    const result = act(glb);
    writeFileSync(file(to), glb.finish());
    return result;
  };
  execFileSync(tool, ["generate", path, "-o", file("plain"), "--quiet", ...(path.endsWith(".obj") ? [] : ["--compress", "none"])], { stdio: "ignore" });
  change("plain", "mapped", giveNormalMaps);
  generate("mapped", "complete", "--only-missing");
  generate("complete", "sound", isSound(tool, file("complete")) ? "--only-missing" : "--overwrite");
  change("sound", "signs", invertSigns);
  const hasSeams = change("sound", "seams", averageSeams) >= kLeastTouched;
  change("sound", "twoSets", addSecondSet);
  generate("twoSets", "second", "--overwrite");
  change("second", "uvSet", readFirstSet);
  generate("sound", "green", "--flip-green-all");
  return Object.keys(damages).filter((damage) => damage !== "seams" || hasSeams);
}

/** Codes of errors and warnings. */
export const codesOf = ({ findings }) => [...new Set(findings.filter(({ severity }) => severity !== "note").map(({ code }) => code))];

export function checkFile(tool, path, options = []) {
  let text;
  try {
    text = execFileSync(tool, ["check", "--json", ...options, path], { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });
  } catch (error) {
    text = error.stdout; // exit code 1: there are findings
  }
  return JSON.parse(text).files[0];
}

const isSound = (tool, path) => !codesOf(checkFile(tool, path)).some((code) => codes.includes(code) || code === "splitFramesDiffer");
