# SPDX-License-Identifier: MIT
"""Indexed frames in one call, and meshes with a separate index list per attribute."""

import unittest

import numpy
import tspace
from support import cube, same_bits, torus


class IndexedFrames(unittest.TestCase):
    def test_every_corner_has_the_tangent_of_the_single_steps(self):
        for method in ("mikktspace", "best", "flat"):
            shape = torus(12, 14)
            made = tspace.make_indexed_frames(*shape, method=method, convention="gltf", threads=2)
            tangents = tspace.tangents(*shape, method=method, convention="gltf")
            mended = tspace.sanitize(tangents, shape.positions, shape.normals, shape.indices)
            self.assertTrue(same_bits(made.tangents[made.indices], mended))
            self.assertTrue((made.source_vertices[made.indices] == shape.indices).all())
            self.assertTrue(same_bits(made.normals[made.indices], shape.normals[shape.indices]))
            self.assertIsNone(made.report.normals)

    def test_a_mesh_without_indices_becomes_indexed(self):
        shape = torus(10, 12)
        arrays = shape.positions[shape.indices], shape.normals[shape.indices], shape.uvs[shape.indices]
        made = tspace.make_indexed_frames(*arrays, convention="gltf")
        self.assertEqual(len(made.source_vertices), len(shape.positions))
        self.assertTrue(same_bits(arrays[0][made.source_vertices[made.indices]], arrays[0]))
        colors = numpy.arange(len(shape.indices), dtype=numpy.float32)[:, None]
        apart = tspace.make_indexed_frames(*arrays, convention="gltf", keep_apart=[colors])
        self.assertEqual(apart.indices.tolist(), list(range(len(shape.indices))))

    def test_invalid_input_is_rejected(self):
        shape = cube()
        with self.assertRaisesRegex(TypeError, "keep_apart"):
            tspace.make_indexed_frames(*shape, convention="gltf", keep_apart=shape.normals)
        with self.assertRaisesRegex(ValueError, "24 rows.*36 corners"):
            tspace.make_indexed_frames(*shape, convention="gltf", keep_apart=[shape.normals])
        with self.assertRaisesRegex(TypeError, "convention"):
            tspace.make_indexed_frames(*shape)


class IndexLists(unittest.TestCase):
    def setUp(self):
        shape = torus(11, 13)
        self.shape = shape
        self.want = tspace.tangents(*shape, convention="gltf")
        self.positions, self.position_indices = numpy.unique(
            shape.positions[shape.indices], axis=0, return_inverse=True
        )
        self.normals, self.normal_indices = numpy.unique(shape.normals[shape.indices], axis=0, return_inverse=True)
        self.uvs, self.uv_indices = numpy.unique(shape.uvs[shape.indices], axis=0, return_inverse=True)

    def test_a_list_for_each_attribute_gives_the_bits_of_one_list(self):
        for kind in (numpy.uint16, numpy.int32, numpy.int64):
            lists = dict(normal_indices=self.normal_indices.astype(kind), uv_indices=self.uv_indices.astype(kind))
            got = tspace.tangents(
                self.positions, self.normals, self.uvs, self.position_indices, convention="gltf", **lists
            )
            self.assertTrue(same_bits(got, self.want))

    def test_attributes_may_be_given_per_corner(self):
        shape = self.shape
        arrays = self.positions, shape.normals[shape.indices], shape.uvs[shape.indices], self.position_indices
        options = dict(normal_indices="corners", uv_indices="corners", convention="gltf")
        self.assertTrue(same_bits(tspace.tangents(*arrays, **options), self.want))
        plan = tspace.Plan(*arrays, **options)
        self.assertTrue(same_bits(plan.evaluate(arrays[0], arrays[1]), self.want))
        with self.assertRaisesRegex(ValueError, "normals has"):
            plan.evaluate(arrays[0], arrays[1][1:])

    def test_indexed_frames_gather_through_the_corner(self):
        made = tspace.make_indexed_frames(
            self.positions,
            self.normals,
            self.uvs,
            self.position_indices,
            normal_indices=self.normal_indices,
            uv_indices=self.uv_indices,
            convention="gltf",
        )
        self.assertTrue(same_bits(made.tangents[made.indices], self.want))
        uvs = self.uvs[self.uv_indices[made.source_corners]]
        self.assertTrue(same_bits(uvs[made.indices], self.shape.uvs[self.shape.indices]))
        self.assertEqual(len(made.source_vertices), len(self.shape.positions))

    def test_invalid_lists_are_rejected(self):
        arrays = self.positions, self.normals, self.uvs, self.position_indices
        for name, value, kind, word in (
            ("normal_indices", "faces", ValueError, "corners"),
            ("uv_indices", self.uv_indices[1:], ValueError, "uv_indices has"),
            ("uv_indices", self.uv_indices + 10**6, IndexError, r"uv_indices\[0\]"),
            ("normal_indices", (self.normal_indices - 1).astype(numpy.int32), IndexError, "is -1"),
            ("normal_indices", self.normal_indices * 1.0, TypeError, "normal_indices"),
            ("normal_indices", "corners", ValueError, "normals has"),
        ):
            with self.assertRaisesRegex(kind, word):
                tspace.tangents(*arrays, convention="gltf", **{"uv_indices": self.uv_indices, name: value})


if __name__ == "__main__":
    unittest.main()
