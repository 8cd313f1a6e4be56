# SPDX-License-Identifier: MIT
"""Options of calls on files: their names in Python and JavaScript, and their types for type checkers, from the table of
options."""
import ast
import re
import textwrap

from names import camel

PATHS = ("match",)  # options whose value is a name or a path
# Options that the JavaScript module lacks, because it has no threads, disks or importers, and does not copy maps.
NOT_IN_JS = ("threads", "no-sync", "import-seconds", "convert-maps")
JS_CALLS = ("generate", "check", "inspect", "identify", "diff")
PYI = '''\
# SPDX-License-Identifier: MIT
"""The functions of files as type checkers see them: with each option by its name. Written by scripts/api; at run time they are
those of _files.py."""

from typing import Literal, Optional, Sequence, Union

from ._file_reports import BakeReport, DiffReport, FinishReport, InspectReport
from ._files import BytesLike, CheckReport, FindFile, Generated, IdentifyReport, PathLike
from ._generate_report import GenerateReport
from ._map_reports import CompressMapReport, ConvertMapReport, FlipGreenReport, HeightToNormalReport
from ._names import FrameFormatName, MethodName, PairingName, PresetName
from ._types import DegreesOrAuto

Size = Union[int, str]
'''


def python_name(option):
    name = option["name"].replace("-", "_")
    return f"{name}_" if name == "from" else name


def python_names(options):
    lines = ["# SPDX-License-Identifier: MIT", '"""Options of each call on files, by the name in its C functions. Written by scripts/api."""',
             "", "OPTIONS = {"]
    for call, taken in options.items():
        lines += [f'    "{call}": (', *(f'        "{python_name(option)}",' for option in taken), "    ),"]
    return "\n".join([*lines, "}", ""])


def choices_of(option):
    """Returns the possible values of an option: its choices, or the alternatives of "up|down" in its help."""
    return option["choices"] or (option["value"].split("|") if "|" in option["value"] else [])


def python_type(option, aliases):
    choices, takes = choices_of(option), option["takes"]
    if not option["value"]:
        return "bool"
    if option["file"] or option["name"] in PATHS:
        return "PathLike"
    if choices:
        quoted = [choice if choice.isdigit() else f'"{choice}"' for choice in choices]
        more = [choice for choice in choices if choice not in aliases["PresetName"]]
        named = next((name for name, values in aliases.items() if set(values) == set(choices)), "")
        if not named and len(more) == 1 and len(choices) > 2:
            named = f'Union[PresetName, Literal["{more[0]}"]]'
        kind = named or f"Literal[{', '.join(quoted)}]"
        return f"Union[str, Sequence[{kind if len(choices) < 20 else 'str'}]]" if option["list"] else kind
    if not takes or "text" in takes:
        return "str"
    if "0.5" in takes:
        return "DegreesOrAuto" if "auto" in takes else "float"
    return "int" if takes == ["1"] else "Size"


def pyi(options, source, aliases):
    lines = [PYI]
    for function in (node for node in ast.parse(source).body if isinstance(node, ast.FunctionDef)):
        if function.args.kwarg is None or function.name.startswith("_"):
            continue
        call = camel(re.sub("_(file|bytes)$", "", function.name))
        lines.append(f"def {function.name}(")
        lines += [f"    {argument.arg}: {ast.unparse(argument.annotation)}," for argument in function.args.args]
        lines.append("    *,")
        lines += [f"    {argument.arg}: {ast.unparse(argument.annotation)} = ...," for argument in function.args.kwonlyargs]
        lines += [f"    {python_name(option)}: {python_type(option, aliases)} = ...," for option in options[call]]
        lines.append(f") -> {ast.unparse(function.returns)}: ...")
    return "\n".join([*lines, ""])


def js_options(options, call):
    common = {option["name"] for option in options["inspect"]}
    return [option for option in options[call] if option["name"] not in NOT_IN_JS and (option["name"] not in common) != (call == "inspect")]


def js_names(options):
    lines = ["// SPDX-License-Identifier: MIT", "// Names of the options of each call on files; those of inspect are those of all. Written by scripts/api.",
             "export const optionNames = {"]
    for call in JS_CALLS:
        names = ", ".join(f'"{camel(option["name"].replace("-", "_"))}"' for option in js_options(options, call)) + ","
        lines += [f"  {call}: [", *textwrap.wrap(names, 116, initial_indent="    ", subsequent_indent="    "), "  ],"]
    return "\n".join([*lines, "};", ""])


def js_type(option):
    choices = choices_of(option)
    if not option["value"]:
        return "boolean"
    if option["list"]:
        return "string | readonly string[]"
    if choices:
        return " | ".join(f'"{choice}"' for choice in choices)
    return "number | string" if option["takes"] and "text" not in option["takes"] else "string"


def js_types(options):
    lines = ["// SPDX-License-Identifier: MIT", "// Options of calls on files, with the help of the tool. Written by scripts/api."]
    for call in JS_CALLS:
        name = "File" if call == "inspect" else call.capitalize()
        lines += ["", f"export interface {name}{'Options' if call == 'inspect' else 'FileOptions'} {{"]
        for option in js_options(options, call):
            text = re.sub(r"--([a-z][a-z-]+)", lambda found: f"`{camel(found[1].replace('-', '_'))}`", option["help"])
            if option["default"]:
                text += f" Default: {option['default']}."
            wrapped = textwrap.wrap(text, 116)
            lines += [f"  /** {wrapped[0]} */"] if len(wrapped) == 1 else ["  /**", *(f"   * {line}" for line in wrapped), "   */"]
            lines.append(f"  {camel(option['name'].replace('-', '_'))}?: {js_type(option)};")
        lines.append("}")
    return "\n".join([*lines, ""])
