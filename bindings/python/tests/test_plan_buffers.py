# SPDX-License-Identifier: MIT
"""A plan as arrays for compute shaders: evaluation with NumPy gives the same result as the library."""

import unittest

import numpy
import tspace
from support import cube, same_bits, torus

NO_TANGENT, NO_NORMAL, NEGATIVE = 0x80000000, 0x40000000, 0x80000000


def units(vectors):
    return vectors / numpy.linalg.norm(vectors, axis=-1, keepdims=True)


def evaluated(buffers, positions, normals=None):
    """Returns normals and tangents of each result, for the method and the weighting "uniform"."""
    corners = buffers.triangles[:, :3]
    a, b = buffers.triangles[:, 3:].view(numpy.float32).T[:, :, None].astype(float)
    points = positions[corners].astype(float)
    e1, e2 = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    directions, faces = a * e1 - b * e2, units(numpy.cross(e1, e2))
    made_normals, tangents = [], []
    for first, count_and_flags, own in buffers.results.tolist():
        entries = buffers.entries[first : first + (count_and_flags & 0x0FFFFFFF)]
        of_normal = (entries[(entries & NO_NORMAL) == 0] & 0x3FFFFFFF) // 4
        of_tangent = (entries[(entries & NO_TANGENT) == 0] & 0x3FFFFFFF) // 4
        n = units(faces[of_normal].sum(0)) if normals is None else normals[corners[own // 4, own % 4]].astype(float)
        projected = directions[of_tangent] - n * (directions[of_tangent] @ n)[:, None]
        made_normals.append(n)
        tangents.append([*units(units(projected).sum(0)), -1 if count_and_flags & NEGATIVE else 1])
    return numpy.array(made_normals), numpy.array(tangents)


class PlanBuffers(unittest.TestCase):
    def test_results_per_corner_are_those_of_evaluate(self):
        shape = torus(9, 11)
        plan = tspace.Plan(*shape, method="uniform", convention="gltf")
        buffers = tspace.plan_buffers(plan)
        self.assertFalse(buffers.makes_normals)
        posed = shape.positions * numpy.float32([1, 2, 0.5])
        _, found = evaluated(buffers, posed, shape.normals)
        self.assertLess(abs(found - plan.evaluate(posed, shape.normals)).max(), 2e-6)
        # A different plan gives different tangents, so the comparison can fail.
        other = tspace.Plan(shape.positions, shape.normals, shape.uvs[:, ::-1], shape.indices, method="uniform", convention="gltf")
        self.assertGreater(abs(found - other.evaluate(posed, shape.normals)).max(), 0.5)

    def test_results_per_vertex_with_normals_are_those_of_make_indexed_frames(self):
        for shape, crease_angle in ((torus(9, 11), 180.0), (cube(), 30.0)):
            options = dict(method="uniform", convention="gltf")
            normals = dict(weighting="uniform", crease_angle=crease_angle)
            made = tspace.make_indexed_frames(shape.positions, None, shape.uvs, shape.indices, **options, **normals)
            positions, uvs = shape.positions[made.source_vertices], shape.uvs[made.source_vertices]
            plan = tspace.Plan(positions, made.normals, uvs, made.indices, **options)
            buffers = tspace.plan_buffers(
                plan,
                source_corners=made.source_corners,
                mesh=dict(positions=positions, indices=made.indices),
                normals=normals,
            )
            self.assertTrue(buffers.makes_normals)
            found_normals, found = evaluated(buffers, positions)
            self.assertLess(abs(found_normals - made.normals).max(), 2e-6)
            self.assertLess(abs(found - made.tangents).max(), 2e-6)

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

    def test_lengyel_has_seven_words_per_triangle(self):
        plan = tspace.Plan(*torus(4, 5), method="lengyel", convention="gltf")
        self.assertEqual(tspace.plan_buffers(plan).triangles.shape, (40, 7))

    def test_wrong_arguments_are_refused(self):
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
            (tspace.InputError, "plan was made for", dict(mesh=dict(positions=shape.positions[:3]))),
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
