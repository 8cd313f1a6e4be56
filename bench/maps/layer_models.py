# SPDX-License-Identifier: MIT
"""Writes models for baking occlusion, position and color maps.

The low poly is a square. The high poly is a textured height field with balls that are partly below its surface.

python3 layer_models.py FOLDER: writes low.obj, high.obj with high.mtl and color.png
"""
import math
import os
import struct
import sys
import zlib

CELLS = 256
TEXELS = 512
BALLS = [(-0.5, -0.5, 0.25), (0.4, -0.45, 0.2), (0.0, 0.1, 0.3), (-0.55, 0.5, 0.18), (0.5, 0.5, 0.28)]  # x, y, radius


def relief(x, y):
    return 0.04 * math.sin(7 * x + 1) * math.sin(6 * y)


def png(path, width, height, rgb):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + rgb[3 * width * y : 3 * width * (y + 1)] for y in range(height))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b""))


def texture():
    """Writes the texture of the high poly: waves of many lengths, and tiles with sharp edges."""
    values = bytearray()
    for y in range(TEXELS):
        for x in range(TEXELS):
            u, v = x / TEXELS, y / TEXELS
            tile = (int(u * 12) * 7 + int(v * 12) * 13) % 5 / 4
            for channel in range(3):
                wave = sum(math.sin(k * (u * (channel + 2) + v * (5 - channel)) * 6.28) / k for k in (1, 3, 9, 27))
                values.append(max(0, min(255, round(255 * (0.5 + 0.14 * wave + 0.3 * (tile - 0.5))))))
    return bytes(values)


def main():
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "low.obj"), "w", encoding="ascii") as file:
        file.write("o low\n")
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            file.write(f"v {x} {y} 0\nvt {(x + 1) / 2} {(y + 1) / 2}\n")
        file.write("vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n")
    with open(os.path.join(folder, "high.mtl"), "w", encoding="ascii") as file:
        file.write("newmtl shown\nKd 1 1 1\nmap_Kd color.png\n")
    png(os.path.join(folder, "color.png"), TEXELS, TEXELS, texture())
    lines, faces, count = ["mtllib high.mtl", "o high", "usemtl shown"], [], 0

    def add(columns, rows, at):
        nonlocal count
        for j in range(rows + 1):
            for i in range(columns + 1):
                (x, y, z), (a, b, c) = at(i / columns, j / rows)
                lines.append(f"v {x:.7f} {y:.7f} {z:.7f}")
                lines.append(f"vt {(x + 1) / 2:.7f} {(y + 1) / 2:.7f}")
                lines.append(f"vn {a:.6f} {b:.6f} {c:.6f}")
        for j in range(rows):
            for i in range(columns):
                a = count + j * (columns + 1) + i + 1
                corners = (a, a + 1, a + columns + 2, a + columns + 1)
                faces.append("f " + " ".join(f"{k}/{k}/{k}" for k in corners))
        count += (columns + 1) * (rows + 1)

    def ground(u, v):
        x, y, step = 2 * u - 1, 2 * v - 1, 1e-4
        a = (relief(x - step, y) - relief(x + step, y)) / (2 * step)
        b = (relief(x, y - step) - relief(x, y + step)) / (2 * step)
        size = math.sqrt(a * a + b * b + 1)
        return (x, y, relief(x, y)), (a / size, b / size, 1 / size)

    add(CELLS, CELLS, ground)
    for x, y, radius in BALLS:

        def ball(u, v, x=x, y=y, radius=radius):
            turn, up = 2 * math.pi * u, math.pi * (v - 0.5)
            n = (math.cos(up) * math.cos(turn), math.cos(up) * math.sin(turn), math.sin(up))
            return (x + radius * n[0], y + radius * n[1], radius * n[2]), n

        add(96, 48, ball)
    with open(os.path.join(folder, "high.obj"), "w", encoding="ascii") as file:
        file.write("\n".join(lines + faces) + "\n")


if __name__ == "__main__":
    main()
