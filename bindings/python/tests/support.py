# SPDX-License-Identifier: MIT
"""Meshes and data shared by several tests."""

import os
import unittest
from pathlib import Path

import numpy
import schema  # pylint: disable=unused-import  # validates all reports

# Same folder as TSPACE_SHARED_DIR of the repository's tests.
SHARED = Path(os.environ.get("TSPACE_SHARED_DIR") or Path(__file__).resolve().parents[4] / "shared")


def needs_shared(path):
    """Returns a folder or file of the test data; skips the test if it does not exist."""
    found = SHARED / path
    if not found.exists():
        raise unittest.SkipTest(f"{found} is missing: name the folder of test data with TSPACE_SHARED_DIR")
    return found


class Shape:
    """Arrays of a mesh, in the order of the functions' arguments."""

    def __init__(self, positions, normals, uvs, indices):
        self.positions = numpy.asarray(positions, numpy.float32)
        self.normals = numpy.asarray(normals, numpy.float32)
        self.uvs = numpy.asarray(uvs, numpy.float32)
        self.indices = numpy.asarray(indices, numpy.uint32)

    def __iter__(self):
        return iter((self.positions, self.normals, self.uvs, self.indices))


def cube():
    """Returns a cube with 24 vertices and 12 triangles."""
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    points = numpy.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], numpy.float32)
    normals = [[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]]
    return Shape(
        numpy.concatenate([points[list(side)] for side in sides]),
        numpy.repeat(numpy.float32(normals), 4, axis=0),
        numpy.tile(numpy.float32([[0, 0], [1, 0], [1, 1], [0, 1]]), (6, 1)),
        numpy.concatenate([numpy.array([0, 1, 2, 0, 2, 3]) + 4 * side for side in range(6)]),
    )


def torus(rows, columns):
    """Returns a closed surface of 2 * rows * columns triangles, with duplicated vertices at UV seams."""
    i, j = numpy.meshgrid(numpy.arange(rows + 1), numpy.arange(columns + 1), indexing="ij")
    a, b = 2 * numpy.pi * (i % rows) / rows, 2 * numpy.pi * (j % columns) / columns
    normal = numpy.stack([numpy.cos(a) * numpy.cos(b), numpy.sin(a) * numpy.cos(b), numpy.sin(b)], -1)
    center = numpy.stack([2 * numpy.cos(a), 2 * numpy.sin(a), numpy.zeros_like(a)], -1)
    vertex = (i * (columns + 1) + j)[:-1, :-1].ravel()
    quads = numpy.stack([vertex, vertex + columns + 1, vertex + columns + 2, vertex + 1], -1)
    return Shape(
        (center + 0.7 * normal).reshape(-1, 3),
        normal.reshape(-1, 3),
        numpy.stack([4 * i / rows, j / columns], -1).reshape(-1, 2),
        quads[:, [0, 1, 2, 0, 2, 3]].ravel(),
    )


def same_bits(a, b):
    """Returns whether all words are equal; any NaN equals any NaN."""
    a, b = numpy.ascontiguousarray(a, numpy.float32), numpy.ascontiguousarray(b, numpy.float32)
    if a.shape != b.shape:
        return False
    return bool(((a.view(numpy.uint32) == b.view(numpy.uint32)) | (numpy.isnan(a) & numpy.isnan(b))).all())
