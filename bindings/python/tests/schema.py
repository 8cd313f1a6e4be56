# SPDX-License-Identifier: MIT
"""Validates all reports that tests receive against docs/schema, if jsonschema is installed."""

import json
import warnings
from pathlib import Path

from tspace import _files

FOLDER = Path(__file__).resolve().parents[3] / "docs" / "schema"
try:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # caused by RefResolver, in versions newer than Debian's
        from jsonschema import Draft202012Validator, RefResolver, ValidationError
except ImportError:
    Draft202012Validator = None

_schemas = {path.name: json.loads(path.read_text()) for path in FOLDER.glob("*.json")}


def schemas():
    """Returns all schemas, keyed by file name."""
    return _schemas


def expect_valid(document):
    """Raises ValidationError if a document does not match the schema that it names."""
    schema = _schemas[document["schema"].replace("/", ".") + ".json"]
    Draft202012Validator(schema, resolver=RefResolver("", schema, store=_schemas)).validate(document)


def _run(self, function, *arguments, options, has_output=False):
    result = _original_run(self, function, *arguments, options=options, has_output=has_output)
    expect_valid(result[1] if has_output else result)
    return result


_original_run = _files._Call.run
if Draft202012Validator is not None:
    _files._Call.run = _run
