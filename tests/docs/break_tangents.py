#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""break_tangents.py signs|nan IN.glb OUT.glb: breaks float tangents in the GLB's own buffer.

signs: sets every w to +1, as programs do that drop it. nan: replaces the tangent of every 23rd vertex by NaN, as a division
by a zero UV area does."""
import json
import struct
import sys

FLOAT = 5126
fault, source, target = sys.argv[1:]
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
            at = begin + vertex * view.get("byteStride", 16)
            if fault == "signs":
                struct.pack_into("<f", model, at + 12, 1.0)
            elif vertex % 23 == 0:
                struct.pack_into("<3f", model, at, *[float("nan")] * 3)

with open(target, "wb") as file:
    file.write(model)
