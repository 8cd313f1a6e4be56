#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""bolt_models.py FOLDER: writes low.obj, a square plate, and high.obj, the same plate with four bolts 0.2 high."""
import os
import sys

# Points of a circle, as text with as many digits as are equal on every machine.
STEPS = 24
RING = []
x, y = 1.0, 0.0
COS, SIN = 0.9659258262890683, 0.25881904510252074  # 360 / STEPS degrees
for _ in range(STEPS):
    RING.append((x, y))
    x, y = x * COS - y * SIN, x * SIN + y * COS


def write(path, bolts):
    faces = [[(-1, 0, 1, 0, 0), (1, 0, 1, 1, 0), (1, 0, -1, 1, 1), (-1, 0, -1, 0, 1)]]
    for at_x, at_z in bolts:

        def point(i, radius, height):
            x, z = RING[i % STEPS]
            return (at_x + radius * x, height, at_z + radius * z, 0, 0)

        for i in range(STEPS):
            faces.append([point(i, 0.22, 0), point(i, 0.22, 0.14), point(i + 1, 0.22, 0.14), point(i + 1, 0.22, 0)])
            faces.append([point(i, 0.22, 0.14), point(i, 0.15, 0.2), point(i + 1, 0.15, 0.2), point(i + 1, 0.22, 0.14)])
        faces.append([point(-i, 0.15, 0.2) for i in range(STEPS)])
    with open(path, "w", encoding="ascii") as file:
        for face in faces:
            for x, y, z, u, v in face:
                file.write(f"v {x:.6f} {y:.6f} {z:.6f}\nvt {u} {v}\n")
            numbers = range(-len(face), 0)
            file.write("f " + " ".join(f"{n}/{n}" for n in numbers) + "\n")


write(os.path.join(sys.argv[1], "low.obj"), [])
write(os.path.join(sys.argv[1], "high.obj"), [(x, z) for x in (-0.55, 0.55) for z in (-0.55, 0.55)])
