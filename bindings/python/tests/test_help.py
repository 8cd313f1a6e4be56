# SPDX-License-Identifier: MIT
"""Checks help(): its examples run, and all arguments are documented and typed."""

import ast
import doctest
import importlib
import inspect
import pydoc
import typing
import unittest
from pathlib import Path

import tspace


def functions():
    """Yields public functions and methods with their names."""
    for name in tspace.__all__:
        value = getattr(tspace, name)
        if inspect.isfunction(value):
            yield name, value
    yield "Plan", tspace.Plan.__init__
    yield "Plan.evaluate", tspace.Plan.evaluate


class Help(unittest.TestCase):
    def test_the_examples_of_the_package_run(self):
        result = doctest.testmod(tspace)
        self.assertGreater(result.attempted, 10)
        self.assertEqual(result.failed, 0)

    def test_help_shows_shapes_and_every_public_name(self):
        text = pydoc.render_doc(tspace, renderer=pydoc.plaintext)
        for name in tspace.__all__:
            self.assertIn(name, text)
        for shape in ("(vertices, 3)", "(vertices, 2)", "(corners, 4)", "(faces, k)"):
            self.assertIn(shape, text)

    def test_every_argument_is_documented_and_typed(self):
        for name, function in functions():
            text = inspect.getdoc(tspace.tangents if name == "Plan" else function)
            hints = typing.get_type_hints(function)
            for argument in inspect.signature(function).parameters:
                if argument != "self":
                    with self.subTest(function=name, argument=argument):
                        self.assertRegex(text, rf"(?m)^[ ,\w]*\b{argument}\b[ ,\w]*:")
                        self.assertIn(argument, hints)
            self.assertTrue(name == "Plan" or "return" in hints, name)

    def test_functions_in_stubs_take_their_docstrings_from_modules(self):
        for stub in Path(tspace.__file__).parent.glob("*.pyi"):
            module = importlib.import_module(f"tspace.{stub.stem}")
            for node in ast.parse(stub.read_text()).body:
                if isinstance(node, ast.FunctionDef):
                    self.assertIsNone(ast.get_docstring(node), node.name)
                    self.assertIs(getattr(module, node.name), getattr(tspace, node.name))

    def test_the_package_is_marked_as_typed(self):
        self.assertTrue((Path(tspace.__file__).parent / "py.typed").exists())

    def test_the_version_is_that_of_the_library(self):
        self.assertRegex(tspace.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
