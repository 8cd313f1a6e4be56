#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""mistakes.py TOOL: each mistake on a command line has one exit code and one line of text in all commands."""
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import zlib

tool = os.path.abspath(sys.argv[1])
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
faults = []


def run(arguments):
    return subprocess.run([tool, *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")


listed = run(["--help"]).stdout

# For each command: its inputs, further options, and a valid name of an output.
COMMANDS = {
    "generate": (["MODEL"], [], "out.glb"),
    "diff": (["MODEL", "a.obj"], [], None),
    "identify": (["MODEL"], [], None),
    "inspect": (["MODEL"], [], None),
    "check": (["MODEL"], [], None),
    "flip-green": (["IMAGE"], [], "out.png"),
    "render": (["MODEL"], ["--size", "16"], "out.png"),
    "convert-map": (["IMAGE"], ["--flip-green"], "out.png"),
    "height-to-normal": (["IMAGE"], [], "out.png"),
    "compress-map": (["IMAGE"], [], "out.dds"),
    "bake": (["MODEL"], ["--high", "a.obj", "--size", "16"], "out.png"),
    "finish": (["MODEL"], [], "out.glb"),
    "map-error": (["IMAGE", "a.obj"], ["--high", "a.obj"], None),
    "view": (["MODEL"], [], "out.html"),
}
COMMANDS = {name: command for name, command in COMMANDS.items() if f"\n  {name}\n" in listed}


def png(name):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(name, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress((b"\0" + b"\x80\x80\xff" * 2) * 2)) + chunk(b"IEND", b""))


with open("a.obj", "w", encoding="ascii") as model:
    model.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
png("map.png")
for empty in ("empty.glb", "empty.gltf", "empty.obj"):
    open(empty, "wb").close()
with open("text.txt", "w", encoding="ascii") as text:
    text.write("no model, no image\n")
os.mkdir("folder")
os.mkdir("folder.png")
os.mkdir("folder.glb")


def line_of(name, model="a.obj", image="map.png", output=True, more=()):
    inputs, options, right = COMMANDS[name]
    words = [name, *({"MODEL": model, "IMAGE": image}.get(word, word) for word in inputs), *options]
    if right and output:
        words += ["-o", right if output is True else output]
    return [*words, *more]


def expect(arguments, code, pattern):
    ran = run(arguments)
    shown = f"tspace {' '.join(arguments)}: {ran.returncode} {ran.stderr!r}"
    if ran.returncode != code:
        faults.append(f"{shown}: not exit code {code}")
    elif len(ran.stderr.splitlines()) != 1 or not ran.stderr.startswith("tspace: ") or not re.search(pattern, ran.stderr):
        faults.append(f"{shown}: not one line with {pattern!r}")


def each(condition=lambda name: True):
    return [name for name in COMMANDS if condition(name)]


with_output = each(lambda name: COMMANDS[name][2])
of_models = each(lambda name: COMMANDS[name][0][0] == "MODEL")
of_images = each(lambda name: COMMANDS[name][0][0] == "IMAGE")


def test_outputs():
    for name in with_output:
        for wrong in ("out.pdf", "out.fbx", "out.GLBX", "out.", "out.glb.txt"):
            expect(line_of(name, output=wrong), 2, r"must end in \.")
        expect(line_of(name, output=False), 2, "--output is missing")
        expect(line_of(name, output=False, more=["-o"]), 2, "--output needs a value")
        expect(line_of(name, more=["-o", COMMANDS[name][2]]), 2, "--output is given twice")
    for name in ("flip-green", "render", "height-to-normal"):
        expect(line_of(name, output="folder.png"), 4, "it is a folder")
    for wrong in ("out.jpg", "out.webp", "out.ktx2", "out.dds"):
        expect(["flip-green", "map.png", "-o", wrong], 2, f"the output '{wrong}' must end in .png")
    for name in each(lambda name: name in ("check", "diff", "finish")):
        expect(line_of(name, more=["--html", "page.pdf"]), 2, "must end in .html")
    for option in ("--heat", "--misses") if "bake" in COMMANDS else ():
        expect(line_of("bake", more=[option, "picture.jpg"]), 2, "'picture.jpg' must end in .png")
    if "map-error" in COMMANDS:
        expect(line_of("map-error", more=["--heat", "picture.pdf"]), 2, "'picture.pdf' must end in .png")


def test_inputs():
    for name in each(lambda name: name != "view"):
        expect([name], 2, "is missing")
    for name in of_models:
        if name == "view":
            continue
        expect(line_of(name, model="none.glb"), 4, "none.glb: the file 'none.glb' does not exist")
        for wrong in ("empty.glb", "empty.gltf", "empty.obj", "text.txt"):
            expect(line_of(name, model=wrong), 3, f"{wrong}: the")
        if name != "check":
            for wrong in ("map.png", "none.KTX2", "none.tga"):
                expect(line_of(name, model=wrong), 2, f"reads models, but '{wrong}' is an image; tspace check")
        if name not in ("generate", "identify", "inspect", "check"):
            for wrong in ("folder", "folder.glb", "folder.png"):
                expect(line_of(name, model=wrong), 4, f"'{wrong}' is a folder")
    # The error message lists the formats that are lossless for this input.
    for image, endings in (("map.png", ".png"), ("map.jpg", ".jpg, .jpeg or .png"), ("map.tga", ".png")):
        expect(["flip-green", image, "-o", "out.pdf"], 2, f"the output 'out.pdf' must end in {re.escape(endings)}$")
    for name in of_images:
        expect(line_of(name, image="none.png"), 4, "none.png: the file 'none.png' does not exist")
        expect(line_of(name, image="text.txt"), 3, "text.txt: the image")
        for wrong in ("a.obj", "none.gltf", "none.STL", "none.fbx", "none.vrm"):
            advice = f"MAP must be an image, but '{wrong}' is a model$" \
                if name == "map-error" else f"reads images, but '{wrong}' is a model; tspace generate"
            expect(line_of(name, image=wrong), 2, advice)
        for wrong in ("folder", "folder.glb", "folder.png"):
            expect(line_of(name, image=wrong), 4, f"'{wrong}' is a folder")
    others = ["diff a.obj map.png", "bake a.obj --high map.png -o out.png", "finish a.obj --low map.png -o out.glb",
              "bake a.obj --high a.obj --cage map.png -o out.png", "convert-map map.png --mesh map.png -o out.png",
              "convert-map map.png --mesh a.obj --to-mesh map.png -o out.png", "map-error map.png map.png --high a.obj",
              "map-error map.png a.obj --high map.png", "height-to-normal map.png --mesh map.png -o out.png"]
    for arguments in others:
        if arguments.split()[0] in COMMANDS:
            expect(arguments.split(), 2, "'map.png' is an image")
    others = ["map-error map.png --source a.obj", "bake a.obj --high a.obj --skew a.obj -o out.png",
              "compress-map map.png --roughness a.obj --roughness-output r.png -o out.dds", "check --files-from a.obj",
              "bake --pairs a.obj -o out/", "bake a.obj --high a.obj --match a.obj -o out.png",
              "finish a.obj --low a.obj --match a.obj -o out.glb", "map-error map.png a.obj --high a.obj --match a.obj"]
    for arguments in others:
        if arguments.split()[0] in COMMANDS:
            expect(arguments.split(), 2, "'a.obj' is a model")

    # A text output never replaces a model or an image.
    others = [["check", "map.png", "--sarif", "a.obj"], ["check", "map.png", "--sarif", "out.sarif", "--depfile", "a.obj"],
              ["generate", "none.obj", "-o", "out/", "--manifest", "a.obj"], ["finish", "none.obj", "-o", "out.glb", "--report", "a.obj"],
              ["bake", "none.obj", "--high", "none.obj", "-o", "out.png", "--report", "a.obj"]]
    for arguments in others:
        if arguments[0] in COMMANDS:
            expect(arguments, 2, f"{arguments[-2]} must be a text file, but 'a.obj' is a model")
            expect([*arguments[:-1], "map.png"], 2, f"{arguments[-2]} must be a text file, but 'map.png' is an image")


def test_encodings():
    for encoding, mark, shown in (("utf-16-le", "\ufeff", "UTF-16"), ("utf-16-be", "\ufeff", "UTF-16"),
                                  ("utf-16-le", "", "UTF-16"), ("utf-16-be", "", "UTF-16"), ("utf-32-le", "\ufeff", "UTF-32")):
        for name, lines in (("wide.obj", open("a.obj", encoding="ascii").read()), ("list.txt", "a.obj\nb.obj\n"),
                            ("pairs.txt", "a.obj = a.obj\n"), ("wide.gltf", '{"asset": {"version": "2.0"}}')):
            with open(name, "wb") as file:
                file.write((mark + lines).encode(encoding))
        others = [line_of(name, model=model) for name in of_models for model in ("wide.obj", "wide.gltf")]
        others += [["check", "--files-from", "list.txt"]]
        if "bake" in COMMANDS:
            others += [["bake", "--pairs", "pairs.txt", "-o", "out/"],
                       ["bake", "a.obj", "--high", "a.obj", "--match", "pairs.txt", "-o", "out.png"]]
        for arguments in others:
            expect(arguments, 3, f"the text is encoded as {shown}, which is not supported; save the file as UTF-8")
    # A byte order mark is not a part of the first name. Names of one letter may be separated by NUL bytes (and are not
    # mistaken for UTF-16).
    for name, content in (("list.txt", b"\xef\xbb\xbfmissing.obj\n"), ("list.txt", b"m\0n\0")):
        with open(name, "wb") as file:
            file.write(content)
        ran = run(["check", "--files-from", name])
        first = "m" if b"\0" in content else "missing.obj"
        if not ran.stderr.startswith(f"tspace: {first}: the file '{first}' does not exist"):
            faults.append(f"{content}: {ran.stderr}")


def test_json_types():
    members = {"nodes": [{"mesh": "0"}], "images": [{"uri": 5}], "textures": [{"source": "0"}], "scene": [], "scenes": {},
               "materials": [{"name": 1}], "meshes": [{"name": {}}], "bufferViews": [{"buffer": "0"}],
               "buffers": [{"uri": True, "byteLength": 1}], "accessors": [{"bufferView": "0"}], "extensionsUsed": "x"}
    for key, value in members.items():
        with open("types.gltf", "w", encoding="ascii") as file:
            json.dump({"asset": {"version": "2.0"}, key: value}, file)
        for name in of_models:
            expect(line_of(name, model="types.gltf"), 3, rf"types.gltf: '\w+' is not an? .* but .* \(at /{key}")


def test_words():
    for name in COMMANDS:
        for wrong, near in (("--memory-limt", "'--memory-limit'"), ("--quite", "'--quiet'"), ("--jsno", "'--json'")):
            expect(line_of(name, more=[wrong, "1"]), 2, f"unknown option '{wrong}'; did you mean {near}")
        expect(line_of(name, more=["-?"]), 2, r"unknown option '-\?'")
        expect(line_of(name, more=["--quiet=yes"]), 2, "--quiet takes no value")
        expect(line_of(name, more=["--memory-limit"]), 2, "--memory-limit needs a value")
        expect(line_of(name, more=["--memory-limit", "many"]), 2, "--memory-limit many: must be")
        expect([name[:-1] + "x"], 2, f"did you mean '{name}'")
        expect(["help", name.upper()], 2, f"did you mean '{name}'")
    for word, line in (("fix", "generate --repair"), ("Repair", "generate --repair"), ("version", "--version"),
                       ("validate", "check"), ("info", "inspect"), ("a.obj", "check IN"), ("map.png", "check IN")):
        expect([word], 2, f"unknown command '{word}'; use tspace {line}")
        expect(["help", word], 2, f"unknown command '{word}'; use tspace {line}")


for test_name, test in [(name, one) for name, one in list(globals().items()) if name.startswith("test_")]:
    test()
left = [name for name in os.listdir(".") if name.startswith("out")]
if left:
    faults.append(f"a wrong command line left {left}")
print("\n".join(faults) or "all as it should be")
sys.exit(bool(faults))
