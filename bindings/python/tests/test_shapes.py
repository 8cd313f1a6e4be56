# SPDX-License-Identifier: MIT
"""Arrays of unexpected shapes are either interpreted correctly or rejected by name; a result is never all zeros."""

import unittest

import numpy
import tspace
from support import cube, same_bits


def bits(result):
    """Returns all arrays of a result as a list."""
    if isinstance(result, numpy.ndarray):
        return [result]
    return [array for part in result if isinstance(part, (numpy.ndarray, tuple)) for array in bits(part)]


def calls():
    """Yields name and function, the required arrays, and optional arrays, each of which is tried separately."""
    positions, normals, uvs, indices = cube()
    mesh = dict(positions=positions, normals=normals, uvs=uvs, indices=indices)
    surface = dict(positions=positions, indices=indices)
    sizes = dict(face_sizes=numpy.full(12, 3))
    lists = dict(normal_indices=indices, uv_indices=indices, **sizes)
    groups = dict(smoothing_groups=numpy.full(12, 1))
    tangents = tspace.tangents(**mesh, convention="gltf")
    packed = tspace.pack_frames(normals[indices], tangents)

    def computed(**given):
        return tspace.tangents(**given, convention="gltf")

    def planned(**given):
        return tspace.Plan(**given, convention="gltf").evaluate(positions, normals)

    def posed(**given):
        return tspace.Plan(**mesh, convention="gltf").evaluate(**given)

    def indexed(keep=None, **given):
        keep_apart = () if keep is None else [keep]
        return tspace.make_indexed_frames(**given, convention="gltf", make_normals=True, keep_apart=keep_apart)

    def split(indices, attribute):
        return tspace.split(indices, 24, [attribute])

    return [
        ("tangents", computed, mesh, lists),
        ("Plan", planned, mesh, lists),
        ("evaluate", posed, dict(positions=positions, normals=normals), {}),
        ("normals", tspace.normals, surface, {**sizes, **groups}),
        ("make_indexed_frames", indexed, mesh, {**lists, **groups, "keep": tangents}),
        (
            "sanitize",
            tspace.sanitize,
            dict(tangents=tangents, normals=normals, **surface),
            dict(normal_indices=indices, **sizes),
        ),
        ("split", split, dict(indices=indices, attribute=tangents), {}),
        ("triangulate", tspace.triangulate, surface, dict(uvs=uvs, **sizes)),
        ("pack_frames", tspace.pack_frames, dict(normals=normals[indices], tangents=tangents), {}),
        ("unpack_frames", tspace.unpack_frames, dict(frames=packed), {}),
    ]


# Names in messages for arrays that a call passes in a list.
LISTED = {"attribute": "attributes[0]", "keep": "keep_apart[0]"}


class Shapes(unittest.TestCase):
    def test_columns_rows_and_pairs_give_equal_results_or_a_named_error(self):
        for name, call, needed, further in calls():
            for argument, array in {**needed, **further}.items():
                arguments = {**needed, argument: array}
                good = bits(call(**arguments))
                self.assertTrue(any(array.any() for array in good), name)
                for shape in ((-1, 1), (-1, 2), (1, -1), (1, 1, -1), (-1, 1, 1)):
                    with self.subTest(call=name, argument=argument, shape=shape):
                        given = {**arguments, argument: array.reshape(shape)}
                        try:
                            got = bits(call(**given))
                        except tspace.InputError as error:
                            self.assertIn(LISTED.get(argument, argument), str(error))
                            continue
                        self.assertEqual(len(got), len(good))
                        for one, other in zip(got, good):
                            self.assertTrue(same_bits(one, other))

    def test_a_column_of_indices_is_a_list_of_corners(self):
        positions, normals, uvs, indices = cube()
        want = tspace.tangents(positions, normals, uvs, indices, convention="gltf")
        column = indices.reshape(-1, 1)
        self.assertTrue(same_bits(tspace.tangents(positions, normals, uvs, column, convention="gltf"), want))
        lists = dict(normal_indices=column, uv_indices=column)
        got = tspace.tangents(positions, normals, uvs, indices, **lists, convention="gltf")
        self.assertTrue(same_bits(got, want))
        by_sizes = tspace.tangents(
            positions, normals, uvs, column, face_sizes=numpy.full((12, 1), 3), convention="gltf"
        )
        self.assertTrue(same_bits(by_sizes, want))

    def test_lists_of_an_attribute_may_have_the_shape_of_the_faces(self):
        positions, normals, uvs, indices = cube()
        want = tspace.tangents(positions, normals, uvs, indices, convention="gltf")
        faces = indices.reshape(-1, 3)
        for shape in (faces, indices):
            got = tspace.tangents(positions, normals, uvs, shape, uv_indices=faces, convention="gltf")
            self.assertTrue(same_bits(got, want))

    def test_one_face_of_four_corners_is_a_quad(self):
        square = numpy.float32([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
        self.assertEqual(len(tspace.triangulate(square, [[0, 1, 2, 3]]).corners), 2)


class Names(unittest.TestCase):
    """Messages use the caller's name for a rejected argument."""

    def test_errors_begin_with_the_name_of_the_argument(self):
        positions, normals, uvs, indices = shape = cube()
        rows = tspace.tangents(*shape, convention="gltf")
        wide = numpy.zeros((36, 17))

        def tangents(**given):
            arguments = {"indices": indices, "convention": "gltf", **given}
            return lambda: tspace.tangents(positions, normals, uvs, **arguments)

        cases = {
            "crease_angle": lambda: tspace.normals(positions, indices, crease_angle=181),
            "refine": tangents(refine=3),
            "face_sizes": tangents(face_sizes=[3] * 11),
            "face_sizes, indices": tangents(indices=indices[1:]),
            "indices": tangents(indices=numpy.full(36, 24, numpy.uint32)),
            "normal_indices": tangents(normal_indices=numpy.full(36, 24, numpy.uint32)),
            "uv_indices": tangents(uv_indices=numpy.full(36, 24, numpy.uint32)),
            "domain": tangents(domain="vertex"),
            "frame": tangents(frame="symmetric"),
            "normals": lambda: tspace.tangents(positions, None, uvs, indices, convention="gltf"),
            "uvs": lambda: tspace.tangents(positions, normals, None, indices, convention="gltf"),
            "smoothing_groups": lambda: tspace.normals(positions, indices, smoothing_groups=[1, 2]),
            "attributes[0]": lambda: tspace.split(indices, 24, [wide]),
            "tolerance": lambda: tspace.split(indices, 24, [rows], tolerance=-1),
            "keep_apart[0]": lambda: tspace.make_indexed_frames(*shape, convention="gltf", keep_apart=[wide]),
        }
        for name, call in cases.items():
            with self.subTest(name):
                with self.assertRaises(tspace.InputError) as caught:
                    call()
                self.assertTrue(str(caught.exception).startswith(name), str(caught.exception))
        with self.assertRaisesRegex(tspace.InputError, "^normals"):
            tspace.sanitize(rows, positions, None, indices)
        with self.assertRaisesRegex(tspace.InputError, '^domain is "vertex"'):
            tangents(method="lengyel", domain="vertex", uv_indices=indices)()


if __name__ == "__main__":
    unittest.main()
