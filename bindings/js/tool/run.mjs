// SPDX-License-Identifier: MIT
// Runs a program of this build that generates source files: node run.mjs PROGRAM.wasm WORD... (CMake's
// CMAKE_CROSSCOMPILING_EMULATOR).
import { spawnSync } from "node:child_process";
import { copyFileSync, cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const [program, ...words] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "tspace-run-"));
try {
  cpSync(fileURLToPath(new URL("../bin", import.meta.url)), folder, { recursive: true });
  copyFileSync(program, join(folder, "tspace.wasm"));
  writeFileSync(join(folder, "package.json"), '{ "type": "module" }\n');
  process.exitCode = spawnSync(process.execPath, [join(folder, "tspace.js"), ...words], { stdio: "inherit" }).status ?? 1;
} finally {
  rmSync(folder, { recursive: true });
}
