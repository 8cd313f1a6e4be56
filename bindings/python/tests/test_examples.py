# SPDX-License-Identifier: MIT
"""Runs each example in a separate Python process; examples with missing dependencies are skipped."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import tspace

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def needs(module):
    return unittest.skipUnless(importlib.util.find_spec(module), f"{module} is not installed")


class Examples(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *command, **environment):
        done = subprocess.run(
            command,
            cwd=self.folder,
            env={**os.environ, "HOME": str(self.folder), "XDG_RUNTIME_DIR": str(self.folder), **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,  # libraries print performance warnings there
            text=True,
            timeout=280,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def run_example(self, name, *arguments):
        # -B: writes no bytecode next to the example.
        return self.run_program(sys.executable, "-B", EXAMPLES / name, *arguments)

    def test_numpy_alone(self):
        text = self.run_example("numpy_only.py")
        self.assertRegex(text, "800 vertices became 8[0-9][0-9]")
        self.assertIn("mirrored faces: 768 of 1536", text)

    @needs("open3d")
    def test_open3d(self):
        self.assertRegex(self.run_example("open3d_mesh.py"), r"36 UVs became \d+ vertices with tangents")

    @needs("trimesh")
    def test_trimesh(self):
        text = self.run_example("trimesh_mesh.py")
        self.assertRegex(text, r"162 vertices became \d+, with tangents of shape \(\d+, 4\)")
        self.assertIn("whose tangents are those of mikktspace", text)

    @needs("matplotlib")
    def test_errors_plotted(self):
        text = self.run_example("plot_errors.py", self.folder / "errors.png")
        rows = {line.split()[0]: [float(number) for number in line.split()[1:]] for line in text.splitlines()}
        for errors in rows.values():
            self.assertEqual(sorted(errors, reverse=True), errors)
        self.assertLess(rows["best"][-1], rows["mikktspace"][-1])
        self.assertGreater((self.folder / "errors.png").stat().st_size, 10000)

    @unittest.skipUnless(shutil.which("blender"), "Blender is not installed")
    def test_blender(self):
        packages = Path(tspace.__file__).parents[1]
        start = ("blender", "--background", "--factory-startup", "--python-exit-code", "3", "--python")
        text = self.run_program(*start, EXAMPLES / "blender_compare.py", "--", "--torus", "--packages", packages)
        found = re.search(r"(\d+) corners, (\d+) with equal bits, largest angle ([0-9.]+) degrees", text)
        self.assertIsNotNone(found, text)
        self.assertEqual(found[1], str(24 * 12 * 4))
        self.assertLess(float(found[3]), 0.01, text)
        self.assertIn("0 signs differ; colors are in 'tspace angle'", text)


if __name__ == "__main__":
    unittest.main()
