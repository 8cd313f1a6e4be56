# SPDX-License-Identifier: MIT
"""Prints the errors of maps that were baked from the models of layer_models.py. Needs numpy.

python3 layer_errors.py ao MAP TRUTH | position MAP LEAST MOST | color MAP TEXTURE
A map is a PNG, or a .bin file of blender_layers.py: rows of three floats per texel.
"""
import struct
import sys
import zlib

import numpy as np


def read_png(path):
    """Reads a map as numbers from 0 to 1, in an array of height x width x 3."""
    data = open(path, "rb").read()
    at, packed, width, height, bits, kind = 8, b"", 0, 0, 8, 2
    while at < len(data):
        (size,), name = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        if name == b"IHDR":
            width, height, bits, kind = struct.unpack(">IIBB", data[at + 8 : at + 18])
        if name == b"IDAT":
            packed += data[at + 8 : at + 8 + size]
        at += 12 + size
    channels = {0: 1, 2: 3, 6: 4}[kind]
    step = channels * bits // 8
    raw = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + step * width)
    rows = np.zeros((height, step * width), np.uint8)
    for y in range(height):
        how, line = raw[y, 0], raw[y, 1:].astype(int)
        above = rows[y - 1].astype(int) if y else np.zeros_like(line)
        if how == 0:
            rows[y] = line
        elif how == 2:
            rows[y] = (line + above) & 255
        else:
            out = np.zeros_like(line)
            for i in range(len(line)):
                a, b, c = (out[i - step] if i >= step else 0), above[i], (above[i - step] if i >= step else 0)
                if how == 1:
                    guess = a
                elif how == 3:
                    guess = (a + b) // 2
                else:
                    p = a + b - c
                    guess = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
                out[i] = (line[i] + guess) & 255
            rows[y] = out
    numbers = rows.reshape(-1).view(">u2" if bits == 16 else np.uint8).astype(float).reshape(height, width, channels)
    return numbers[:, :, :3] / (2**bits - 1)


def read_map(path):
    if path.endswith(".png"):
        return read_png(path)
    numbers = np.fromfile(path, np.float32).astype(float)
    side = int(round((len(numbers) / 3) ** 0.5))
    return numbers.reshape(side, side, 3)


def light(stored):
    return np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)


def stored(value):
    value = np.clip(value, 0, 1)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)


def bilinear(image, u, v):
    height, width = image.shape[:2]
    x, y = u * width - 0.5, v * height - 0.5
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - left)[:, None], (y - top)[:, None]

    def at(dx, dy):
        return image[np.clip(top + dy, 0, height - 1), np.clip(left + dx, 0, width - 1)]

    return (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) + fy * ((1 - fx) * at(0, 1) + fx * at(1, 1))


def main():
    kind, path = sys.argv[1:3]
    image = read_map(path)
    if kind == "ao":
        truth = read_map(sys.argv[3])[:, :, 0]
        off = image[:, :, 0] - truth
        pairs = (off[:-1, :-1] + off[1:, :-1] + off[:-1, 1:] + off[1:, 1:]) / 4
        print(f"rms {np.sqrt(np.mean(off**2)):.4f} largest {np.abs(off).max():.3f} mean {off.mean():+.4f}; means of 2 x 2 texels rms {np.sqrt(np.mean(pairs**2)):.4f}")
    elif kind == "position":
        least, most = (np.array([float(word) for word in text.split(",")]) for text in sys.argv[3:5])
        place = least + (most - least) * image
        side = len(image)
        x = (2 * (np.arange(side) + 0.5) / side - 1)[None, :]
        off = np.hypot(place[:, :, 0] - x, place[:, :, 1] + x.T)
        print(f"across the ray: mean {off.mean():.2e} largest {off.max():.2e}")
    else:
        texture = light(read_png(sys.argv[3]))
        map_light = light(image) if path.endswith(".png") else image
        numbers = np.random.default_rng(1).uniform(0.01, 0.99, (2, 200000))
        made, truth = bilinear(map_light, *numbers), bilinear(texture, *numbers)
        off = stored(made) - stored(truth)
        print(f"rms {255 * np.sqrt(np.mean(off**2)):.3f} of 255, 99 % below {255 * np.quantile(np.abs(off), 0.99):.2f}")


if __name__ == "__main__":
    main()
