# SPDX-License-Identifier: MIT
"""Run by Blender: imports each model after "--" and prints one line for each. The import must match the file: the same
number of vertices, three loops per triangle, and all shape keys and skins. An exception ends Blender with status 1
(--python-exit-code)."""
import json
import pathlib
import struct
import sys

import bpy
import numpy

# Debian's Blender 3.4 uses numpy.bool, which Debian's numpy no longer has.
numpy.bool = bool


def read_json(path):
    data = pathlib.Path(path).read_bytes()
    if data[:4] == b"glTF":
        data = data[20 : 20 + struct.unpack_from("<I", data, 12)[0]]
    return json.loads(data)


def expected(path):
    """Returns (vertices, loops, shape keys, skins) of models whose primitives are indexed triangles and share no vertices."""
    gltf = read_json(path)
    count = [accessor["count"] for accessor in gltf["accessors"]]
    primitives = [primitive for mesh in gltf["meshes"] for primitive in mesh["primitives"]]
    return (
        sum(count[primitive["attributes"]["POSITION"]] for primitive in primitives),
        sum(count[primitive["indices"]] for primitive in primitives),
        sum(len(mesh["primitives"][0].get("targets", [])) for mesh in gltf["meshes"]),
        len(gltf.get("skins", [])),
    )


def imported():
    meshes = bpy.data.meshes
    return (
        sum(len(mesh.vertices) for mesh in meshes),
        sum(len(mesh.loops) for mesh in meshes),
        sum(len(mesh.shape_keys.key_blocks) - 1 for mesh in meshes if mesh.shape_keys),
        len(bpy.data.armatures),
    )


for path in sys.argv[sys.argv.index("--") + 1 :]:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if bpy.ops.import_scene.gltf(filepath=path) != {"FINISHED"}:
        raise RuntimeError(f"{path} was not imported")
    if imported() != expected(path) or imported()[1] == 0:
        raise RuntimeError(f"{path}: vertices, loops, shape keys and skins {imported()}, but the file has {expected(path)}")
    print("IMPORTED %s: %d vertices, %d loops, %d shape keys, %d skins" % (pathlib.Path(path).name, *imported()))
