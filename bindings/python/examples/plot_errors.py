# SPDX-License-Identifier: MIT
"""Plots the error of tangents. Divided into cells for editors that support them; or run it:

    python3 plot_errors.py errors.png
"""

# %% The tangents of a torus are known exactly.
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402
import tspace  # noqa: E402


def torus(rows, columns, large=2.0, small=0.7):
    """Returns positions, normals, UVs and triangles; the UVs are sheared, so that tangents are not trivial."""
    i, j = numpy.meshgrid(numpy.arange(rows + 1), numpy.arange(columns + 1), indexing="ij")
    a, b = 2 * numpy.pi * i / rows, 2 * numpy.pi * j / columns
    normals = numpy.stack([numpy.cos(a) * numpy.cos(b), numpy.sin(a) * numpy.cos(b), numpy.sin(b)], -1)
    positions = small * normals + large * numpy.stack([numpy.cos(a), numpy.sin(a), 0 * a], -1)
    uvs = numpy.stack([i / rows + 0.5 * j / columns, j / columns], -1)
    v = (i * (columns + 1) + j)[:-1, :-1].ravel()
    triangles = numpy.stack([v, v + columns + 1, v + columns + 2, v, v + columns + 2, v + 1], -1)
    return positions.reshape(-1, 3), normals.reshape(-1, 3), uvs.reshape(-1, 2), triangles.ravel()


def exact(positions):
    """Returns dP/du for constant v: the direction of the circles around the axis."""
    along = numpy.stack([-positions[:, 1], positions[:, 0], 0 * positions[:, 0]], -1)
    return along / numpy.linalg.norm(along, axis=1, keepdims=True)


def errors(method, rows):
    """Returns the error angles in degrees, one per corner."""
    positions, normals, uvs, triangles = torus(rows, rows)
    tangents = tspace.tangents(positions, normals, uvs, triangles, method=method, convention="opengl")
    chord = numpy.linalg.norm(tangents[:, :3] - exact(positions)[triangles], axis=1)
    return numpy.degrees(2 * numpy.arcsin(numpy.clip(chord / 2, 0, 1)))


# %% RMS error over all corners, by the number of quads around the torus.
METHODS = ("mikktspace", "angle", "area", "fast", "best")
ROWS = (8, 16, 32, 64)
table = {method: [numpy.sqrt((errors(method, rows) ** 2).mean()) for rows in ROWS] for method in METHODS}
for method, row in table.items():
    print(f"{method:12}" + "".join(f"{error:10.4f}" for error in row))

# %% The error decreases on finer meshes, most of all for `best`.
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
for method, row in table.items():
    left.loglog(ROWS, row, marker="o", label=method)
left.set(xlabel="quads around", ylabel="degrees (root mean square)", title="error on a torus")
left.legend()
right.hist([errors(method, 32) for method in METHODS], bins=30, label=METHODS)
right.set(xlabel="degrees", ylabel="corners", title="32 quads around")
figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "errors.png", dpi=110)
