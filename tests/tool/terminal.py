#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""terminal.py TOOL [FILTER]: tests the output on a terminal: progress of every long stage, and text that fits the
terminal's width."""
import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import tempfile
import termios
import time

tool = os.path.abspath(sys.argv[1])
only = sys.argv[2] if len(sys.argv) > 2 else ""
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def on_terminal(arguments, columns=100, stdout=False):
    """Runs the tool with stderr, or also stdout, on a terminal. Returns the output."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 40, columns, 0, 0))
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    process = subprocess.Popen([tool, *arguments], stdin=subprocess.DEVNULL, stderr=theirs, env=environment,
                               stdout=theirs if stdout else subprocess.DEVNULL)
    os.close(theirs)
    text = b""
    while True:
        try:
            part = os.read(ours, 65536)
        except OSError:
            break
        if not part:
            break
        text += part
    os.close(ours)
    process.wait()
    return text.decode(errors="replace")


def write_grid(name, count, height, mesh=""):
    """Writes a square of count * count quads, bent by a height function. `mesh`: name of its object."""
    side = range(count + 1)
    with open(name, "w", encoding="ascii") as file:
        file.write("mtllib grid.mtl\n" + (f"o {mesh}\n" if mesh else "") + "usemtl skin\n")
        for y in side:
            for x in side:
                file.write(f"v {x / count} {height * ((x * y) % 7) / 7} {y / count}\nvt {x / count} {y / count}\n")
        for y in range(count):
            for x in range(count):
                a = y * (count + 1) + x + 1
                b, c, d = a + 1, a + count + 2, a + count + 1
                file.write(f"f {a}/{a} {d}/{d} {c}/{c} {b}/{b}\n")


with open("grid.mtl", "w", encoding="ascii") as file:
    file.write("newmtl skin\n")
write_grid("large.obj", 400, 0.002)
write_grid("low.obj", 4, 0)
write_grid("high.obj", 64, 0.01)
subprocess.run([tool, "generate", "-q", "--all", "large.obj", "-o", "large.glb"], check=True)


def lines_of(text):
    """Returns the lines of an output, and the states of the status line, each of which was erased by the next one."""
    return [line for line in re.split(r"\r\x1b\[K|\r?\n", text) if line]


def test_progress():
    long = {
        "check": (["check", *["large.glb"] * 8], "check|read|compar"),
        "render": (["render", "large.glb", "-o", "turn.png", "--turntable", "12", "--size", "256"], "drawing"),
        "bake": (["bake", "low.obj", "--high", "high.obj", "-o", "map.png", "--size", "2048", "--threads", "1"], "solving|fitting"),
        "map-error": (["map-error", "flat.png", "low.obj", "--high", "high.obj", "--threads", "1"], "measuring"),
        "diff": (["diff", "large.glb", "large.glb"], "comparing"),
        "identify": (["identify", *["large.glb"] * 8], "reading"),
    }
    commands = subprocess.run([tool, "--help"], capture_output=True, text=True).stdout
    if "\n  bake\n" in commands:
        subprocess.run([tool, "bake", "-q", "low.obj", "--high", "high.obj", "-o", "flat.png", "--size", "2048"], check=True)
    for name, (arguments, stage) in long.items():
        if name in ("bake", "map-error") and f"\n  {name}\n" not in commands:
            continue
        begin = time.monotonic()
        text = on_terminal(arguments)
        if name == "diff" and time.monotonic() - begin < 1:
            continue  # the stage was too fast for a status line
        shown = lines_of(text)
        expect(any(re.search(stage, line) for line in shown), f"{name}: no stage '{stage}' in {shown[:40]}")
        expect(not any(re.fullmatch(r"\d+ s", line) for line in shown), f"{name}: a time without a stage in {shown[:5]}")
        expect(any(re.search(r"\d+ s$", line) for line in shown), f"{name}: no time in {shown[:5]}")
        expect(all(len(line) < 100 for line in shown), f"{name}: a status line is wider than the terminal")
        expect(text.endswith("\r\x1b[K") or "\r\x1b[K" in text.split("\n")[-1] or not shown, f"{name}: the line is left behind")
        quiet = on_terminal([*arguments, "-q"])
        expect(quiet == "", f"{name} -q: {quiet[:80]!r}")
        piped = subprocess.run([tool, *arguments], capture_output=True, text=True)
        expect(piped.stderr == "", f"{name}: without a terminal stderr has {piped.stderr[:80]!r}")


def unbreakable(line):
    """Returns whether a line is a command or a path, which may be wider than the terminal."""
    return re.search(r"tspace [a-z-]+ .*|\S{30,}", line)


def test_width():
    commands = ["", "generate", "check", "bake", "render", "convert-map", "map-error", "finish", "help"]
    texts = [["help", command] if command else ["--help"] for command in commands]
    texts += [["check", "large.obj"], ["generate", "--dry-run", "--all", "large.obj", "-o", "o.glb"], ["inspect", "large.glb"],
              ["identify", "large.glb"], ["diff", "large.glb", "large.glb"]]
    for columns in (60, 120):
        for arguments in texts:
            for way in ("ioctl", "COLUMNS"):
                if way == "ioctl":
                    out = on_terminal([*arguments], columns, stdout=True)
                else:
                    out = subprocess.run([tool, *arguments], capture_output=True, text=True,
                                         env={**os.environ, "COLUMNS": str(columns)}).stdout
                wide = [line for line in lines_of(out) if len(line) > columns and not unbreakable(line)]
                expect(not wide, f"{' '.join(arguments)} at {columns} ({way}): {wide[:2]}")
                if arguments[0] != "help":
                    break
    # At the usual width, examples fit too.
    for command in re.findall(r"(?m)^  ([a-z-]+)$", on_terminal(["--help"], 80, stdout=True).replace("\r", "")):
        wide = [line for line in lines_of(on_terminal(["help", command], 80, stdout=True)) if len(line) > 80]
        expect(not wide, f"help {command} at 80: {wide[:2]}")
    spaced = "a name of several words, so that it can be broken at its spaces, " * 3
    write_grid("named.obj", 4, 0, spaced)
    for arguments in (["inspect", "named.obj"], ["identify", "named.glb"],
                      ["generate", "--dry-run", "--all", "named.obj", "-o", "o.glb"]):
        if arguments[-1] == "named.glb":
            subprocess.run([tool, "generate", "-q", "--all", "named.obj", "-o", "named.glb"], check=True)
        for columns in (60, 120):
            out = subprocess.run([tool, *arguments], capture_output=True, text=True,
                                 env={**os.environ, "COLUMNS": str(columns)}).stdout
            wide = [line for line in lines_of(out) if len(line) > columns]
            expect("several words" in out and not wide, f"{' '.join(arguments)} at {columns}: {wide[:2]}")
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    out = subprocess.run([tool, "help", "bake"], capture_output=True, text=True, env=environment).stdout
    widths = [len(line) for line in out.splitlines() if not unbreakable(line)]
    expect(70 < max(widths) <= 80, f"without a terminal the widest line has {max(widths)} columns, not 80")


def test_commands_are_not_split():
    out = subprocess.run([tool, "help", "generate"], capture_output=True, text=True, env={**os.environ, "COLUMNS": "60"}).stdout
    example = "tspace generate scan.obj -o scan.glb --all --normals angle --crease 60"
    expect(example in out, "an example of help is broken")
    long = "a model with spaces in a rather long name, so that it is wider than the terminal.obj"
    os.link("low.obj", long)
    out = subprocess.run([tool, "check", long], capture_output=True, text=True, env={**os.environ, "COLUMNS": "60"}).stdout
    expect(long in out, f"a path is broken: {out[:200]}")


for test_name, test in [(name, one) for name, one in list(globals().items()) if name.startswith("test_")]:
    if only in test_name:
        test()
print("\n".join(faults) or "all as it should be")
sys.exit(bool(faults))
