# SPDX-License-Identifier: MIT
"""Tests of the type annotations. Run if mypy (Debian: mypy) and pyright (npm: scripts/setup python-all) are installed.
"""

import json
import shutil
import subprocess
import sys
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
reveal_type(tspace.tangents(a, a, a, convention="gltf", full=True).has_tangent)
reveal_type(tspace.normals(a, full=True).report.face_count)
reveal_type(tspace.Plan(a, a, a, convention="gltf").evaluate(a, a))
reveal_type(tspace.make_indexed_frames(a, None, a, convention="gltf").source_vertices)
reveal_type(tspace.check("a.glb").findings[0].code)
reveal_type(tspace.generate_bytes(b"").report.json)
reveal_type(tspace.generate_bytes(b"").report.totals.actions.generated)
reveal_type(tspace.inspect("a.glb").primitives[0].tangent_uses)
reveal_type(tspace.diff("a.glb", "b.glb").primitives[0].a)
reveal_type(tspace.bake_file("a.glb", "b.glb", "c.png", maps=["ao"], size=64, bits=8).files[0].maps)
reveal_type(tspace.finish_file("a.glb", "b.glb", low="c.glb").models[0].made.totals.primitives)
open("a.glb", "wb").write(tspace.generate_bytes(b""))
reveal_type(tspace.pack_frames(a, a))
tspace.tangents(a.tolist(), a, [[1.0, 2.0]], [[0, 1, 2]], convention="gltf", threads="all")
tspace.normals(a, range(3), crease_angle="auto")
tspace.check("a.glb", fail_on="warning", ignore=["tangentsUnused"])
"""
WRONG = """
tspace.tangents(a, a, a)
tspace.tangents(a, a, a, convention="gltf", color=1)
tspace.tangents(a, a, a, convention="gltf", method="mikk")
tspace.tangents(a, a, a, convention="gtlf")
tspace.tangents(a, a, a, convention="gltf", threads="two")
tspace.normals("model.obj")
tspace.split([0, 1, 2], 3, a)
tspace.pack_frames(a, a, "frame31")
tspace.check("a.glb", fail_onn="error")
tspace.generate_file("a.glb", "b.glb", crease="60")
tspace.generate_file("a.glb", "b.glb", metod="best")
tspace.bake_file("a.glb", "b.glb", "c.png", maps=["light"])
tspace.finish_file("a.glb", "b.glb", high="c.glb")
"""
# Array types as mypy prints them; {} is the name of a bit width, which differs between numpy 1 and 2.
FLOATS = "numpy.ndarray[Any, numpy.dtype[numpy.floating[numpy._typing._32Bit]]]"
NUMBERS = "numpy.ndarray[Any, numpy.dtype[numpy.unsignedinteger[numpy._typing._{}Bit]]]"
REVEALED = [
    FLOATS,
    "builtins.int",
    "numpy.ndarray[Any, numpy.dtype[numpy.bool_]]",
    "builtins.int",
    FLOATS,
    NUMBERS.format(32),
    "builtins.str",
    "builtins.dict[builtins.str, Any]",
    "builtins.int",
    "builtins.list[tspace._file_reports.TangentUse]",
    "Union[tspace._file_reports.DiffedSide, None]",
    "builtins.list[tspace._file_reports.BakedLayer]",
    "builtins.int",
    NUMBERS.format(8),
]

PYRIGHT = shutil.which("pyright") or shutil.which(
    "pyright", path=str(Path(__file__).parents[3] / "build/python/programs/node_modules/.bin")
)


class Types(unittest.TestCase):
    @unittest.skipUnless(PYRIGHT, "pyright is not installed: scripts/setup python-all, or npm install --global pyright")
    def test_pyright_reports_only_invalid_calls(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "uses.py"
            program.write_text(USES + WRONG)
            settings = {"extraPaths": [str(Path(tspace.__file__).parents[1])], "include": ["uses.py"]}
            (Path(folder) / "pyrightconfig.json").write_text(json.dumps(settings))
            command = [PYRIGHT, "--outputjson", "--pythonpath", sys.executable, "--project", folder]
            answer = json.loads(subprocess.run(command, capture_output=True, text=True).stdout)
        found = answer["generalDiagnostics"]
        wrong = [item["range"]["start"]["line"] + 1 for item in found if item["severity"] == "error"]
        first = len(USES.splitlines())
        self.assertEqual(wrong, [first + i for i, line in enumerate(WRONG.splitlines(), 1) if line], found)

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_mypy_accepts_the_package_and_reports_invalid_calls(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "uses.py"
            program.write_text(USES + WRONG)
            command = ["mypy", "--cache-dir", folder, "--no-error-summary", "--ignore-missing-imports"]
            command += [Path(tspace.__file__).parent, program]
            lines = subprocess.run(command, capture_output=True, text=True).stdout.splitlines()
        revealed = [line.split('"')[1] for line in lines if "Revealed type" in line]
        self.assertEqual(revealed, REVEALED, lines)
        wrong = [line.split(":")[:2] for line in lines if ": error:" in line]
        first = len(USES.splitlines())
        expected = [[str(program), str(first + i)] for i, line in enumerate(WRONG.splitlines(), 1) if line]
        self.assertEqual(wrong, expected, lines)


if __name__ == "__main__":
    unittest.main()
