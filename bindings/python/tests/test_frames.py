# SPDX-License-Identifier: MIT
"""Properties of the computed results."""

import copy
import threading
import unittest

import numpy
import tspace
from support import cube, same_bits, torus
from tspace._mesh import Mesh


def lengths(vectors):
    return numpy.linalg.norm(vectors.astype(numpy.float64), axis=1)


class Tangents(unittest.TestCase):
    def test_of_many_meshes_are_those_of_single_calls(self):
        shapes = [torus(4 + number % 5, 6) for number in range(200)]
        for threads in (1, 2, "all"):
            jobs = [tspace.MeshJob(*shape, convention="gltf", full=n % 2 == 1) for n, shape in enumerate(shapes)]
            for n, result in enumerate(tspace.tangents_of_meshes(jobs, threads=threads)):
                want = tspace.tangents(*shapes[n], convention="gltf", full=n % 2 == 1)
                for got, wanted in zip(result, want) if n % 2 == 1 else ((result, want),):
                    self.assertTrue(got == wanted if isinstance(got, tspace.TangentReport) else same_bits(got, wanted))
        self.assertEqual(tspace.tangents_of_meshes([]), [])

    def test_of_many_meshes_include_the_error_of_each(self):
        good, bad = torus(4, 6), torus(4, 6)
        bad.indices[5] = 1000
        out = numpy.zeros((len(good.indices), 4), numpy.float32)
        jobs = [tspace.MeshJob(*good, convention="gltf", out=out), tspace.MeshJob(*bad, convention="gltf")]
        first, second = tspace.tangents_of_meshes(jobs)
        self.assertIs(first, out)
        self.assertTrue(same_bits(first, tspace.tangents(*good, convention="gltf")))
        self.assertIsInstance(second, tspace.IndexRangeError)
        with self.assertRaises(tspace.InputError):
            tspace.MeshJob(*good, convention="gltf", out=out[1:])
        with self.assertRaises(TypeError):
            tspace.tangents_of_meshes([good])

    def test_point_along_u(self):
        shape = torus(64, 64)
        tangents = tspace.tangents(*shape, convention="opengl", method="best")
        corners = shape.positions[shape.indices].astype(numpy.float64)
        around = numpy.stack([-corners[:, 1], corners[:, 0], numpy.zeros(len(corners))], -1)
        around /= lengths(around)[:, None]
        self.assertGreater((tangents[:, :3] * around).sum(1).min(), 0.999)

    def test_have_the_same_bits_for_any_layout_type_and_number_of_threads(self):
        shape = torus(40, 50)
        want = tspace.tangents(*shape, convention="gltf")
        positions, normals, uvs, indices = shape
        vertex = numpy.zeros(len(positions), [("p", "f4", 3), ("n", "f4", 3), ("uv", "f4", 2), ("t", "f4", 4)])
        vertex["p"], vertex["n"], vertex["uv"] = positions, normals, uvs
        cases = {
            "interleaved": (vertex["p"], vertex["n"], vertex["uv"], indices),
            "float64": (positions.astype(float), normals.astype(float), uvs.astype(float), indices.astype(numpy.int64)),
            "columns in order": tuple(map(numpy.asfortranarray, (positions, normals, uvs))) + (indices,),
            "other bytes first": (positions.astype(">f4"), normals.astype(">f4"), uvs.astype(">f4"), indices),
            "lists": (positions.tolist(), normals.tolist(), uvs.tolist(), indices.tolist()),
            "every second": tuple(numpy.repeat(a, 2, axis=0)[::2] for a in shape),
            "read backwards": (positions[::-1], normals[::-1], uvs[::-1], (len(positions) - 1 - indices)),
            "rows of faces": (positions, normals, uvs, indices.reshape(-1, 3)),
            "int32": (positions, normals, uvs, indices.astype(numpy.int32)),
            "uint16": (positions, normals, uvs, indices.astype(numpy.uint16)),
            "no indices": (positions[indices], normals[indices], uvs[indices], None),
        }
        for name, arrays in cases.items():
            with self.subTest(name):
                self.assertTrue(same_bits(tspace.tangents(*arrays, convention="gltf"), want))
        for threads in (2, 5, "all"):
            self.assertTrue(same_bits(tspace.tangents(*shape, convention="gltf", threads=threads), want))
        for array in shape:
            array.setflags(write=False)
        self.assertTrue(same_bits(tspace.tangents(*shape, convention="gltf"), want))

    def test_arrays_of_a_supported_type_are_not_copied(self):
        vertex = numpy.zeros(9, [("p", "f4", 3), ("n", "f4", 3), ("uv", "f4", 2)])
        for kind in (numpy.uint8, numpy.uint16, numpy.uint32, numpy.int32):
            for vertices in (vertex, vertex[::3]):
                indices = numpy.zeros(6, kind)
                struct = Mesh(vertices["p"], vertices["n"], vertices["uv"], indices, None).struct
                for span, name in ((struct.positions, "p"), (struct.normals, "n"), (struct.uvs, "uv")):
                    place = vertices[name].ctypes.data, len(vertices), vertices.strides[0]
                    self.assertEqual((span.data, span.count, span.stride_bytes), place)
                self.assertEqual((struct.indices.data, struct.indices.count), (indices.ctypes.data, 6))

    def test_broadcast_arrays_are_read(self):
        shape = cube()
        normals = numpy.broadcast_to(numpy.float32([0, 0, 1]), shape.positions.shape)
        tangents = tspace.tangents(shape.positions, normals, shape.uvs, shape.indices, convention="gltf")
        dense = numpy.ascontiguousarray(normals)
        self.assertTrue(
            same_bits(tangents, tspace.tangents(shape.positions, dense, shape.uvs, shape.indices, convention="gltf"))
        )

    def test_out_may_be_a_field_of_interleaved_vertices(self):
        shape = cube()
        arrays = (shape.positions[shape.indices], shape.normals[shape.indices], shape.uvs[shape.indices])
        want = tspace.tangents(*arrays, convention="gltf")
        vertex = numpy.full(36, 7, [("p", "f4", 3), ("n", "f4", 3), ("uv", "f4", 2), ("t", "f4", 4), ("x", "f4")])
        vertex["p"], vertex["n"], vertex["uv"] = arrays
        out = vertex["t"]
        self.assertIs(tspace.tangents(vertex["p"], vertex["n"], vertex["uv"], convention="gltf", out=out), out)
        self.assertTrue(same_bits(vertex["t"], want))
        self.assertTrue((vertex["p"] == arrays[0]).all() and (vertex["x"] == 7).all())

    def test_memory_is_not_reused_while_a_view_of_a_result_exists(self):
        shape = torus(300, 300)  # its results are large enough for their memory to be reused
        want = tspace.tangents(*shape, convention="gltf").copy()
        view = tspace.tangents(*shape, convention="gltf")[::2, 3]
        part = tspace.tangents(*shape, convention="opengl")[5:].reshape(-1)
        for _ in range(3):
            self.assertTrue(same_bits(tspace.tangents(*shape, convention="gltf"), want))
            tspace.tangents(*torus(290, 300), convention="opengl")
        self.assertTrue(same_bits(view, want[::2, 3]))
        self.assertTrue(same_bits(part[3::4], -want[5:, 3]))


class Plans(unittest.TestCase):
    def test_evaluate_follows_a_pose_and_writes_to_out(self):
        shape = torus(20, 30)
        plan = tspace.Plan(*shape, convention="gltf")
        turned = numpy.float32([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
        out = numpy.empty((len(shape.indices), 4), numpy.float32)
        plan.evaluate(shape.positions @ turned, shape.normals @ turned, out=out)
        want = tspace.tangents(*shape, convention="gltf")
        self.assertLess(abs(out[:, :3] - want[:, :3] @ turned).max(), 1e-5)
        self.assertTrue((out[:, 3] == want[:, 3]).all())

    def test_many_threads_may_evaluate_one_plan(self):
        shape = torus(30, 30)
        plan = tspace.Plan(*shape, convention="gltf")
        want = plan.evaluate(shape.positions, shape.normals)
        wrong = []

        def work():
            for _ in range(10):
                if not same_bits(plan.evaluate(shape.positions, shape.normals), want):
                    wrong.append(1)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_a_plan_cannot_be_copied(self):
        plan = tspace.Plan(*cube(), convention="gltf")
        self.assertRaises(TypeError, copy.copy, plan)


class Sanitized(unittest.TestCase):
    def test_tangents_are_repaired_in_a_copy_or_in_place(self):
        shape = torus(8, 8)
        broken = tspace.tangents(*shape, convention="gltf")
        broken[5, 0], broken[9] = numpy.nan, 0
        arrays = (shape.positions, shape.normals, shape.indices)
        mended = tspace.sanitize(broken, *arrays)
        self.assertTrue(numpy.isnan(broken[5, 0]) and numpy.isfinite(mended).all())
        self.assertIs(tspace.sanitize(broken, *arrays, out=broken), broken)
        self.assertTrue(same_bits(broken, mended))


if __name__ == "__main__":
    unittest.main()
