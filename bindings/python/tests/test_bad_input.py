# SPDX-License-Identifier: MIT
"""Bad input raises an exception with a precise message; nothing leaks, and the process survives."""

import gc
import unittest
from pathlib import Path

import numpy
import tspace
from support import cube, same_bits, torus


class BadInput(unittest.TestCase):
    def setUp(self):
        self.shape = cube()
        self.positions, self.normals, self.uvs, self.indices = self.shape

    def arguments(self, **changed):
        arguments = dict(positions=self.positions, normals=self.normals, uvs=self.uvs, indices=self.indices)
        return {**arguments, "convention": "gltf", **changed}

    def refuses(self, kind, words, call, *arguments, **options):
        with self.assertRaises(kind) as caught:
            call(*arguments, **options)
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, str(caught.exception))
        # A later call still works.
        self.assertEqual(tspace.tangents(*self.shape, convention="gltf").shape, (36, 4))
        return caught.exception

    def refuses_tangents(self, kind, words, **changed):
        """Checks that both Plan and tangents() reject the changed arguments; returns the error of tangents()."""
        self.refuses(kind, words, tspace.Plan, **self.arguments(**changed))
        return self.refuses(kind, words, tspace.tangents, **self.arguments(**changed))

    def test_types_that_are_not_numbers(self):
        for name in ("positions", "normals", "uvs"):
            for value in (
                "text",
                b"bytes",
                1j * self.positions,
                self.positions > 0,
                numpy.array([None, 1]),
                object(),
                {},
            ):
                self.refuses_tangents(TypeError, name, **{name: value})
        self.refuses_tangents(TypeError, "positions must be an array, not None", positions=None)
        for value in ("text", self.indices.astype(float), self.indices > 0, [0.5, 1, 2], object(), 1j):
            self.refuses_tangents(TypeError, "indices", indices=value)
        for value in ("text", 1.5, [1.5], object()):
            self.refuses_tangents(TypeError, "face_sizes", face_sizes=value)

    def test_shapes(self):
        for name in ("positions", "normals", "uvs"):
            array = getattr(self, name)
            for value in (
                array.ravel(),
                array[:, :1],
                array[None],
                numpy.float32(1),
                array.T,
                [[1, 2, 3, 4]],
                [[1], [1, 2]],
            ):
                self.refuses_tangents((tspace.InputError, TypeError), name, **{name: value})
        error = self.refuses_tangents(ValueError, ["normals has 23", "24"], normals=self.normals[1:])
        self.assertEqual(error.code, "countMismatch")
        self.refuses_tangents(ValueError, ["uvs has 25", "24"], uvs=numpy.zeros((25, 2)))
        self.refuses_tangents(ValueError, "indices", indices=self.indices.reshape(2, 6, 3))
        self.refuses_tangents(ValueError, "indices", indices=numpy.empty((4, 0), numpy.uint32))
        self.refuses_tangents(ValueError, "35 corners", indices=self.indices[1:])
        self.refuses_tangents(ValueError, "face_sizes", face_sizes=[[3, 3]])
        self.refuses_tangents(ValueError, "face_sizes", face_sizes=3, indices=self.indices.reshape(-1, 3))

    def test_indices_out_of_range(self):
        for kind in (numpy.uint8, numpy.uint16, numpy.uint32, numpy.int32, numpy.int64, numpy.uint64, numpy.int16):
            indices = self.indices.astype(kind)
            indices[7] = 24
            error = self.refuses_tangents(tspace.IndexRangeError, ["24", "7"], indices=indices)
            self.assertEqual((error.element, error.code), (7, "indexOutOfRange"))
            self.assertIsInstance(error, (IndexError, ValueError))
            if numpy.issubdtype(kind, numpy.signedinteger):
                indices[5] = -1
                self.assertEqual(self.refuses_tangents(IndexError, "indices[5] is -1", indices=indices).element, 5)
        large = self.indices.astype(numpy.int64)
        large[3] = 2**32
        self.refuses_tangents(IndexError, "indices[3] is 4294967296", indices=large)
        self.refuses(IndexError, "indices[0] is 9", tspace.split, [9, 0, 0], 3, [numpy.zeros((3, 1))])

    def test_face_sizes_that_do_not_add_up(self):
        self.refuses_tangents(ValueError, "face", face_sizes=[3] * 11)
        self.refuses_tangents(ValueError, "face", face_sizes=[3] * 13)
        self.refuses_tangents(ValueError, "face", face_sizes=numpy.full(12, 2**32 - 1, numpy.uint32))
        self.refuses_tangents(ValueError, "face_sizes[1] is -3", face_sizes=[3, -3])
        self.refuses_tangents(ValueError, "face_sizes is 0", face_sizes=0)
        self.refuses_tangents(ValueError, "face_sizes is 9999999999", face_sizes=9999999999)

    def test_counts_that_are_too_large(self):
        # Broadcast arrays need no memory, and none may be allocated for them.
        many = numpy.broadcast_to(numpy.float32(0), (2**31, 3))
        error = self.refuses_tangents(ValueError, ["positions", "2147483648"], positions=many)
        self.assertEqual(error.code, "tooLarge")
        for kind in (numpy.uint32, numpy.int64):
            indices = numpy.broadcast_to(kind(0), (2**31,))
            self.refuses_tangents(ValueError, ["indices", "2147483648"], indices=indices)
        self.refuses_tangents(ValueError, "face_sizes", face_sizes=numpy.broadcast_to(numpy.uint32(3), (2**40,)))
        self.refuses(ValueError, "vertex_count", tspace.split, [0, 0, 0], 2**31, [numpy.zeros((3, 1))])

    def test_numbers_out_of_range_are_named(self):
        large = self.positions.astype(float)
        large[4, 1] = 1e300
        self.refuses_tangents(ValueError, "positions[4, 1] is 1e+300", positions=large)
        large[4, 1] = numpy.inf
        self.assertEqual(tspace.tangents(**self.arguments(positions=large)).shape, (36, 4))

    def test_options(self):
        for option, value in (
            ("method", "mikk"),
            ("pairing", "right"),
            ("ngons", "cut"),
            ("domain", "face"),
            ("frame", "square"),
            ("convention", "max"),
            ("threshold", float("nan")),
            ("refine", 3),
            ("refine", -1),
            ("threads", -1),
            ("threads", 0),
            ("threads", 2**40),
        ):
            with self.subTest(option=option, value=value):
                error = self.refuses_tangents(ValueError, "", **{option: value})
                self.assertEqual(error.code, "invalidOption")
        for option in ("method", "pairing", "ngons", "domain", "frame", "convention", "threshold", "refine", "threads"):
            for value in (None, [], b"mikktspace", 1j, {}, self.positions):
                with self.subTest(option=option, value=value):
                    error = self.refuses_tangents(TypeError, option, **{option: value})
                    self.assertNotIn("\n", str(error))
        self.refuses(TypeError, "convention", tspace.tangents, *self.shape)
        names = [f"'{name}'" for name in "gltf opengl directx unreal unity blender godot".split()]
        self.refuses_tangents(ValueError, ["'maya'", *names], convention="maya")
        self.refuses_tangents(TypeError, names, convention=None)
        self.refuses_tangents(TypeError, "treshold", treshold=90)
        self.refuses_tangents(ValueError, "per vertex", domain="vertex")
        parts = tspace.Convention("sideways")
        self.refuses_tangents(ValueError, ["v_axis", "sideways"], convention=parts)

    def test_output_arrays(self):
        good = numpy.zeros((36, 4), numpy.float32)
        for kind, word, out in (
            (TypeError, "float64", good.astype(float)),
            (TypeError, "list", good.tolist()),
            (ValueError, "(36, 4)", good[:35]),
            (ValueError, "(36, 4)", good.reshape(-1)),
            (ValueError, "order", good[::-1]),
            (ValueError, "order", numpy.asfortranarray(good)),
            (ValueError, "read-only", numpy.broadcast_to(numpy.float32(0), (36, 4))),
        ):
            self.refuses(kind, word, tspace.tangents, **self.arguments(out=out))
        frozen = good.copy()
        frozen.setflags(write=False)
        self.refuses(ValueError, "read-only", tspace.tangents, **self.arguments(out=frozen))
        self.assertTrue((good == 0).all() and (frozen == 0).all())

    def test_results_that_would_overwrite_inputs(self):
        memory = numpy.zeros(36 * 4, numpy.float32)
        out = memory.reshape(36, 4)
        memory[36:72] = self.indices.view(numpy.float32)
        inside = memory[36:72].view(numpy.uint32)
        self.refuses(ValueError, "shares memory", tspace.tangents, **self.arguments(indices=inside, out=out))
        self.refuses(
            ValueError,
            "shares memory",
            tspace.tangents,
            **self.arguments(positions=memory[:72].reshape(24, 3), out=out),
        )

    def test_values_that_are_not_finite_are_accepted(self):
        for bad in (numpy.nan, numpy.inf, -numpy.inf, 3e38):
            for name in ("positions", "normals", "uvs"):
                array = getattr(self, name).copy()
                array[3] = bad
                arguments = self.arguments(**{name: array})
                tangents, *_, report = tspace.tangents(**arguments, full=True)
                self.assertEqual(report.triangle_count, 12)
                mended = tspace.sanitize(tangents, arguments["positions"], arguments["normals"], self.indices)
                self.assertTrue(numpy.isfinite(mended).all())
                normals = tspace.normals(arguments["positions"], self.indices)
                self.assertTrue(numpy.isfinite(normals).all())

    def test_other_functions(self):
        refuses = self.refuses
        refuses(ValueError, "positions", tspace.normals, self.positions[:, :2])
        refuses(ValueError, "weighting", tspace.normals, *[self.positions, self.indices], weighting="heavy")
        refuses(TypeError, "crease_angle", tspace.normals, self.positions, self.indices, crease_angle="sharp")
        refuses(ValueError, "", tspace.normals, self.positions, self.indices, crease_angle=181)
        for call, options in ((tspace.normals, ("crease_angle", "denoise", "weld_distance")), (tspace.fix_winding, ("weld_distance",))):
            for option in options:
                for value in (-1, -1 - 1e-12, -0.5, numpy.float32(-1), -numpy.inf):
                    words = f'{option} must be (a finite number of 0 or more|from 0 to \\d+), or "auto"'
                    with self.subTest(option=option, value=value):
                        error = refuses(tspace.InputError, "", call, self.positions, self.indices, **{option: value})
                        self.assertRegex(str(error), f"^{words}$")
                        self.assertEqual(error.code, "invalidOption")
        refuses(TypeError, 'or "auto", not \'automatic\'', tspace.normals, self.positions, self.indices, weld_distance="automatic")
        refuses(ValueError, "", tspace.normals, self.positions, self.indices, smoothing_groups=[1, 2])
        refuses(TypeError, "smoothing_groups", tspace.normals, self.positions, self.indices, smoothing_groups="a")
        rows = numpy.zeros((36, 4), numpy.float32)
        refuses(ValueError, "tangents", tspace.sanitize, rows[:, :3], self.positions, self.normals, self.indices)
        refuses(ValueError, "35", tspace.sanitize, rows[1:], self.positions, self.normals, self.indices)
        refuses(ValueError, "attributes[0] has 35", tspace.split, self.indices, 24, [rows[1:]])
        refuses(ValueError, "", tspace.split, self.indices, 24, [numpy.zeros((36, 17))])
        refuses(TypeError, "list", tspace.split, self.indices, 24, rows)
        refuses(TypeError, "vertex_count", tspace.split, self.indices, 24.5, [rows])
        refuses(TypeError, "tolerance", tspace.split, self.indices, 24, [rows], tolerance="much")
        refuses(ValueError, "tolerance", tspace.split, self.indices, 24, [rows], tolerance=-1)
        refuses(ValueError, "format", tspace.pack_frames, rows[:, :3], rows, "frame33")
        refuses(ValueError, "tangents", tspace.pack_frames, rows[1:, :3], rows)
        refuses(ValueError, "5 bytes", tspace.unpack_frames, b"12345")
        refuses(TypeError, "uint8", tspace.unpack_frames, rows)
        refuses(TypeError, "str", tspace.unpack_frames, "1234")
        plan = tspace.Plan(*self.shape, convention="gltf")
        error = refuses(ValueError, ["positions", "23", "24"], plan.evaluate, self.positions[1:], self.normals)
        self.assertEqual(error.code, "planMismatch")
        refuses(ValueError, "normals", plan.evaluate, self.positions, self.normals[1:])
        refuses(ValueError, "threads", plan.evaluate, self.positions, self.normals, threads=-2)

    def test_unaligned_arrays_are_read(self):
        raw = numpy.zeros(self.positions.nbytes + 2, numpy.uint8)
        raw[2:] = numpy.frombuffer(self.positions.tobytes(), numpy.uint8)
        odd = raw[2:].view(numpy.float32).reshape(-1, 3)
        self.assertTrue(
            same_bits(tspace.tangents(**self.arguments(positions=odd)), tspace.tangents(**self.arguments()))
        )

    @unittest.skipUnless(Path("/proc/self/statm").exists(), "memory is read from /proc")
    def test_failures_and_results_leak_no_memory(self):
        shape = torus(60, 60)
        wrong = shape.indices.copy()
        wrong[-1] = 10**6
        rows = tspace.tangents(*shape, convention="gltf")

        def work():
            for _ in range(60):
                tspace.Plan(*shape, convention="gltf").evaluate(shape.positions, shape.normals)
                tspace.split(shape.indices, len(shape.positions), [rows])
                tspace.triangulate(shape.positions, shape.indices)
                for call in (tspace.tangents, tspace.Plan):
                    try:
                        call(shape.positions, shape.normals, shape.uvs, wrong, convention="gltf")
                    except tspace.IndexRangeError:
                        pass
            gc.collect()
            return int(Path("/proc/self/statm").read_text().split()[1]) * 4096

        work()
        before = work()
        # A leaked plan or split would take about 0.3 MB, 60 times.
        self.assertLess(work() - before, 4e6)


if __name__ == "__main__":
    unittest.main()
