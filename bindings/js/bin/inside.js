// SPDX-License-Identifier: MIT
// Which files may be touched, where only those in some folders may: all of `tspace mcp`, and the programs that it starts.
import { lstatSync, realpathSync } from "node:fs";
import { basename, dirname, isAbsolute, join, parse, relative, resolve, sep } from "node:path";

/** The name of the variable that gives these folders to a program, as JSON; without it every file may be touched. */
export const onlyInside = "TSPACE_ONLY_INSIDE";

/**
 * Where a path leads once links are followed. What is not there yet has its real folder and its own name. Throws for links that lead
 * nowhere, and for `..`: behind a link the system means the parent of what it points at.
 */
export function realPlace(path) {
  if (path.split(/[\\/]/).includes("..") || path.includes("\0")) throw new Error("a path with ..");
  const missing = [];
  for (let place = resolve(path); ; place = dirname(place)) {
    try {
      return join(realpathSync(place), ...missing);
    } catch (error) {
      if (error.code !== "ENOENT" || place === parse(place).root) throw error;
    }
    if (lstatSync(place, { throwIfNoEntry: false })) throw new Error("a link that leads nowhere");
    missing.unshift(basename(place));
  }
}

/** Whether a real path is a folder, or lies in it. */
export function isIn(folder, path) {
  const way = relative(folder, path);
  return way !== ".." && !way.startsWith(`..${sep}`) && !isAbsolute(way);
}

const folders = JSON.parse(process.env[onlyInside] ?? "null");
const devices = ["/dev/null", "/proc/sys/vm/overcommit_memory"];

/** The path as it was given (bytes, or text), where it may be opened, made or removed. */
export function allowed(path) {
  if (!folders) return path;
  const text = path.toString();
  if (devices.includes(text)) return path;
  try {
    // Bytes that are no text would be looked up under another name.
    if ((typeof path === "string" || Buffer.from(text).equals(path)) && folders.some((folder) => isIn(folder, realPlace(text)))) return path;
  } catch {
    // It cannot be followed.
  }
  throw Object.assign(new Error(`${text} is outside`), { code: "EACCES" });
}
