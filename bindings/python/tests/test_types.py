# SPDX-License-Identifier: MIT
"""What type checkers are told. Run where mypy is installed."""

import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import tspace

USES = """
import numpy
import tspace
a = numpy.zeros((3, 3), numpy.float32)
reveal_type(tspace.tangents(a, a, a, convention="gltf"))
reveal_type(tspace.tangents(a, a, a, convention="gltf", full=True).report.group_count)
reveal_type(tspace.normals(a, full=True).report.face_count)
reveal_type(tspace.Plan(a, a, a, convention="gltf").evaluate(a, a))
reveal_type(tspace.make_indexed_frames(a, None, a, convention="gltf").source_vertices)
reveal_type(tspace.check("a.glb").findings[0].code)
reveal_type(tspace.generate_bytes(b"").report.json)
reveal_type(tspace.generate_bytes(b"").report.totals.actions.generated)
reveal_type(tspace.inspect("a.glb").primitives[0].tangent_uses)
reveal_type(tspace.diff("a.glb", "b.glb").primitives[0].a)
open("a.glb", "wb").write(tspace.generate_bytes(b""))
tspace.tangents(a, a, a)
tspace.tangents(a, a, a, convention="gltf", colour=1)
"""
REVEALED = [
    "numpy.ndarray[Any, Any]",
    "builtins.int",
    "builtins.int",
    "numpy.ndarray[Any, Any]",
    "numpy.ndarray[Any, Any]",
    "builtins.str",
    "builtins.dict[builtins.str, Any]",
    "builtins.int",
    "builtins.list[tspace._file_reports.TangentUse]",
    "Union[tspace._file_reports.DiffedSide, None]",
]


@unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
class Types(unittest.TestCase):
    def test_the_package_agrees_and_wrong_calls_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "uses.py"
            program.write_text(USES)
            command = ["mypy", "--cache-dir", folder, "--no-error-summary", "--ignore-missing-imports"]
            command += [Path(tspace.__file__).parent, program]
            lines = subprocess.run(command, capture_output=True, text=True).stdout.splitlines()
        revealed = [line.split('"')[1] for line in lines if "Revealed type" in line]
        self.assertEqual(revealed, REVEALED, lines)
        wrong = [line for line in lines if ": error:" in line]
        self.assertEqual([Path(line.split(":")[0]).name for line in wrong], ["uses.py"] * 2, wrong)


if __name__ == "__main__":
    unittest.main()
