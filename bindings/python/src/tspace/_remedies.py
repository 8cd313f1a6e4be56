# SPDX-License-Identifier: MIT
"""Remedies of findings as Python calls."""

from ._errors import argument_name
from ._file_reports import Finding, RemedyCommand

_FUNCTIONS = {
    "generate": "generate_file",
    "flip-green": "flip_green_file",
    "convert-map": "convert_map_file",
    "height-to-normal": "height_to_normal_file",
    "bake": "bake_file",
}


def remedy_text(finding: Finding) -> str:
    """Returns the remedy of a finding, with calls of this module instead of command lines.

    finding: a finding of `tspace.check`

    Commands without a Python function, such as `tspace map-error`, remain command lines. Replace words in capitals, such
    as "HIGH".

    >>> for finding in tspace.check("chair.glb"):
    ...     print(finding.message, tspace.remedy_text(finding))
    """
    text, end = finding.remedy, 0
    for command in finding.commands:
        begin = text.find(command.line, end)
        if begin < 0:
            break
        call = _call(command)
        text, end = text[:begin] + call + text[begin + len(command.line) :], begin + len(call)
    return text


def _call(command: RemedyCommand) -> str:
    function = _FUNCTIONS.get(command.verb)
    if function is None:
        return command.line
    options = {option.name: option.value for option in command.options}
    paths = [repr(path) for path in command.inputs] or ["model"]
    # These options of the command line are positional arguments in Python.
    if command.verb == "bake":
        paths.append(repr(options.pop("high")))
    paths.append(repr(options.pop("o")) if "o" in options else "output")
    given = [f"{argument_name(name)}={_value(value)}" for name, value in options.items()]
    return f"tspace.{function}({', '.join(paths + given)})"


def _value(value: str) -> str:
    if not value:
        return "True"
    return value if value.isdigit() else repr(value)
