// SPDX-License-Identifier: MIT
// Paths of Windows, as the tool sees them. Its file names are those of POSIX: a drive (C:) or a share (\\server\share) is one
// component, from which all that follows begins anew, wherever it stands. So C:/a and /D:/b/C:/a are both C:/a.

const isDrive = (part) => /^[A-Za-z]:$/.test(part);
const isShare = (part) => part.startsWith("\\\\");

/** A word of the command line, with the tool's separators: C:\a -> C:/a, \\server\share\a -> \\server\share/a. */
export function toolWord(word) {
  if (/^\\\\[?.]\\UNC\\/i.test(word)) return toolWord(`\\\\${word.slice(8)}`);
  const share = word.match(/^[\\/]{2}([^\\/?.][^\\/]*)[\\/]+([^\\/]+)(.*)$/);
  if (share) return `\\\\${share[1]}\\${share[2]}${share[3].replaceAll("\\", "/")}`;
  // \\?\C:\a and \\.\C:\a: paths that the system takes as they are.
  return word.replace(/^\\\\[?.]\\/, "").replaceAll("\\", "/");
}

/** An absolute path of the system as the tool's, which begins with a slash. */
export const toolPath = (path) => `/${toolWord(path)}`;

/** The tool's path as one of the system. */
export function systemPath(path) {
  const parts = path.split("/");
  const at = Math.max(parts.findLastIndex(isDrive), parts.findLastIndex(isShare));
  if (at < 0) return path === "/dev/null" ? "\\\\.\\nul" : path;
  const below = parts.slice(at + 1).filter((part) => part !== "");
  return isDrive(parts[at]) ? `${parts[at]}\\${below.join("\\")}` : [parts[at], ...below].join("\\");
}
