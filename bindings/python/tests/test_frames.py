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
    def test_are_unit_across_the_normal_and_signed_by_the_convention(self):
        shape = torus(12, 16)
        for method in ("mikktspace", "lengyel", "uniform", "angle", "area", "fast", "best", "flat", "basis"):
            with self.subTest(method):
                tangents = tspace.tangents(*shape, method=method, convention="opengl")
                self.assertEqual((tangents.shape, tangents.dtype), ((len(shape.indices), 4), numpy.float32))
                self.assertLess(abs(lengths(tangents[:, :3]) - 1).max(), 1e-5)
                normals = shape.normals[shape.indices]
                self.assertLess(abs((tangents[:, :3] * normals).sum(1)).max(), 1e-5)
                self.assertTrue((tangents[:, 3] == tangents[0, 3]).all())
                if method != "basis":
                    flipped = tspace.tangents(*shape, method=method, convention="gltf")
                    self.assertTrue((flipped[:, 3] == -tangents[:, 3]).all())

    def test_of_many_meshes_are_those_of_single_calls(self):
        shapes = [torus(4 + number % 5, 6) for number in range(200)]
        for threads in (1, 2, "all"):
            jobs = [tspace.MeshJob(*shape, convention="gltf", full=n % 2 == 1) for n, shape in enumerate(shapes)]
            for n, result in enumerate(tspace.tangents_of_meshes(jobs, threads=threads)):
                want = tspace.tangents(*shapes[n], convention="gltf", full=n % 2 == 1)
                for got, wanted in zip(result, want) if n % 2 == 1 else ((result, want),):
                    self.assertTrue(got == wanted if isinstance(got, tspace.TangentReport) else same_bits(got, wanted))
        self.assertEqual(tspace.tangents_of_meshes([]), [])

    def test_of_many_meshes_come_with_the_error_of_each(self):
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

    def test_arrays_of_the_right_type_are_read_where_they_lie(self):
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

    def test_out_takes_the_result_also_inside_of_vertices(self):
        shape = cube()
        arrays = (shape.positions[shape.indices], shape.normals[shape.indices], shape.uvs[shape.indices])
        want = tspace.tangents(*arrays, convention="gltf")
        vertex = numpy.full(36, 7, [("p", "f4", 3), ("n", "f4", 3), ("uv", "f4", 2), ("t", "f4", 4), ("x", "f4")])
        vertex["p"], vertex["n"], vertex["uv"] = arrays
        out = vertex["t"]
        self.assertIs(tspace.tangents(vertex["p"], vertex["n"], vertex["uv"], convention="gltf", out=out), out)
        self.assertTrue(same_bits(vertex["t"], want))
        self.assertTrue((vertex["p"] == arrays[0]).all() and (vertex["x"] == 7).all())

    def test_memory_is_not_used_again_while_a_view_of_a_result_lives(self):
        shape = torus(300, 300)  # its results are large enough for their memory to be reused
        want = tspace.tangents(*shape, convention="gltf").copy()
        view = tspace.tangents(*shape, convention="gltf")[::2, 3]
        part = tspace.tangents(*shape, convention="opengl")[5:].reshape(-1)
        for _ in range(3):
            self.assertTrue(same_bits(tspace.tangents(*shape, convention="gltf"), want))
            tspace.tangents(*torus(290, 300), convention="opengl")
        self.assertTrue(same_bits(view, want[::2, 3]))
        self.assertTrue(same_bits(part[3::4], -want[5:, 3]))

    def test_full_results_have_all_outputs(self):
        shape = cube()
        result = tspace.tangents(*shape, convention="opengl", full=True)
        self.assertTrue(same_bits(result.tangents, tspace.tangents(*shape, convention="opengl")))
        self.assertEqual(result.report.triangle_count, 12)
        self.assertIs(result.report.reference_order_abandoned, False)
        normals = shape.normals[shape.indices]
        crossed = result.tangents[:, 3:] * numpy.cross(normals, result.tangents[:, :3])
        self.assertLess(abs(crossed - result.bitangents).max(), 1e-6)
        self.assertTrue((result.magnitudes_s == 1).all() and result.magnitudes_t.shape == (36,))

    def test_rows_that_no_face_gives_a_tangent_are_marked(self):
        positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]]
        uvs = [[0, 0], [1, 0], [0, 1], [0.5, 0.5], [0.5, 0.5], [0.5, 0.5]]
        for method in ("mikktspace", "lengyel", "flat", "best"):
            arguments = dict(method=method, convention="opengl")
            result = tspace.tangents(positions, [[0, 0, 1]] * 6, uvs, full=True, **arguments)
            self.assertEqual(result.has_tangent.tolist(), [True] * 3 + [False] * 3)
            self.assertEqual(result.report.default_corner_count, 3)
            plan = tspace.Plan(positions, [[0, 0, 1]] * 6, uvs, **arguments)
            posed = plan.evaluate(positions, [[0, 0, 1]] * 6, full=True)
            self.assertEqual(posed.has_tangent.tolist(), result.has_tangent.tolist())

    def test_quads_and_mixed_faces_give_one_row_per_corner(self):
        positions = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0.5, 0]]
        uvs = [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0.5]]
        normals = [[0, 0, 1]] * 5
        want = [[1, 0, 0, 1]] * 7
        mixed = tspace.tangents(positions, normals, uvs, [0, 1, 2, 3, 1, 4, 2], face_sizes=[4, 3], convention="opengl")
        self.assertTrue(numpy.allclose(mixed, want))
        quad = tspace.tangents(positions, normals, uvs, [[0, 1, 2, 3]], convention="opengl")
        again = tspace.tangents(positions, normals, uvs, [0, 1, 2, 3], face_sizes=4, convention="opengl")
        self.assertTrue(numpy.allclose(quad, want[:4]) and same_bits(quad, again))
        penta = dict(face_sizes=[5], convention="opengl")
        self.assertTrue(numpy.allclose(tspace.tangents(positions, normals, uvs, [0, 1, 4, 2, 3], **penta), want[:5]))
        skipped = tspace.tangents(positions, normals, uvs, [0, 1, 4, 2, 3], ngons="skip", **penta)
        self.assertTrue((skipped == 0).all())

    def test_vertex_domain_gives_one_row_per_vertex(self):
        shape = torus(5, 6)
        corner = tspace.tangents(*shape, method="lengyel", convention="gltf")
        vertex = tspace.tangents(*shape, method="lengyel", convention="gltf", domain="vertex")
        self.assertEqual(len(vertex), len(shape.positions))
        self.assertTrue(same_bits(vertex[shape.indices], corner))

    def test_a_mesh_without_faces_gives_nothing(self):
        nothing = tspace.tangents(numpy.empty((0, 3)), numpy.empty((0, 3)), numpy.empty((0, 2)), convention="gltf")
        self.assertEqual(nothing.shape, (0, 4))
        unused = tspace.tangents([[0, 0, 0]], [[0, 0, 1]], [[0, 0]], [], convention="gltf")
        self.assertEqual(unused.shape, (0, 4))

    def test_conventions_by_name_and_by_their_parts_agree(self):
        shape = cube()
        for name in ("gltf", "opengl", "directx", "unreal", "unity", "blender", "godot"):
            parts = tspace.Convention.preset(name)
            self.assertTrue(
                same_bits(tspace.tangents(*shape, convention=name), tspace.tangents(*shape, convention=parts))
            )
        self.assertEqual(tspace.Convention.preset("gltf"), tspace.Convention("down"))
        negated = tspace.tangents(*shape, convention=tspace.Convention("up", stored_sign="negated"))
        self.assertTrue((negated[:, 3] == -tspace.tangents(*shape, convention="opengl")[:, 3]).all())


class Plans(unittest.TestCase):
    def test_evaluate_gives_the_bits_of_tangents_on_the_plans_pose(self):
        shape = torus(20, 30)
        for method in ("mikktspace", "best", "lengyel"):
            plan = tspace.Plan(*shape, method=method, convention="gltf")
            want = tspace.tangents(*shape, method=method, convention="gltf")
            self.assertTrue(same_bits(plan.evaluate(shape.positions, shape.normals), want))
            self.assertEqual((plan.method, plan.vertex_count), (method, len(shape.positions)))
        self.assertEqual(plan.corner_count, len(shape.indices))
        self.assertGreater(plan.memory_bytes, 0)

    def test_evaluate_follows_a_pose_and_writes_where_it_is_told(self):
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


class Normals(unittest.TestCase):
    def test_of_a_torus_are_those_of_its_formula(self):
        shape = torus(64, 96)
        for weighting in ("angle", "area", "angle_area", "uniform", "max", "best"):
            normals = tspace.normals(shape.positions, shape.indices, weighting=weighting)
            self.assertGreater((normals * shape.normals[shape.indices]).sum(1).min(), 0.999, weighting)

    def test_a_crease_makes_a_cube_hard(self):
        shape = cube()
        smooth = tspace.normals(shape.positions, shape.indices)
        self.assertLess(abs(smooth).max(), 0.9)
        for hard in (
            dict(crease_angle=60),
            dict(weighting="flat"),
            dict(weld_positions=False),
            dict(smoothing_groups=numpy.repeat(numpy.arange(1, 7), 2)),
            dict(smoothing_groups=2 ** numpy.repeat(numpy.arange(6), 2), smoothing_groups_are_masks=True),
        ):
            normals = tspace.normals(shape.positions, shape.indices, **hard)
            self.assertTrue(numpy.allclose(normals, shape.normals[shape.indices]), hard)
        left = tspace.normals(shape.positions, shape.indices, crease_angle=60, convention="unreal")
        self.assertTrue(numpy.allclose(left, -shape.normals[shape.indices]))

    def test_full_results_count_faces(self):
        shape = cube()
        result = tspace.normals(shape.positions, shape.indices, full=True)
        self.assertEqual(result.report, tspace.NormalReport(12, 0, 0, noise=0, crease_angle_deg=180))


class After(unittest.TestCase):
    def test_sanitize_mends_what_is_broken_and_nothing_else(self):
        shape = torus(8, 8)
        good = tspace.tangents(*shape, convention="gltf")
        broken = good.copy()
        broken[5, 0], broken[9] = numpy.nan, 0
        arrays = (shape.positions, shape.normals, shape.indices)
        mended, report = tspace.sanitize(broken, *arrays, full=True)
        self.assertEqual((report.not_finite_count, report.zero_count, report.mended_count), (1, 1, 2))
        self.assertTrue(numpy.isnan(broken[5, 0]))
        self.assertTrue(numpy.isfinite(mended).all())
        sound = numpy.delete(numpy.arange(len(good)), [5, 9])
        self.assertTrue(same_bits(mended[sound], good[sound]))
        self.assertIs(tspace.sanitize(broken, *arrays, out=broken), broken)
        self.assertTrue(same_bits(broken, mended))

    def test_split_gives_every_corner_its_values(self):
        shape = torus(8, 9)
        tangents = tspace.tangents(*shape, method="flat", convention="gltf")
        split = tspace.split(shape.indices, len(shape.positions), [tangents])
        self.assertTrue((split.source_vertices[split.indices] == shape.indices).all())
        self.assertTrue(same_bits(tangents[split.source_corners[split.indices]], tangents))
        used = len(numpy.unique(numpy.column_stack([shape.indices, tangents.view(numpy.uint32)]), axis=0))
        self.assertEqual(len(numpy.unique(split.indices)), used)
        loose = tspace.split(shape.indices, len(shape.positions), [tangents], tolerance=10)
        self.assertTrue((loose.indices == shape.indices).all())

    def test_split_marks_vertices_that_no_corner_uses(self):
        split = tspace.split([0, 1, 2], 4, [numpy.zeros((3, 4))])
        self.assertEqual(split.source_corners.tolist(), [0, 1, 2, 0xFFFFFFFF])

    def test_triangles_cover_polygons(self):
        positions = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0.5, 0]]
        triangles = tspace.triangulate(positions, [0, 1, 4, 2, 3, 0, 1, 2], face_sizes=[5, 3])
        self.assertEqual(triangles.faces.tolist(), [0, 0, 0, 1])
        self.assertEqual(sorted(set(triangles.corners[:3].ravel().tolist())), [0, 1, 2, 3, 4])
        self.assertEqual(triangles.corners[3].tolist(), [5, 6, 7])
        self.assertEqual(tspace.triangulate([], []).corners.shape, (0, 3))

    def test_packed_frames_come_back_within_their_bound(self):
        shape = torus(16, 16)
        normals, tangents = shape.normals[shape.indices], tspace.tangents(*shape, convention="gltf")
        bounds = {"frame32": 0.136, "frame48": 0.0043, "frame64": 0.0003, "oct32": 0.166, "qtangent64": 0.005}
        sizes = {"frame32": 4, "frame48": 6, "frame64": 8, "oct32": 4, "qtangent64": 8}
        for name, bound in bounds.items():
            packed, report = tspace.pack_frames(normals, tangents, name, full=True)
            self.assertEqual((packed.shape, packed.dtype), ((len(normals), sizes[name]), numpy.uint8))
            self.assertEqual(report.mended_count, 0)
            n, t = tspace.unpack_frames(packed, name)
            for got, want in ((n, normals), (t[:, :3], tangents[:, :3])):
                # Uses chords, because an angle from a cosine would have its rounding error.
                chord = lengths(got.astype(numpy.float64) - want)
                self.assertLess(numpy.degrees(2 * numpy.arcsin(chord / 2)).max(), bound, name)
            self.assertTrue((t[:, 3] == tangents[:, 3]).all())
            self.assertTrue(same_bits(tspace.unpack_frames(packed.tobytes(), name)[1], t))


if __name__ == "__main__":
    unittest.main()
