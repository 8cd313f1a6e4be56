// SPDX-License-Identifier: MIT
// Meaning of the tangent sign, encoded in bits for the modules.
import { choice, fail, object } from "./check.js";

const directx = { vAxis: "down", green: "down", handedness: "left", winding: "clockwise" };

/** Presets, keyed by the name of a format or an engine. */
export const conventions = Object.freeze({
  gltf: { vAxis: "down" },
  opengl: { vAxis: "up" },
  directx,
  unreal: { ...directx, winding: "counterClockwise" },
  unity: { vAxis: "up", handedness: "left", winding: "clockwise" },
  blender: { vAxis: "up" },
  godot: { vAxis: "down", winding: "clockwise" },
});

const names = Object.keys(conventions);
const parts = ["vAxis", "green", "storedSign", "handedness", "winding"];
const bit = (value, name, list) => (value === undefined ? 0 : choice(value, `convention.${name}`, list));

/** Returns the bits for a preset name, or for an object that specifies each part. */
export function conventionBits(value) {
  if (value === undefined || value === null)
    fail("invalidOption", `convention is missing; it must be the target of the tangents, "gltf" or one of ${names.slice(1).join(", ")}`);
  const chosen = typeof value === "object" ? object(value, "convention", parts) : conventions[names[choice(value, "convention", names)]];
  return (
    (choice(chosen.vAxis, "convention.vAxis", ["up", "down"]) + 1) |
    (bit(chosen.green, "green", ["up", "down"]) << 2) |
    (bit(chosen.storedSign, "storedSign", ["asIs", "negated"]) << 3) |
    (bit(chosen.handedness, "handedness", ["right", "left"]) << 4) |
    (bit(chosen.winding, "winding", ["counterClockwise", "clockwise"]) << 5)
  );
}
