# SPDX-License-Identifier: MIT
"""Compares every word of the MikkTSpace reference results, through numpy."""

import unittest

import numpy
import tspace
from support import needs_shared, same_bits

# docs/concepts/methods/mikktspace.md does not promise identical bits for values that are not finite or at least 1.6e38.
LIMIT = numpy.float32(1.6e38)


class Golden:
    """A mesh with the results of the reference."""

    def __init__(self, path):
        words = numpy.fromfile(path, numpy.uint32)
        faces, corners = int(words[1]), int(words[2])
        self.threshold = float(words[3:4].view(numpy.float32)[0])
        self.face_sizes = words[5 : 5 + faces]
        inputs = words[5 + faces : 5 + faces + 8 * corners].view(numpy.float32).reshape(corners, 8)
        # Views of interleaved vertices, which are used without a copy.
        self.arrays = inputs[:, 0:3], inputs[:, 3:6], inputs[:, 6:8]
        self.results = words[5 + faces + 8 * corners :].view(numpy.float32).reshape(corners, 10)
        self.is_promised = bool((numpy.abs(inputs) < LIMIT).all())

    def options(self, **more):
        return {
            "face_sizes": self.face_sizes,
            "threshold": self.threshold,
            "ngons": "skip",
            "convention": "opengl",
            **more,
        }

    def equals(self, result):
        return (
            same_bits(result.tangents[:, :3], self.results[:, :3])
            and same_bits(result.bitangents, self.results[:, 3:6])
            and same_bits(result.magnitudes_s, self.results[:, 6])
            and same_bits(result.magnitudes_t, self.results[:, 7])
            and same_bits(result.tangents[:, 3], self.results[:, 9])
        )


def goldens():
    paths = sorted(needs_shared("golden/mikktspace").glob("*.tsg"))
    return [(path, Golden(path)) for path in paths]


class MikktspaceGolden(unittest.TestCase):
    def test_every_word_equals_the_reference(self):
        meshes = goldens()
        self.assertEqual(len(meshes), 400)
        promised = [(path, golden) for path, golden in meshes if golden.is_promised]
        self.assertGreater(len(promised), 300)
        for path, golden in promised:
            with self.subTest(path.name):
                self.assertTrue(golden.equals(tspace.tangents(*golden.arrays, **golden.options(full=True))))

    def test_a_mesh_without_promised_bits_gets_finite_tangents_after_sanitize(self):
        others = [(path, golden) for path, golden in goldens() if not golden.is_promised]
        self.assertGreater(len(others), 10)
        for path, golden in others:
            with self.subTest(path.name):
                tangents = tspace.tangents(*golden.arrays, **golden.options())
                positions, normals, _ = golden.arrays
                mended = tspace.sanitize(tangents, positions, normals, face_sizes=golden.face_sizes)
                supported = numpy.repeat(golden.face_sizes, golden.face_sizes) >= 3
                self.assertTrue(numpy.isfinite(mended[supported]).all())

    def test_a_plan_and_threads_give_the_same_words(self):
        for path, golden in goldens():
            if not golden.is_promised:
                continue
            with self.subTest(path.name):
                plan = tspace.Plan(*golden.arrays, **golden.options())
                self.assertTrue(golden.equals(plan.evaluate(*golden.arrays[:2], full=True)))
                self.assertTrue(golden.equals(tspace.tangents(*golden.arrays, **golden.options(full=True, threads=3))))


if __name__ == "__main__":
    unittest.main()
