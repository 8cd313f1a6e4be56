# SPDX-License-Identifier: MIT
"""Reports conform to docs/schema. All other tests check this too, through support."""

import copy
import unittest

import tspace
from glb import make_glb
from schema import Draft202012Validator, ValidationError, expect_valid, schemas
from support import torus


@unittest.skipUnless(Draft202012Validator, "jsonschema is not installed")
class Schema(unittest.TestCase):
    def test_the_schemas_are_valid(self):
        self.assertGreater(len(schemas()), 10)
        for schema in schemas().values():
            Draft202012Validator.check_schema(schema)

    def test_violations_of_a_schema_are_detected(self):
        document = {"schema": "tspace.inspect/1", "version": "1.0.0", "ok": True, "exitCode": 0}
        document["files"] = [tspace.inspect(make_glb(torus(4, 5)), name="a.glb").json.copy()]
        del document["files"][0]["exitCode"]
        expect_valid(document)
        for member, value in (("color", "red"), ("meshes", -1), ("meshes", None), ("primitives", {}), ("ok", False)):
            spoilt = copy.deepcopy(document)
            spoilt["files"][0][member] = value
            with self.assertRaises(ValidationError):
                expect_valid(spoilt)


class Objects(unittest.TestCase):
    def test_members_have_their_annotated_classes(self):
        made = tspace.generate_bytes(make_glb(torus(4, 5)))
        self.assertIsInstance(made.report, tspace.GenerateReport)
        self.assertEqual(type(made.report.totals).__name__, "GenerateTotals")
        self.assertEqual(type(made.report.primitives[0].sanitize.causes).__name__, "MendCauses")
        self.assertIsInstance(tspace.inspect(made), tspace.InspectReport)
        self.assertEqual(type(tspace.inspect(made).primitives[0]).__name__, "InspectedPrimitive")
        self.assertIsInstance(tspace.check(made), tspace.CheckReport)
        self.assertEqual(type(tspace.check(made).counts).__name__, "FindingCounts")
        report = tspace.diff(made, made)
        self.assertIsInstance(report, tspace.DiffReport)
        self.assertEqual(type(report.primitives[0].b).__name__, "DiffedSide")


if __name__ == "__main__":
    unittest.main()
