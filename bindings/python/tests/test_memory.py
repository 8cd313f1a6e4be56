# SPDX-License-Identifier: MIT
"""Calls in an interpreter with little address space succeed or raise MemoryError."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import cube

try:
    import resource
except ImportError:
    resource = None

CALLS = """
import sys
try:
    import numpy, tspace
    mesh = numpy.load(sys.argv[1])
    tspace.tangents(mesh["positions"], mesh["normals"], mesh["uvs"], mesh["indices"], convention="gltf")
    tspace.inspect(sys.argv[2])
except (MemoryError, SystemError):  # the latter from CPython's own compiler of regular expressions
    sys.exit(5)
"""


@unittest.skipUnless(resource and sys.platform == "linux", "limits of address space are Linux's")
class Memory(unittest.TestCase):
    """Limits RLIMIT_AS, starting with the interpreter's own use."""

    def test_scarce_addresses_are_memory_errors(self):
        """The process must not be killed by a signal, nor report a library as missing."""
        with tempfile.TemporaryDirectory() as folder:
            import numpy  # pylint: disable=import-outside-toplevel

            mesh = Path(folder, "mesh.npz")
            names = ("positions", "normals", "uvs", "indices")
            numpy.savez(mesh, **dict(zip(names, cube())))
            obj = Path(folder, "a.obj")
            obj.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="ascii")
            environment = dict(os.environ, OPENBLAS_NUM_THREADS="1")

            def run(megabytes, code):
                def limit():
                    resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))

                return subprocess.run(
                    [sys.executable, "-c", code, str(mesh), str(obj)],
                    env=environment,
                    preexec_fn=limit,  # pylint: disable=subprocess-popen-preexec-fn
                    capture_output=True,
                    check=False,
                    timeout=60,
                )

            if run(1 << 20, CALLS).returncode != 0:
                self.skipTest("this package has no library for model files")
            for megabytes in range(44, 85, 4):
                if run(megabytes, "import numpy").returncode == 0:
                    done = run(megabytes, CALLS)
                    self.assertIn(done.returncode, (0, 5), (megabytes, done.stderr[-400:]))
