# SPDX-License-Identifier: MIT
"""python3 texture_maps.py write MAP.png NUMBERS: writes a normal map of waves, 64 x 48 texels of 16 bits, and its x and y as bytes
python3 texture_maps.py pillow NUMBERS DDS...: Pillow must read these files as that map
python3 texture_maps.py tga NUMBERS TGA: the file must contain that map
"""

import math
import struct
import sys
import zlib

WIDTH, HEIGHT = 64, 48
MOST = 4  # maximum difference of a channel, of 255: a step of a block, plus the optimization for filtering


def write(path, numbers):
    rows, bytes_ = [], bytearray()
    for row in range(HEIGHT):
        line = b"\0"
        for column in range(WIDTH):
            u, v = (column + 0.5) / WIDTH, (row + 0.5) / HEIGHT
            x, y = 0.3 * math.sin(2 * math.pi * u), 0.2 * math.sin(2 * math.pi * (u + v))
            z = math.sqrt(1 - x * x - y * y)
            line += struct.pack(">3H", *(round(65535 * (0.5 + 0.5 * part)) for part in (x, y, z)))
            bytes_ += bytes(round(255 * (0.5 + 0.5 * part)) for part in (x, y))
        rows.append(line)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    head = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 16, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"".join(rows))) + chunk(b"IEND", b""))
    with open(numbers, "wb") as file:
        file.write(bytes_)


def compare(name, numbers, pixels):
    """Compares pixels with the map. `pixels`: red and green of each pixel, starting with the top row."""
    with open(numbers, "rb") as file:
        wanted = file.read()
    if len(pixels) != WIDTH * HEIGHT:
        sys.exit(f"FAILED {name}: {len(pixels)} pixels")
    worst = max(abs(part - wanted[2 * i + k]) for i, pixel in enumerate(pixels) for k, part in enumerate(pixel[:2]))
    print(f"{name}: within {worst} of 255")
    if worst > MOST:
        sys.exit(f"FAILED {name}: it shows another map")


def pillow(numbers, *files):
    import PIL
    from PIL import Image

    for path in files:
        image = Image.open(path)
        compare(f"Pillow {PIL.__version__}, {path.rsplit('/', 1)[-1]}", numbers, list(image.convert("RGB").getdata()))


def tga(numbers, path):
    with open(path, "rb") as file:
        data = file.read()
    kind, width, height, bits, flags = data[2], *struct.unpack("<HHBB", data[12:18])
    if kind != 2 or (width, height) != (WIDTH, HEIGHT):
        sys.exit(f"FAILED nvdecompress: a TGA of kind {kind}, {width} x {height}")
    step, at = bits // 8, 18 + data[0]
    rows = [[data[at + step * (y * width + x) :][:3] for x in range(width)] for y in range(height)]
    if not flags & 0x20:
        rows.reverse()
    compare("nvdecompress", numbers, [(blue_first[2], blue_first[1]) for row in rows for blue_first in row])


{"write": write, "pillow": pillow, "tga": tga}[sys.argv[1]](*sys.argv[2:])
