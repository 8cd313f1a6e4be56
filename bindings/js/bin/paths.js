// SPDX-License-Identifier: MIT
// Conversion of Windows paths. The tool uses POSIX file names: a drive (C:) or a share (\\server\share) is one
// component, which makes the path absolute at any position. Therefore C:/a and /D:/b/C:/a are both C:/a.

const isDrive = (part) => /^[A-Za-z]:$/.test(part);
const isShare = (part) => part.startsWith("\\\\");

/** Converts a command-line argument to the tool's separators: C:\a -> C:/a, \\server\share\a -> \\server\share/a. */
export function toolWord(word) {
  if (/^\\\\[?.]\\UNC\\/i.test(word)) return toolWord(`\\\\${word.slice(8)}`);
  const share = word.match(/^[\\/]{2}([^\\/?.][^\\/]*)[\\/]+([^\\/]+)(.*)$/);
  if (share) return `\\\\${share[1]}\\${share[2]}${share[3].replaceAll("\\", "/")}`;
  // \\?\C:\a and \\.\C:\a: paths that the system uses without normalization.
  return word.replace(/^\\\\[?.]\\/, "").replaceAll("\\", "/");
}

/** Converts an absolute system path to a tool path, which starts with a slash. */
export const toolPath = (path) => `/${toolWord(path)}`;

/** Converts a tool path to a system path. */
export function systemPath(path) {
  const parts = path.split("/");
  const at = Math.max(parts.findLastIndex(isDrive), parts.findLastIndex(isShare));
  if (at < 0) return path === "/dev/null" ? "\\\\.\\nul" : path;
  const below = parts.slice(at + 1).filter((part) => part !== "");
  return isDrive(parts[at]) ? `${parts[at]}\\${below.join("\\")}` : [parts[at], ...below].join("\\");
}
