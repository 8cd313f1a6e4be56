# SPDX-License-Identifier: MIT
"""The cases that all languages share: tests/cases/arrays.json and files.json."""

import functools
import json
import unittest
from pathlib import Path

import numpy
import tspace

CASES = Path(__file__).resolve().parents[3] / "tests" / "cases"
RENAMED = {"angular_threshold_deg": "threshold", "crease_angle_deg": "crease_angle"}
# Options for which -1 in the table, as in C, is "auto" in Python.
WITH_AUTO = ("crease_angle_deg", "denoise", "weld_distance")
SIZES = {"positions": 3, "normals": 3, "uvs": 2}


def arrays_of(mesh):
    """Returns the arguments for a mesh of the table."""
    made = {name: numpy.reshape(numpy.float32(mesh[name]), (-1, size)) for name, size in SIZES.items() if name in mesh}
    for name in set(mesh) - set(SIZES):
        made[name] = mesh[name] if name == "face_size" or mesh[name] == "corners" else numpy.uint32(mesh[name])
    return {"face_sizes" if name == "face_size" else name: value for name, value in made.items()}


def tangents(mesh, **options):
    mesh = {"normals": None, "uvs": None, **mesh}
    result = tspace.tangents(**mesh, full=True, **options)
    posed = tspace.Plan(**mesh, **options).evaluate(mesh["positions"], mesh["normals"], full=True)
    numpy.testing.assert_array_equal(posed.tangents, result.tangents)
    return {**result._asdict(), "report": result.report._asdict()}


def normals(mesh, **options):
    result = tspace.normals(mesh["positions"], mesh.get("indices"), face_sizes=mesh.get("face_sizes"), full=True, **options)
    return {"normals": result.normals, "report": result.report._asdict()}


def position_noise(mesh):
    return {"report": tspace.position_noise(**mesh)._asdict()}


def sanitize(mesh, tangents, **options):
    mesh = {"normals": None, **mesh}
    del mesh["uvs"]
    result = tspace.sanitize(numpy.float32(tangents).reshape(-1, 4), **mesh, full=True, **options)
    return {"tangents": result.tangents, "report": result.report._asdict()}


def make_indexed_frames(mesh, **options):
    mesh.setdefault("normals", None)
    result = tspace.make_indexed_frames(**mesh, **options)._asdict()
    reports = result.pop("report")._asdict()
    return {**result, **{f"{name}_report": report and report._asdict() for name, report in reports.items()}}


def mend_winding(mesh, use_normals=True, **options):
    mesh = {name: array for name, array in mesh.items() if name != "uvs" and (use_normals or name != "normals")}
    result = tspace.fix_winding(**mesh, **options)
    return {"turned": result.turned, "report": result.report._asdict()}


def triangulate(mesh):
    mesh.pop("normals", None)
    return tspace.triangulate(**mesh)._asdict()


def split(_, indices=None, vertex_count=0, tolerance=0, attributes=()):
    rows = [numpy.reshape(numpy.float32(one["data"]), (-1, one["size"])) for one in attributes]
    return tspace.split(indices, vertex_count, rows, tolerance=tolerance)._asdict()


def pack(_, normals, tangents, format):
    normals, tangents = numpy.reshape(numpy.float32(normals), (-1, 3)), numpy.reshape(numpy.float32(tangents), (-1, 4))
    packed, report = tspace.pack_frames(normals, tangents, format, full=True)
    unpacked = tspace.unpack_frames(packed.tobytes(), format)
    return {"bytes": packed, "normals": unpacked[0], "tangents": unpacked[1], "report": report._asdict()}


def plan_buffers(mesh, indices=None, source_corners=None, normals=None, **options):
    surface = None if normals is None else {"positions": mesh["positions"], "indices": mesh["indices"], "face_sizes": mesh.get("face_sizes")}
    plan = tspace.Plan(**mesh, **options)
    made = tspace.plan_buffers(plan, indices=indices, source_corners=source_corners, mesh=surface, normals=normals)
    return {"words": made.words}


def convention(_, name):
    return {"convention": vars(tspace.Convention.preset(name))}


def flat(value):
    """Returns an array as a list of integers that are equal only if all bits of the values are equal."""
    array = numpy.ascontiguousarray(value).ravel()
    return array.view(numpy.uint32).tolist() if array.dtype == numpy.float32 else array.tolist()


class Cases(unittest.TestCase):
    def test_every_case(self):
        table = json.loads((CASES / "arrays.json").read_text())
        calls = (tangents, normals, sanitize, make_indexed_frames, mend_winding, triangulate, split, pack, convention, plan_buffers, position_noise)
        by_name = {call.__name__: call for call in calls}
        for case in table["cases"]:
            mesh = {**table["meshes"].get(case.get("mesh"), {}), **case.get("change", {})}
            mesh = arrays_of({name: value for name, value in mesh.items() if value is not None})
            options = {
                RENAMED.get(name, name): "auto" if name in WITH_AUTO and value == -1 else value
                for name, value in case.get("options", {}).items()
            }
            with self.subTest(case["name"]):
                self.check(case, lambda: by_name[case["call"]](mesh, **options))

    def check(self, case, call):
        if "error" in case:
            with self.assertRaises(tspace.InputError) as caught:
                call()
            self.assertEqual(caught.exception.code, case["error"]["code"])
            self.assertEqual(caught.exception.element, case["error"].get("element", caught.exception.element))
            return
        made = call()
        for name, wanted in case["gives"].items():
            if isinstance(wanted, dict):
                self.assertEqual({field: made[name][field] for field in wanted}, wanted, name)
            elif isinstance(wanted, list):
                array = numpy.asarray(made[name])
                self.assertEqual(flat(array), flat(numpy.array(wanted, array.dtype)), name)
            else:
                self.assertEqual(made[name], wanted, name)


class FileCases(unittest.TestCase):
    def test_every_case(self):
        text = (CASES / "files.json").read_text()
        for case in json.loads(text)["cases"]:
            model = json.loads(text)["model"]
            if "change" in case:
                (*path, last), value = case["change"][0].split("/"), case["change"][1]
                parent = functools.reduce(member, path, model)
                parent[last] = value
                if value is None:
                    del parent[last]
            options = {name.replace("-", "_"): value for name, value in case.get("options", {}).items()}
            with self.subTest(case["name"]):
                if "error" in case:
                    with self.assertRaises(tspace.Error) as caught:
                        self.report(case["call"], json.dumps(model).encode(), options)
                    self.assertEqual(caught.exception.code, case["error"])
                    continue
                report = self.report(case["call"], json.dumps(model).encode(), options)
                for path, wanted in case["gives"].items():
                    self.assertEqual(functools.reduce(member, path.split("/"), report), wanted, path)

    def report(self, call, model, options):
        if call == "generate":
            return tspace.generate_bytes(model, **options).report.json
        return getattr(tspace, call)(model, *[model] * (call == "diff"), **options).json


def member(value, name):
    return value[int(name)] if isinstance(value, list) else value[name]


if __name__ == "__main__":
    unittest.main()
