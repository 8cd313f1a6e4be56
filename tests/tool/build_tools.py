#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""build_tools.py TOOL: tests depfiles as make and ninja read them, lists of inputs, and long names of outputs."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time

tool = os.path.abspath(sys.argv[1])
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def run(*arguments, stdin=b""):
    return subprocess.run([tool, *arguments], input=stdin, capture_output=True)


def write_model(name, library):
    with open(name, "w", encoding="ascii") as file:
        file.write(f"mtllib {library}\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                   "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n")


def write_library(name, image):
    with open(name, "w", encoding="ascii") as file:
        file.write("newmtl skin\n" + (f"norm {image}\n" if image else ""))


# A name with characters that are special in make and ninja.
odd = "my $model #1 a:b.obj"
write_model(odd, "skin.mtl")
write_library("skin.mtl", "")
written = run("generate", "-q", "--all", odd, "-o", "odd $out.glb", "--depfile", "odd.d")
expect(written.returncode == 0, written.stderr.decode())
text = open("odd.d", encoding="utf-8").read()
expect(text.startswith("odd\\ $$out.glb:"), f"the output is not the target: {text}")
expect("my\\ $$model\\ \\#1\\ a\\:b.obj" in text and "skin.mtl" in text, f"an input is missing: {text}")


def rebuilt(build, outputs):
    """Returns whether a build rewrites the outputs."""
    before = [os.stat(one).st_mtime_ns for one in outputs]
    time.sleep(0.02)
    done = subprocess.run(build, capture_output=True, text=True)
    expect(done.returncode == 0, f"{build}: {done.stdout}{done.stderr}")
    return [os.stat(one).st_mtime_ns for one in outputs] != before


def try_build(name, build, output):
    """Checks that the first build creates everything, the second one nothing, and each changed input causes a build."""
    for source in (odd, "skin.mtl"):
        os.utime(source, (time.time() - 10, time.time() - 10))
    done = subprocess.run(build, capture_output=True, text=True)
    expect(done.returncode == 0 and os.path.exists(output), f"{name}: {done.stdout}{done.stderr}")
    if done.returncode != 0:
        return
    expect(not rebuilt(build, [output]), f"{name}: builds again for nothing")
    for source in (odd, "skin.mtl"):
        later = time.time() + 2  # later than the output at the time resolution of any file system
        os.utime(source, (later, later))
        expect(rebuilt(build, [output]), f"{name}: does not build again when '{source}' has changed")
        os.utime(source, (time.time() - 10, time.time() - 10))
    os.remove(output)


if shutil.which("make"):
    with open("Makefile", "w", encoding="ascii") as file:
        file.write("out.glb: ; '" + tool + "' generate -q --all 'my $$model #1 a:b.obj' -o out.glb --depfile make.d\n-include make.d\n")
    try_build("make", ["make", "out.glb"], "out.glb")
    os.rename("skin.mtl", "other.mtl")  # a missing input does not stop make
    write_model(odd, "other.mtl")
    done = subprocess.run(["make", "out.glb"], capture_output=True, text=True)
    expect(done.returncode == 0, f"make stops for a removed input: {done.stderr}")
    os.rename("other.mtl", "skin.mtl")
    write_model(odd, "skin.mtl")
if shutil.which("ninja"):
    for deps in ("", "  deps = gcc\n"):
        with open("build.ninja", "w", encoding="ascii") as file:
            file.write("rule tangents\n  command = '" + tool + "' generate -q --all 'my $$model #1 a:b.obj' -o $out --depfile ninja.d\n"
                       f"  depfile = ninja.d\n{deps}build ninja.glb: tangents\n")
        try_build(f"ninja{deps}", ["ninja"], "ninja.glb")

# Depfiles of other commands, and of several outputs.
expect(run("generate", "-q", "--all", odd, "-o", "two.gltf", "--depfile", "two.d").returncode == 0, "generate .gltf")
expect(open("two.d", encoding="utf-8").read().split(":")[0].split() == ["two.bin", "two.gltf"] or
       set(open("two.d", encoding="utf-8").read().split(":")[0].split()) == {"two.bin", "two.gltf"}, open("two.d", encoding="utf-8").read())
expect(run("check", "-q", "two.gltf", "--html", "page.html", "--depfile", "page.d").returncode in (0, 1), "check --html")
text = open("page.d", encoding="utf-8").read()
expect(text.startswith("page.html:") and "two.gltf" in text and "two.bin" in text, f"check: {text}")
picture = run("render", "-q", "two.gltf", "-o", "picture.png", "--depfile", "picture.d")
if picture.returncode == 0:
    text = open("picture.d", encoding="utf-8").read()
    expect(text.startswith("picture.png:") and "two.bin" in text, f"render: {text}")
    expect(run("flip-green", "-q", "picture.png", "-o", "flipped.png", "--depfile", "f.d").returncode == 0, "flip-green")
    expect(open("f.d", encoding="utf-8").read().startswith("flipped.png: \\\n  picture.png"), open("f.d", encoding="utf-8").read())
for wrong in (["generate", "two.gltf", "--in-place", "--depfile", "x.d"], ["check", "two.gltf", "--depfile", "x.d"],
              ["generate", "two.gltf", "-o", "-", "--depfile", "x.d"], ["generate", "two.gltf", "-o", "x.glb", "--dry-run", "--depfile", "x.d"]):
    expect(run(*wrong).returncode == 2 and not os.path.exists("x.d"), f"{wrong} is not refused")
expect(run("generate", "-q", "missing.glb", "-o", "m.glb", "--depfile", "m.d").returncode == 4 and not os.path.exists("m.d"), "a failed run leaves a depfile")
# A depfile that is another file of the run is wrong usage: no output is written, and no file is changed.
write_library("named.mtl", "named.png")
write_model("named.obj", "named.mtl")
with open("named.png", "wb") as file:
    file.write(b"not an image")
kept = {name: open(name, "rb").read() for name in ("two.gltf", "two.bin", "named.obj", "named.mtl", "named.png")}
for wrong, name in ((["generate", "two.gltf", "-o", "same.glb"], "same.glb"), (["generate", "two.gltf", "-o", "same.glb"], "two.gltf"),
                    (["generate", "two.gltf", "-o", "same.glb"], "two.bin"), (["generate", "named.obj", "--all", "-o", "same.glb"], "named.mtl"),
                    (["generate", "two.gltf", "-o", "same.glb", "--manifest", "same.jsonl"], "same.jsonl"),
                    (["check", "two.gltf", "--html", "same.html"], "same.html"), (["check", "two.gltf", "--html", "same.html"], "two.bin"),
                    (["finish", "two.gltf", "-o", "same.glb", "--report", "same.json"], "same.json"),
                    (["finish", "named.obj", "-o", "same.glb"], "named.mtl")):
    refused = run(*wrong, "-q", "--depfile", name)
    made = [one for one in os.listdir(".") if one.startswith("same.")]
    expect(refused.returncode == 2 and not made, f"{wrong} --depfile {name}: {refused.returncode}, {made}, {refused.stderr.decode()}")
refused = run("finish", "named.obj", "-o", "same.glb", "-q", "--report", "named.mtl")
expect(refused.returncode == 2 and not os.path.exists("same.glb"), f"--report of an input: {refused.stderr.decode()}")
expect(kept == {name: open(name, "rb").read() for name in kept}, "an input was changed")

# Lists of inputs (--inputs).
for command, more in (("check", []), ("inspect", []), ("identify", []), ("generate", ["--all", "-o", "made/"])):
    for separator in (b"\n", b"\r\n", b"\0"):
        listed = run(command, "--json", *more, "--files-from", "-", stdin=separator.join([b"two.gltf", odd.encode(), b""]))
        files = json.loads(listed.stdout)["files"] if listed.stdout else []
        expect([one["input"] for one in files] == ["two.gltf", odd], f"{command}: {listed.stdout[:200]} {listed.stderr}")
    with open("list.txt", "w", encoding="ascii") as file:
        file.write("two.gltf\n")
    expect(b"two.gltf" in run(command, *more, "--files-from", "list.txt").stdout, f"{command} --files-from FILE")
    if hasattr(os, "mkfifo"):
        os.mkfifo("pipe")
        writer = threading.Thread(target=lambda: open("pipe", "w", encoding="ascii").write("two.gltf\n"))
        writer.start()
        expect(b"two.gltf" in run(command, *more, "--files-from", "pipe").stdout, f"{command} --files-from PIPE")
        writer.join()
        os.remove("pipe")
    expect(run(command, *more, "--files-from", "-").returncode == 0, f"{command}: an empty list is an error")
    expect(run(command, *more, "--files-from", "nothing.txt").returncode == 4, f"{command}: a list that is missing")
    expect(run(command, *more).returncode == 2, f"{command}: without inputs")
    expect(run(command, *more, "-", "--files-from", "-").returncode == 2, f"{command}: two want stdin")
expect(os.path.exists("made/two.glb") or os.path.exists("made/two.gltf"), "generate with a list writes into a folder")

# Names of materials become parts of file names, which may have 255 bytes. Long names that differ only in their ends
# must give different file names.
with open("long.obj", "w", encoding="utf-8") as file:
    file.write("mtllib long.mtl\n" + "".join(f"v {x} {y} 0\nvt {x} {y}\n" for x, y in ((0, 0), (1, 0), (0, 1))))
    file.write("".join(f"usemtl {'x' * 300}{end}\nf 1/1 2/2 3/3\n" for end in "ab"))
with open("long.mtl", "w", encoding="utf-8") as file:
    file.write("".join(f"newmtl {'x' * 300}{end}\n" for end in "ab"))
baked = run("bake", "-q", "long.obj", "--high", "long.obj", "--size", "8", "--maps", "normal,ao", "-o", "baked/map.png")
if b"unknown command" not in baked.stderr:
    expect(baked.returncode in (0, 1) and len(os.listdir("baked")) == 4, f"bake of long names: {baked.stderr}")
print("\n".join(faults) or "all as it should be")
sys.exit(bool(faults))
