#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""lose_signs.py IN.glb OUT.glb: sets w of every tangent to +1, as a program does that drops it. Float tangents in the GLB's
own buffer only."""
import json
import struct
import sys

FLOAT = 5126
source, target = sys.argv[1:]
with open(source, "rb") as file:
    model = bytearray(file.read())
(json_bytes,) = struct.unpack_from("<I", model, 12)
gltf = json.loads(model[20 : 20 + json_bytes])
buffer_at = 20 + json_bytes + 8

for mesh in gltf["meshes"]:
    for primitive in mesh["primitives"]:
        accessor = gltf["accessors"][primitive["attributes"]["TANGENT"]]
        view = gltf["bufferViews"][accessor["bufferView"]]
        if accessor["componentType"] != FLOAT:
            sys.exit("the tangents are not floats")
        begin = buffer_at + view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        for vertex in range(accessor["count"]):
            struct.pack_into("<f", model, begin + vertex * view.get("byteStride", 16) + 12, 1.0)

with open(target, "wb") as file:
    file.write(model)
