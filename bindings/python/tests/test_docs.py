# SPDX-License-Identifier: MIT
"""The Python of the documentation runs, page by page."""

import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]


class Docs(unittest.TestCase):
    def test_every_block_runs(self):
        pages = (ROOT / "README.md", ROOT / "docs/python.md", ROOT / "bindings/python/README.md")
        blocks = 0
        for page in pages:
            names = {}
            for block in re.findall(r"^```python\n(.*?)^```", page.read_text(), re.M | re.S):
                with self.subTest(page=page.name, block=block):
                    exec(compile(block, str(page), "exec"), names)
                blocks += 1
        self.assertGreaterEqual(blocks, 4)


if __name__ == "__main__":
    unittest.main()
