// SPDX-License-Identifier: MIT
// Windows paths in the package's program, whose C library supports only POSIX paths. The functions work on text, so
// they are tested on every system.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { posix } from "node:path";
import { fileURLToPath } from "node:url";
import { describe, it } from "node:test";

const file = new URL("../node_modules/tspace/bin/paths.js", import.meta.url);
const skip = !existsSync(fileURLToPath(file)) && "the package has no program";
const { systemPath, toolPath, toolWord } = skip ? {} : await import(file);

describe("paths of Windows", { skip }, () => {
  /** Returns the system path for a command-line path in a current folder, after the tool has made it absolute. */
  const absolute = (folder, word) => systemPath(posix.normalize(posix.join(toolPath(folder), toolWord(word))));

  it("keep a drive letter, with either separator", () => {
    for (const word of ["C:\\models\\chair.glb", "C:/models/chair.glb"]) {
      assert.equal(toolWord(word), "C:/models/chair.glb");
      assert.equal(systemPath(toolWord(word)), "C:\\models\\chair.glb");
    }
    assert.equal(systemPath("c:/a"), "c:\\a");
    assert.equal(systemPath("C:/"), "C:\\");
  });

  it("keep a share", () => {
    for (const word of ["\\\\server\\share\\models\\chair.glb", "//server/share/models/chair.glb"]) {
      assert.equal(toolWord(word), "\\\\server\\share/models/chair.glb");
      assert.equal(systemPath(toolWord(word)), "\\\\server\\share\\models\\chair.glb");
    }
    assert.equal(systemPath(toolWord("\\\\server\\share")), "\\\\server\\share");
  });

  it("are kept if they begin with \\\\?\\ or \\\\.\\", () => {
    assert.equal(systemPath(toolWord("\\\\?\\C:\\models\\chair.glb")), "C:\\models\\chair.glb");
    assert.equal(systemPath(toolWord("\\\\.\\C:\\chair.glb")), "C:\\chair.glb");
    assert.equal(systemPath(toolWord("\\\\?\\UNC\\server\\share\\a.glb")), "\\\\server\\share\\a.glb");
  });

  it("stay relative", () => {
    assert.equal(toolWord("models\\chair.glb"), "models/chair.glb");
    assert.equal(systemPath("../models/chair.glb"), "../models/chair.glb");
    assert.equal(toolWord("*.glb"), "*.glb");
    assert.equal(toolWord("--output=out\\a.glb"), "--output=out/a.glb");
  });

  it("become absolute in a folder of a drive or a share", () => {
    assert.equal(toolPath("D:\\work"), "/D:/work");
    assert.equal(absolute("D:\\work", "models\\a.glb"), "D:\\work\\models\\a.glb");
    assert.equal(absolute("D:\\work\\deep", "..\\a.glb"), "D:\\work\\a.glb");
    assert.equal(absolute("\\\\server\\share\\work", "a.glb"), "\\\\server\\share\\work\\a.glb");
  });

  it("restart at a drive or a share in any position", () => {
    assert.equal(absolute("D:\\work", "C:\\models\\a.glb"), "C:\\models\\a.glb");
    assert.equal(absolute("D:\\work", "\\\\server\\share\\a.glb"), "\\\\server\\share\\a.glb");
    assert.equal(absolute("\\\\server\\share\\work", "E:\\a.glb"), "E:\\a.glb");
  });

  it("do not treat a colon or two slashes inside a name as a drive or a share", () => {
    assert.equal(systemPath("models/a:b.glb"), "models/a:b.glb");
    assert.equal(systemPath("models//a.glb"), "models//a.glb");
  });
});
