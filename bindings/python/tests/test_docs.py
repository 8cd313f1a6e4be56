# SPDX-License-Identifier: MIT
"""Runs the Python code blocks of each documentation page."""

import contextlib
import io
import os
import re
import tempfile
import unittest
from pathlib import Path

from glb import make_glb
from support import torus

ROOT = Path(__file__).resolve().parents[3]


class Docs(unittest.TestCase):
    def test_every_block_runs(self):
        blocks = 0
        with tempfile.TemporaryDirectory() as folder:
            self.addCleanup(os.chdir, os.getcwd())
            os.chdir(folder)
            # The model that the pages use.
            Path("chair.glb").write_bytes(make_glb(torus(6, 8)))
            for page in (ROOT / "docs/start/first-program.md", ROOT / "docs/reference/python.md", ROOT / "bindings/python/README.md"):
                names = {}
                for block in re.findall(r"^```python\n(.*?)^```", page.read_text(), re.M | re.S):
                    with self.subTest(page=page.name, block=block), contextlib.redirect_stdout(io.StringIO()):
                        exec(compile(block, str(page), "exec"), names)
                    blocks += 1
            os.chdir(ROOT)
        self.assertGreaterEqual(blocks, 5)


if __name__ == "__main__":
    unittest.main()
