# SPDX-License-Identifier: MIT
"""Pictures of docs/compress-map.md. Joining needs numpy.

python3 level_spheres.py write FOLDER: a tile of fine grooves and bumps (n.png), a texture of even roughness (orm.png), and a sphere that
    shows the tile 48 x 24 times, once for each set of maps (NAME.gltf)
python3 level_spheres.py join OUT.png SIZE PICTURE...: pictures side by side, each made SIZE wide and high: smaller by means of light,
    larger by repeating texels
"""

import base64
import json
import math
import struct
import sys
import zlib

TEXELS, ROUGHNESS, METAL, SHADE, AROUND, DOWN = 128, 0.3, 1, 0.15, 96, 48
REPEATS = (48, 24)
# Normals and roughness of each picture.
SPHERES = {"first": ("n.0.png", "orm.0.png"), "mean": ("n.3.png", "orm.0.png"), "widened": ("n.3.png", "orm.3.png")}


def png(width, height, bits, rows):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    raw = b"".join(b"\0" + row for row in rows)
    head = struct.pack(">IIBBBBB", width, height, bits, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b"")


def height(x, y):
    """Of a tile of 1 x 1, in tiles: brushed grooves and a weave of bumps."""
    turn = 2 * math.pi
    grooves = math.sin(turn * (16 * y + 0.2 * math.sin(turn * 2 * x))) / 16
    bumps = math.sin(turn * 17 * x) * math.sin(turn * 17 * y) / 17
    return 0.02 * grooves + 0.045 * bumps


def normal_row(row):
    out = b""
    step = 1 / TEXELS
    for column in range(TEXELS):
        x, y = (column + 0.5) * step, 1 - (row + 0.5) * step
        p = (height(x + step / 2, y) - height(x - step / 2, y)) / step
        q = (height(x, y + step / 2) - height(x, y - step / 2)) / step
        size = math.sqrt(p * p + q * q + 1)
        out += struct.pack(">3H", *(round((part / size * 0.5 + 0.5) * 65535) for part in (-p, -q, 1)))
    return out


def sphere():
    positions, normals, uvs, indices = [], [], [], []
    for j in range(DOWN + 1):
        for i in range(AROUND + 1):
            u, v = i / AROUND, j / DOWN
            around, down = 2 * math.pi * u, math.pi * v
            point = (math.sin(down) * math.sin(around), math.cos(down), math.sin(down) * math.cos(around))
            positions += point
            normals += point
            uvs += (REPEATS[0] * u, REPEATS[1] * v)
    for j in range(DOWN):
        for i in range(AROUND):
            a = j * (AROUND + 1) + i
            b = a + AROUND + 1
            indices += (a, b, a + 1, a + 1, b, b + 1)
    return positions, normals, uvs, indices


def model(data, counts, normal, orm):
    def uri(bytes_, kind):
        return f"data:{kind};base64,{base64.b64encode(bytes_).decode()}"

    views, accessors, at = [], [], 0
    kinds = [("VEC3", 5126, 12, 34962), ("VEC3", 5126, 12, 34962), ("VEC2", 5126, 8, 34962), ("SCALAR", 5125, 4, 34963)]
    for count, (kind, component, size, target) in zip(counts, kinds):
        views.append({"buffer": 0, "byteOffset": at, "byteLength": count * size, "target": target})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count, "type": kind})
        at += count * size
    accessors[0].update(min=[-1, -1, -1], max=[1, 1, 1])
    material = {
        "pbrMetallicRoughness": {"baseColorFactor": [SHADE, SHADE, SHADE, 1], "metallicFactor": METAL, "metallicRoughnessTexture": {"index": 1}},
        "normalTexture": {"index": 0},
    }
    primitive = {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}
    return {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(data), "uri": uri(data, "application/octet-stream")}],
        "bufferViews": views,
        "accessors": accessors,
        "images": [{"uri": normal}, {"uri": orm}],
        "textures": [{"source": 0}, {"source": 1}],
        "materials": [material],
        "meshes": [{"primitives": [primitive]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }


def write(folder):
    with open(f"{folder}/n.png", "wb") as file:
        file.write(png(TEXELS, TEXELS, 16, [normal_row(row) for row in range(TEXELS)]))
    texel = bytes((255, round(255 * ROUGHNESS), 255))
    with open(f"{folder}/orm.png", "wb") as file:
        file.write(png(TEXELS, TEXELS, 8, [texel * TEXELS] * TEXELS))
    positions, normals, uvs, indices = sphere()
    floats = positions + normals + uvs
    data = struct.pack(f"<{len(floats)}f", *floats) + struct.pack(f"<{len(indices)}I", *indices)
    counts = (len(positions) // 3, len(normals) // 3, len(uvs) // 2, len(indices))
    for name, (normal, orm) in SPHERES.items():
        with open(f"{folder}/{name}.gltf", "w", encoding="utf-8") as file:
            json.dump(model(data, counts, normal, orm), file)


def join(out, size, *pictures):
    import numpy as np

    from layer_errors import light, read_png, stored

    parts = []
    for path in pictures:
        image = read_png(path)
        times = len(image) // size
        if times > 1:
            image = stored(light(image).reshape(size, times, size, times, 3).mean((1, 3)))
        elif times == 0:
            image = np.kron(image, np.ones((size // len(image), size // len(image), 1)))
        parts.append(image)
    joined = np.round(255 * np.hstack(parts)).astype(np.uint8)
    with open(out, "wb") as file:
        file.write(png(joined.shape[1], size, 8, [row.tobytes() for row in joined]))


if sys.argv[1] == "write":
    write(sys.argv[2])
else:
    join(sys.argv[2], int(sys.argv[3]), *sys.argv[4:])
