# SPDX-License-Identifier: MIT
"""The ctypes declarations against the C headers: every struct, field, number and count of parameters."""

import ctypes
import inspect
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import tspace
from tspace import _abi, _files
from tspace._file_options import OPTIONS as FILE_OPTIONS

ROOT = Path(__file__).resolve().parents[3]
INCLUDE, OPTIONS = ROOT / "include", ROOT / "src/commands"
HEADERS = [path.name for path in INCLUDE.glob("tspace/tspace*.h")]
ENUMERATIONS = {
    "METHOD": _abi.METHODS,
    "PAIRING": _abi.PAIRINGS,
    "NGONS": _abi.NGONS,
    "DOMAIN": _abi.OUTPUT_DOMAINS,
    "FRAME": _abi.FRAME_SHAPES,
    "NORMAL_WEIGHTING": _abi.NORMAL_WEIGHTINGS,
    "FRAME_FORMAT": _abi.FRAME_FORMATS,
    "V": _abi.V_AXES,
    "GREEN": _abi.GREENS,
    "SIGN": _abi.STORED_SIGNS,
    "HANDEDNESS": _abi.HANDEDNESSES,
    "WINDING": _abi.WINDINGS,
}


def structs():
    """Returns the types of _abi by their names in C."""
    kinds = {name: kind for name, kind in vars(_abi).items() if isinstance(kind, type) and issubclass(kind, ctypes.Structure)}
    del kinds["Structure"]
    return kinds


def expected():
    """Returns the values that C expressions must have according to the Python declarations."""
    values = {"TSPACE_NO_ELEMENT": _abi.NO_ELEMENT, "TSPACE_NO_CORNER": _abi.NO_CORNER}
    values["TSPACE_ALL_THREADS"] = _abi.ALL_THREADS
    values["TSPACE_MAX_CORNERS"] = _abi.MAX_CORNERS
    for name, kind in structs().items():
        values[f"sizeof(tspace_{name})"] = ctypes.sizeof(kind)
        for field, _ in kind._fields_:
            values[f"offsetof(tspace_{name}, {field})"] = getattr(kind, field).offset
    for prefix, table in ENUMERATIONS.items():
        for name, number in table.items():
            values[f"TSPACE_{prefix}_{name.upper()}"] = number
    return values


class Names(unittest.TestCase):
    def test_conventions_are_those_of_the_library(self):
        for name in _abi.CONVENTIONS:
            self.assertEqual(_abi.library.tspace_findConvention(name.encode(), _abi.Convention(), _abi.Error()), 0)

    @unittest.skipUnless(OPTIONS.exists(), "the sources are missing")
    def test_options_of_files_are_those_of_the_library(self):
        """Passes all options to all functions without Python's check of names: the library must know the same ones."""
        names = set()
        for path in OPTIONS.rglob("*.cpp"):
            names.update(name.replace("-", "_") for name in re.findall(r'"(?:-\w+, )?--([a-z-]+)"', path.read_text()))
        self.assertGreater(len(names), 40)
        for verb, known in FILE_OPTIONS.items():
            call = {
                "generate": tspace.generate_bytes,
                "flipGreen": tspace.flip_green_bytes,
                "convertMap": tspace.convert_map_file,
                "heightToNormal": tspace.height_to_normal_file,
                "compressMap": tspace.compress_map_file,
                "bake": tspace.bake_file,
                "finish": tspace.finish_file,
            }.get(verb)
            paths = ("none.png", "none.ktx2")
            models = {"diff": (b"", b""), "convertMap": paths, "heightToNormal": paths, "compressMap": paths}
            models.update({"bake": ("none.glb", "none.glb", "none.png"), "finish": ("none.glb", "no_output.glb")})
            models = models.get(verb, (b"",))
            has = {name for name in names if self.knows(call or getattr(tspace, verb), models, name)}
            self.assertEqual(has, {name.rstrip("_") for name in known}, verb)

    def knows(self, call, models, option):
        if option in inspect.signature(call).parameters:
            return False  # a path of the call, such as `low`
        with mock.patch.object(_files, "_check_names"), self.assertRaises(tspace.Error) as caught:
            call(*models, **{option: "\1"})
        return "unknown option" not in str(caught.exception)


@unittest.skipUnless(INCLUDE.exists(), "the C headers are missing")
class Abi(unittest.TestCase):
    @unittest.skipUnless(shutil.which("cc"), "no C compiler")
    def test_structs_and_numbers_are_those_of_the_headers(self):
        values = expected()
        self.assertGreater(len(values), 150)
        lines = [f'printf("%llu\\n", (unsigned long long)({expression}));' for expression in values]
        program = (
            "#include <stdio.h>\n#include <tspace/tspace_files.h>\nint main(void) {\n" + "\n".join(lines) + "\n}\n"
        )
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "a.c").write_text(program)
            compiler = ["cc", "-I", INCLUDE, Path(folder) / "a.c", "-o", Path(folder) / "a"]
            subprocess.run(compiler, check=True)
            printed = subprocess.run([Path(folder) / "a"], check=True, capture_output=True, text=True).stdout
        found = dict(zip(values, map(int, printed.split())))
        self.assertEqual(found, values)

    def test_all_structs_of_the_headers_are_declared(self):
        text = "".join((INCLUDE / "tspace" / header).read_text() for header in HEADERS)
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
        bodies = {name: body for body, name in re.findall(r"typedef struct \w+ \{(.*?)\} tspace_(\w+);", text, re.S)}
        self.assertEqual(set(structs()), set(bodies))


if __name__ == "__main__":
    unittest.main()
