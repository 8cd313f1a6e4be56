# SPDX-License-Identifier: MIT
"""Joins pictures side by side, for docs/guides/compress-map.md. Needs numpy.

python3 join_pictures.py OUT.png SIZE PICTURE...: each picture is scaled to SIZE x SIZE, by averaging
linear light if it is larger, and by repeating texels if it is smaller
"""

import struct
import sys
import zlib

import numpy as np

from layer_errors import light, read_png, stored


def png(width, height, bits, rows):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    raw = b"".join(b"\0" + row for row in rows)
    head = struct.pack(">IIBBBBB", width, height, bits, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b"")


def join(out, size, *pictures):
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


join(sys.argv[1], int(sys.argv[2]), *sys.argv[3:])
