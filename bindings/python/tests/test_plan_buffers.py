# SPDX-License-Identifier: MIT
"""A plan as arrays for compute shaders: views of the words, which test_cases.py checks, and wrong arguments."""

import unittest

import numpy
import tspace
from support import cube, same_bits, torus


class PlanBuffers(unittest.TestCase):
    def test_arrays_are_views_of_words(self):
        shape = torus(4, 5)
        buffers = tspace.plan_buffers(tspace.Plan(*shape, convention="gltf"), threads=2)
        words = buffers.words
        self.assertEqual((words.dtype, words[0], len(buffers.results)), (numpy.uint32, 1, 120))
        self.assertEqual(len(words), 12 + buffers.results.size + buffers.entries.size + buffers.triangles.size)
        for array in (buffers.results, buffers.entries, buffers.triangles):
            self.assertTrue(numpy.shares_memory(array, words))
        again = tspace.PlanBuffers(words.copy())
        self.assertTrue(same_bits(again.triangles.view(numpy.float32), buffers.triangles.view(numpy.float32)))

    def test_invalid_arguments_are_rejected(self):
        shape = cube()
        plan = tspace.Plan(*shape, convention="gltf")
        mesh = dict(positions=shape.positions, indices=shape.indices)
        for kind, words, arguments in (
            (tspace.InputError, "indices must have one entry per corner", dict(indices=[0, 1, 2])),
            (tspace.IndexRangeError, "source corner", dict(source_corners=[36])),
            (tspace.InputError, "best", dict(mesh=mesh, normals=dict(weighting="best"))),
            (tspace.InputError, "weighting", dict(mesh=mesh, normals=dict(weighting="heavy"))),
            (TypeError, "known options are", dict(mesh=mesh, normals=dict(weight="area"))),
            (TypeError, "known options are", dict(mesh=dict(position=shape.positions))),
            (TypeError, "must be a dict", dict(mesh=shape.positions)),
            (tspace.InputError, "plan was created for", dict(mesh=dict(positions=shape.positions[:3]))),
        ):
            with self.assertRaisesRegex(kind, words):
                tspace.plan_buffers(plan, **arguments)
        with self.assertRaisesRegex(TypeError, "tspace.Plan"):
            tspace.plan_buffers(shape)
        with self.assertRaisesRegex(TypeError, "uint32"):
            tspace.PlanBuffers(numpy.zeros(20, numpy.float32))
        best = tspace.Plan(*shape, method="best", convention="gltf")
        with self.assertRaisesRegex(tspace.InputError, "best"):
            tspace.plan_buffers(best)


if __name__ == "__main__":
    unittest.main()
