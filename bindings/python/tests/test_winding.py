# SPDX-License-Identifier: MIT
"""fix_winding: indices of every shape."""

import unittest

import numpy
import tspace
from support import cube


def damaged(indices, faces):
    made = numpy.array(indices, numpy.uint32).reshape(-1, 3)
    made[faces] = made[faces][:, [0, 2, 1]]
    return made


class FixWinding(unittest.TestCase):
    def setUp(self):
        self.positions, _, _, indices = cube()
        self.sound = numpy.array(indices, numpy.uint32).reshape(-1, 3)
        # The faces of the cube may have either winding, so the expected winding is the one chosen by volume.
        self.sound = tspace.fix_winding(self.positions, self.sound).indices

    def test_keeps_the_shape_and_the_type_of_indices(self):
        flat = damaged(self.sound, [3]).astype(numpy.uint8).ravel()
        result = tspace.fix_winding(self.positions, flat)
        self.assertEqual(result.indices.shape, flat.shape)
        self.assertEqual(result.indices.dtype, numpy.uint8)
        self.assertTrue((result.indices == self.sound.ravel()).all())
        self.assertTrue((flat != self.sound.ravel()).any())  # the caller's array is not changed

    def test_creates_missing_indices(self):
        soup = self.positions[damaged(self.sound, [5]).ravel()]
        result = tspace.fix_winding(soup)
        self.assertEqual(result.indices.tolist()[15:18], [15, 17, 16])
        self.assertEqual(result.report.turned_count, 1)

    def test_flips_polygons(self):
        quads = numpy.array([[0, 1, 2, 3], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0], [4, 7, 6, 5]])
        points = numpy.float32([[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0], [0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]])
        sound = tspace.fix_winding(points, quads).indices
        wrong = sound.copy()
        wrong[1, 1:] = wrong[1, :0:-1]
        self.assertTrue((tspace.fix_winding(points, wrong).indices == sound).all())
        by_sizes = tspace.fix_winding(points, wrong.ravel(), face_sizes=[4] * 6)
        self.assertTrue((by_sizes.indices == sound.ravel()).all())

    def test_accepts_the_former_name(self):
        self.assertIs(tspace.mend_winding, tspace.fix_winding)


if __name__ == "__main__":
    unittest.main()
