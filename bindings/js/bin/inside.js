// SPDX-License-Identifier: MIT
// Restricts file access to certain folders, for `tspace mcp` and the programs that it starts.
import { lstatSync, realpathSync } from "node:fs";
import { basename, dirname, isAbsolute, join, parse, relative, resolve, sep } from "node:path";

/**
 * Name of the environment variable that passes these folders to a program, as JSON; without it every file may be
 * accessed.
 */
export const onlyInside = "TSPACE_ONLY_INSIDE";

/**
 * Resolves links in a path. A file that does not exist yet is resolved by its real folder and its own name. Throws for
 * links with a missing target, and for `..`: after a link the system resolves it relative to the link's target.
 */
export function realPlace(path) {
  if (path.split(/[\\/]/).includes("..") || path.includes("\0")) throw new Error("a path with '..'");
  const missing = [];
  for (let place = resolve(path); ; place = dirname(place)) {
    try {
      return join(realpathSync(place), ...missing);
    } catch (error) {
      if (error.code !== "ENOENT" || place === parse(place).root) throw error;
    }
    if (lstatSync(place, { throwIfNoEntry: false })) throw new Error("a dangling symbolic link");
    missing.unshift(basename(place));
  }
}

/** Returns whether a real path is a folder, or inside it. */
export function isIn(folder, path) {
  const way = relative(folder, path);
  return way !== ".." && !way.startsWith(`..${sep}`) && !isAbsolute(way);
}

const folders = JSON.parse(process.env[onlyInside] ?? "null");
const devices = ["/dev/null", "/proc/sys/vm/overcommit_memory"];

/** Returns the given path (bytes or text) if it may be opened, created or removed; otherwise throws. */
export function allowed(path) {
  if (!folders) return path;
  const text = path.toString();
  if (devices.includes(text)) return path;
  try {
    // Bytes that are not valid text are rejected, because `text` then names a different file.
    if ((typeof path === "string" || Buffer.from(text).equals(path)) && folders.some((folder) => isIn(folder, realPlace(text)))) return path;
  } catch {
    // The path cannot be resolved.
  }
  throw Object.assign(new Error(`${text} is outside`), { code: "EACCES" });
}
