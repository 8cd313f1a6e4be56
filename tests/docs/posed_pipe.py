#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""posed_pipe.py OUT.glb: a pipe with rings in two colors on three joints, which the file's nodes bend."""
import json
import math
import struct
import sys

SIDES, RINGS, HEIGHT, RADIUS = 40, 60, 3.0, 0.42
JOINTS = 3  # in a line, one unit apart; the first one is at the bottom
TURN = math.radians(42)  # angle by which the second and third joint are rotated about z

positions, normals, colors, joints, weights, indices = [], [], [], [], [], []
for ring in range(RINGS + 1):
    y = HEIGHT * ring / RINGS
    # Near each further joint, within 0.6 units of height, the weight moves from the joint below to this joint.
    along = min(max((y - 0.7) / 0.6, 0), 1) + min(max((y - 1.7) / 0.6, 0), 1)
    low = min(int(along), JOINTS - 2)
    for side in range(SIDES):
        angle = 2 * math.pi * side / SIDES
        c, s = round(math.cos(angle), 5), round(math.sin(angle), 5)
        positions.append((RADIUS * c, y, RADIUS * s))
        normals.append((c, 0, s))
        colors.append((0.85, 0.32, 0.05, 1) if ring // 6 % 2 else (0.75, 0.78, 0.80, 1))
        joints.append((low, low + 1, 0, 0))
        weights.append((1 - (along - low), along - low, 0, 0))
        if ring < RINGS:
            a, b = ring * SIDES + side, ring * SIDES + (side + 1) % SIDES
            indices += [a, a + SIDES, b, b, a + SIDES, b + SIDES]

binary, views, accessors = b"", [], []


def add(rows, kind, component, code, **more):
    global binary
    data = b"".join(struct.pack("<" + code * len(row), *row) for row in rows)
    views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
    accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(rows), "type": kind, **more})
    binary += data + bytes(-len(data) % 4)
    return len(accessors) - 1


def bounds(rows):
    single = [struct.unpack("<3f", struct.pack("<3f", *row)) for row in rows]
    return {"min": [min(c) for c in zip(*single)], "max": [max(c) for c in zip(*single)]}


attributes = {
    "POSITION": add(positions, "VEC3", 5126, "f", **bounds(positions)),
    "NORMAL": add(normals, "VEC3", 5126, "f"),
    "COLOR_0": add(colors, "VEC4", 5126, "f"),
    "JOINTS_0": add(joints, "VEC4", 5121, "B"),
    "WEIGHTS_0": add(weights, "VEC4", 5126, "f"),
}
list_of_indices = add([(i,) for i in indices], "SCALAR", 5123, "H")
inverse = add([(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -float(j), 0, 1) for j in range(JOINTS)], "MAT4", 5126, "f")
bent = [0, 0, -round(math.sin(TURN / 2), 5), round(math.cos(TURN / 2), 5)]
gltf = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0, 1]}],
    "nodes": [
        {"mesh": 0, "skin": 0},
        {"children": [2]},
        {"translation": [0, 1, 0], "rotation": bent, "children": [3]},
        {"translation": [0, 1, 0], "rotation": bent},
    ],
    "skins": [{"joints": [1, 2, 3], "inverseBindMatrices": inverse}],
    "meshes": [{"primitives": [{"attributes": attributes, "indices": list_of_indices, "material": 0}]}],
    "materials": [{"doubleSided": True, "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.45}}],
    "accessors": accessors,
    "bufferViews": views,
    "buffers": [{"byteLength": len(binary)}],
}
text = json.dumps(gltf).encode()
text += b" " * (-len(text) % 4)
with open(sys.argv[1], "wb") as file:
    file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(binary)))
    file.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary)
